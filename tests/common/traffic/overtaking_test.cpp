// Overtaking on the lane of oncoming traffic: everything is told from the published poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <vector>

#include "common/traffic/road_network.hpp"
#include "common/traffic/study.hpp"
#include "tests/common/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kRadius_m = 600.0, kWidth_m = 3.5, kLimit_mps = 20.0, kRound = 2.0 * std::numbers::pi, kStep_s = 0.02;
constexpr double kNobody_s = 1e9;
constexpr double kLeast_s = 2.0;  // who comes needs at least so long to where somebody is back on his side

// A road of one lane a direction around a circle to the left, going on into itself, with these marks in its middle.
std::shared_ptr<const network::Network> TwoWayRing(const std::string& marks, bool left_hand = false, const std::string& more = "") {
  opendrive::RoadText road;
  road.length = kRound * kRadius_m;
  if (left_hand) road.attributes += " rule=\"LHT\"";
  road.link = "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>"
              "<successor elementType=\"road\" elementId=\"1\" contactPoint=\"start\"/>";
  road.geometry = fmt::format("<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{0:.17g}\"><arc curvature=\"{1:.17g}\"/></geometry>", road.length, 1.0 / kRadius_m);
  const auto lane = [&](int id) {
    return fmt::format("<lane id=\"{0}\" type=\"driving\"><link><predecessor id=\"{0}\"/><successor id=\"{0}\"/></link>"
                       "<width sOffset=\"0\" a=\"{1}\" b=\"0\" c=\"0\" d=\"0\"/><speed sOffset=\"0\" max=\"{2}\" unit=\"m/s\"/></lane>", id, kWidth_m, kLimit_mps);
  };
  road.left = lane(1), road.right = lane(-1);
  road.more = more;
  std::string text = road.Text();
  const std::string none = "<lane id=\"0\" type=\"none\"/>";
  text.replace(text.find(none), none.size(), "<lane id=\"0\" type=\"none\">" + marks + "</lane>");
  return opendrive::MustRead(opendrive::Document(text));
}

std::string Mark(const std::string& type, double from_m = 0.0) {
  return fmt::format("<roadMark sOffset=\"{}\" type=\"{}\" color=\"white\" width=\"0.12\"/>", from_m, type);
}

TrafficSettings Drivers(std::uint32_t vehicles, std::uint64_t seed = 1) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.seed = seed;
  settings.speed_factor_low = 0.9;
  return settings;
}

// What the poses on the ring say.
class Watch {
 public:
  explicit Watch(bool left_hand = false) : left_hand_(left_hand) {}

  struct Car {
    double s_m = 0.0;      // along the road's middle
    double aside_m = 0.0;  // farthest that it reaches over the middle, above 0 on the other side
    bool with = false;     // drives with growing s
    double speed_mps = 0.0, length_m = 0.0;
  };
  struct Crossing {
    std::uint32_t id;
    bool with;
    double from_m, to_m;     // along the road, where it was over the middle
    double spare_s = kNobody_s;  // until who came was where it then was, at the end
    double length_s = 0.0;
  };

  void Look(const TrafficModel& model, double time_s) {
    std::map<std::uint32_t, Car> cars;
    for (const AgentPose& pose : model.poses()) cars[pose.id] = CarOf(model, pose);
    for (const auto& [id, car] : cars) {
      const bool over = car.aside_m > 0.0;
      const auto out = out_.find(id);
      if (over && out == out_.end()) out_[id] = {car.s_m, time_s};
      if (over || out == out_.end()) continue;
      Crossing crossing{id, car.with, out->second.s_m, car.s_m, kNobody_s, time_s - out->second.time_s};
      for (const auto& [other, comes] : cars) {
        if (comes.with == car.with) continue;
        double gap = std::remainder((comes.s_m - car.s_m) * (car.with ? 1.0 : -1.0), kRound * kRadius_m) - 0.5 * (car.length_m + comes.length_m);
        if (gap > -car.length_m && comes.speed_mps > 0.1) crossing.spare_s = std::min(crossing.spare_s, std::max(0.0, gap) / comes.speed_mps);
      }
      crossings.push_back(crossing);
      out_.erase(out);
    }
    for (const auto& [a, one] : cars) {
      for (const auto& [b, two] : cars) {
        if (a >= b || std::fabs(std::remainder(one.s_m - two.s_m, kRound * kRadius_m)) > 15.0) continue;
        if (driver::Overlap(Rectangle(model, a), Rectangle(model, b))) touches.insert({a, b});
      }
    }
    if (!before_.empty()) {
      for (const auto& [id, car] : cars) {
        for (const auto& [other, slow] : cars) {
          if (id == other || car.with != slow.with) continue;
          const double sign = car.with ? 1.0 : -1.0;
          const double was = sign * std::remainder(before_[id].s_m - before_[other].s_m, kRound * kRadius_m), is = sign * std::remainder(car.s_m - slow.s_m, kRound * kRadius_m);
          if (was < 0.0 && is >= 0.0 && is < 20.0) ++passes, passed_by[other].insert(id);
        }
      }
    }
    before_ = cars;
  }

  std::vector<Crossing> crossings;
  std::map<std::uint32_t, std::set<std::uint32_t>> passed_by;
  std::set<std::pair<std::uint32_t, std::uint32_t>> touches;
  int passes = 0;
  const std::map<std::uint32_t, Car>& cars() const { return before_; }
  std::size_t out_now() const { return out_.size(); }

 private:
  static driver::Footprint Rectangle(const TrafficModel& model, std::uint32_t id) {
    const auto& poses = model.poses();
    return FootprintOf(*std::find_if(poses.begin(), poses.end(), [&](const AgentPose& p) { return p.id == id; }), model.traits(id));
  }
  Car CarOf(const TrafficModel& model, const AgentPose& pose) const {
    const AgentTraits& traits = model.traits(pose.id);
    const driver::Footprint body = FootprintOf(pose, traits);
    Car car;
    const double angle = std::atan2(body.x_m, kRadius_m - body.y_m);
    car.s_m = (angle < 0.0 ? angle + kRound : angle) * kRadius_m;
    car.with = std::cos(body.heading_rad - angle) > 0.0;
    car.speed_mps = body.speed_mps, car.length_m = traits.length_m;
    const bool outside = car.with != left_hand_;  // its own side
    car.aside_m = -1e9;
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        const double c = std::cos(body.heading_rad), s = std::sin(body.heading_rad);
        const double px = body.x_m + x * traits.length_m * c - y * traits.width_m * s, py = body.y_m + x * traits.length_m * s + y * traits.width_m * c;
        const double r = std::hypot(px, py - kRadius_m);
        car.aside_m = std::max(car.aside_m, outside ? kRadius_m - r : r - kRadius_m);
      }
    }
    return car;
  }

  struct Out { double s_m, time_s; };
  bool left_hand_;
  std::map<std::uint32_t, Out> out_;
  std::map<std::uint32_t, Car> before_;
};


base::Digest DigestOf(const TrafficModel& model) {
  base::StateWriter writer;
  model.Save(writer);
  return writer.digest();
}

// Two crawl, one in each direction.
TrafficModel WithSlowOnes(const TrafficSettings& settings, const std::shared_ptr<const network::Network>& network) {
  TrafficModel model = TrafficModel::Make(settings, network, {}).value();
  model.CapSpeed(3, 8.0);
  model.CapSpeed(9, 8.0);
  return model;
}

// The closed form against the motion itself, in small steps.
TEST(Overtaking, ThePlanIsTheMotion) {
  for (const double v : {8.0, 11.0, 15.0}) {
    for (const double relative : {20.0, 45.0, 120.0}) {
      PassCase at;
      at.speed_mps = v, at.passed_mps = 8.0, at.top_mps = 20.0, at.gains_mps2 = 1.2;
      at.to_clear_m = 25.0, at.relative_m = relative, at.back_s = 4.5, at.back_least_m = 24.0, at.length_m = 4.0;
      const PassPlan plan = PlanPass(at);
      double time = 0.0, way = 0.0, speed = v, gained = 0.0;
      constexpr double kSmall_s = 1e-4;
      for (; way < at.to_clear_m || gained < relative; time += kSmall_s) {
        if (way >= at.to_clear_m) speed = std::min(at.top_mps, speed + at.gains_mps2 * kSmall_s);
        way += speed * kSmall_s, gained += (speed - at.passed_mps) * kSmall_s;
      }
      EXPECT_NEAR(plan.gaining_s, time, 2e-3);
      EXPECT_NEAR(plan.speed_mps, speed, 2e-3);
      EXPECT_NEAR(plan.way_m, way + 4.5 * speed, 0.05);
      EXPECT_NEAR(plan.time_s, time + 0.8 * 4.5 + 4.0 / speed, 5e-3);
    }
  }
}

TEST(Overtaking, ShareOfTheQuintic) {
  for (const double u : {0.1, 0.35, 0.5, 0.8}) EXPECT_NEAR(QuinticShareAt(u * u * u * (10.0 + u * (-15.0 + 6.0 * u))), u, 1e-9);
}

// Slow ones are passed against oncoming traffic by everybody behind them; who comes is never nearer than two seconds when somebody is back on
// his side; nobody touches anybody. Who goes over indicates to that side, before he is over, and to the other one on the way back.
void PassesInTime(bool left_hand) {
  const auto network = TwoWayRing(Mark("broken"), left_hand);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    TrafficModel model = WithSlowOnes(Drivers(12, seed), network);
    Watch watch(left_hand);
    const std::uint32_t out = left_hand ? 4u : 2u, in = left_hand ? 2u : 4u;
    std::map<std::uint32_t, std::pair<bool, bool>> shown;  // to the other side, and back
    for (int i = 0; i < 50 * 500; ++i) {
      model.Step(kStep_s, {});
      const std::size_t before = watch.crossings.size();
      watch.Look(model, i * kStep_s);
      for (const AgentPose& pose : model.poses()) {
        const std::uint32_t lights = model.LightsOf(pose);
        const bool over = watch.cars().at(pose.id).aside_m > 0.0;
        if ((lights & out) != 0) shown[pose.id].first = true;
        if ((lights & in) != 0 && over) shown[pose.id].second = true;
        EXPECT_TRUE(!over || shown[pose.id].first) << pose.id << " at " << i * kStep_s;
        EXPECT_NE(lights & (in | out), in | out);
      }
      for (std::size_t k = before; k < watch.crossings.size(); ++k) {
        EXPECT_TRUE(shown[watch.crossings[k].id].second) << watch.crossings[k].id;
        shown.erase(watch.crossings[k].id);
      }
    }
    EXPECT_GE(watch.passes, 10) << seed;
    EXPECT_GE(watch.passed_by[3].size() + watch.passed_by[9].size(), 8u) << seed;
    EXPECT_TRUE(watch.touches.empty()) << seed;
    for (const Watch::Crossing& c : watch.crossings) {
      EXPECT_GE(c.spare_s, kLeast_s) << seed << ": car " << c.id << " from " << c.from_m << " to " << c.to_m;
      EXPECT_LT(c.length_s, 30.0);
    }
  }
}

TEST(Overtaking, SlowOnesArePassedBeforeWhoComesIsNear) { PassesInTime(false); }
TEST(Overtaking, MirroredInLeftHandTraffic) { PassesInTime(true); }

// More of them, who come closer to one another: nobody touches anybody, and who goes over is back in time.
TEST(Overtaking, DenseTrafficBothWaysIsSafe) {
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    TrafficSettings settings = Drivers(20, seed);
    settings.mix.shares = {0.7, 0.1, 0.15, 0.05};
    settings.speed_factor_low = 0.6;
    TrafficModel model = WithSlowOnes(settings, TwoWayRing(Mark("broken")));
    Watch watch;
    for (int i = 0; i < 25 * 400; ++i) {
      model.Step(0.04, {});
      watch.Look(model, i * 0.04);
    }
    crossings += watch.crossings.size();
    EXPECT_TRUE(watch.touches.empty()) << seed;
    for (const Watch::Crossing& c : watch.crossings) EXPECT_GE(c.spare_s, kLeast_s) << seed << ": car " << c.id;
  }
  EXPECT_GE(crossings, 3u);
}

// Marks, signs and settings: where they say no, nobody is on the other side.
TEST(Overtaking, MarksAndSignsAreKept) {
  const auto run = [](const std::shared_ptr<const network::Network>& network, const TrafficSettings& settings) {
    TrafficModel model = WithSlowOnes(settings, network);
    Watch watch;
    for (int i = 0; i < 20 * 300; ++i) {
      model.Step(0.05, {});
      watch.Look(model, i * 0.05);
    }
    return watch;
  };
  const auto count = [&](const std::shared_ptr<const network::Network>& network, bool with) {
    const Watch watch = run(network, Drivers(12, 2));
    return std::count_if(watch.crossings.begin(), watch.crossings.end(), [&](const Watch::Crossing& c) { return c.with == with; });
  };
  EXPECT_EQ(count(TwoWayRing(Mark("solid")), true) + count(TwoWayRing(Mark("solid")), false), 0);
  EXPECT_EQ(count(TwoWayRing(Mark("solid solid")), true), 0);
  // Of two lines the one on the own side counts.
  const auto one = TwoWayRing(Mark("solid broken")), other = TwoWayRing(Mark("broken solid"));
  EXPECT_EQ((count(one, true) > 0) + (count(one, false) > 0), 1);
  EXPECT_EQ((count(other, true) > 0) + (count(other, false) > 0), 1);
  EXPECT_NE(count(one, true) > 0, count(other, true) > 0);
  // Dashed for a part of the road.
  const Watch part = run(TwoWayRing(Mark("broken") + Mark("solid", 1800.0)), Drivers(12, 2));
  EXPECT_GT(part.crossings.size(), 0u);
  for (const Watch::Crossing& c : part.crossings) EXPECT_TRUE(std::max(c.from_m, c.to_m) <= 1800.0) << c.from_m << " to " << c.to_m;
  const auto sign = TwoWayRing(Mark("broken"), false, "<signals><signal id=\"s\" s=\"5\" t=\"-5\" type=\"276\" subtype=\"-1\" orientation=\"+\" dynamic=\"no\"/></signals>");
  EXPECT_EQ(count(sign, true), 0);
  EXPECT_GT(count(sign, false), 0);
  TrafficSettings never = Drivers(12, 2);
  never.overtaking.allowed = false;
  EXPECT_TRUE(run(TwoWayRing(Mark("broken")), never).crossings.empty());
}

// A driver's car that crawls is passed; one that goes faster as soon as somebody is beside it, one that comes faster than the law allows, and one
// that stops: nobody drives into it.
TEST(Overtaking, TheDriversCarIsPassedAndNeverHit) {
  int passes = 0, given_up = 0;
  std::array<int, 4> out_steps{};
  for (const int kind : {0, 1, 2, 3}) {
    TrafficModel model = TrafficModel::Make(Drivers(10, 5), TwoWayRing(Mark("broken")), {}).value();
    const bool comes = kind == 2;
    if (comes) model.CapSpeed(1, 8.0), model.CapSpeed(8, 8.0);
    const double radius = kRadius_m + (comes ? -0.5 : 0.5) * kWidth_m;
    driver::Footprint car{5000, 0, 0, 0, comes ? 30.0 : 8.0, 4.5, 1.8};
    double angle = 0.0;
    const auto gap = [&] {  // to the next car on its lane and that one's way
      double least = 1e9;
      for (const AgentPose& pose : model.poses()) {
        const double other = std::atan2(pose.p_WB_W.x(), kRadius_m - pose.p_WB_W.y());
        const double ahead = std::remainder(other - angle, kRound) * (comes ? -1.0 : 1.0) * radius;
        const bool with = std::cos(FootprintOf(pose, model.traits(pose.id)).heading_rad - other) > 0.0;
        if (with != comes && ahead > 0.0) least = std::min(least, ahead - 0.5 * (4.5 + model.traits(pose.id).length_m));
      }
      return least;
    };
    bool entered = false;
    std::map<std::uint32_t, double> before;
    for (int i = 0; i < 50 * 400; ++i) {
      if (!entered) {  // where there is room for it
        for (angle = 0.0; angle < kRound; angle += 0.02) {
          bool free = true;
          for (const AgentPose& pose : model.poses()) free = free && std::fabs(std::remainder(std::atan2(pose.p_WB_W.x(), kRadius_m - pose.p_WB_W.y()) - angle, kRound)) * radius > 120.0;
          if (free) break;
        }
        entered = angle < kRound;
      }
      bool beside = false;
      for (const AgentPose& pose : model.poses()) beside = beside || std::hypot(pose.p_WB_W.x() - car.x_m, pose.p_WB_W.y() - car.y_m) < 12.0;
      double wants = comes ? 30.0 : 8.0;
      if (kind == 1 && beside) wants = 17.0;
      if (kind == 3 && beside && i % 3000 < 1500) wants = 0.0;
      const double free = gap() - 3.0;
      wants = std::min(wants, free > 0.0 ? std::sqrt(2.0 * 2.5 * free) : 0.0);  // it follows who is before it on its lane
      car.speed_mps += std::clamp(wants - car.speed_mps, -4.0 * kStep_s, 2.0 * kStep_s);
      angle += (comes ? -1.0 : 1.0) * car.speed_mps * kStep_s / radius;
      car.x_m = radius * std::sin(angle), car.y_m = kRadius_m - radius * std::cos(angle), car.heading_rad = comes ? angle + std::numbers::pi : angle;
      std::vector<driver::Footprint> others;
      if (entered) others.push_back(car);
      model.Step(kStep_s, others);
      for (std::uint32_t id = 0; entered && id < 10; ++id) {
        if (model.agent(id).overtaking.active()) ++out_steps[static_cast<std::size_t>(kind)];
        if (model.agent(id).overtaking.gives_up) ++given_up;
      }
      for (const AgentPose& pose : model.poses()) {
        if (!entered) break;
        const driver::Footprint body = FootprintOf(pose, model.traits(pose.id));
        ASSERT_FALSE(driver::Overlap(body, car)) << "kind " << kind << ", car " << pose.id << " at " << i * kStep_s;
        const double past = std::remainder(std::atan2(body.x_m, kRadius_m - body.y_m) - angle, kRound) * radius;
        if (!comes && std::cos(body.heading_rad - car.heading_rad) > 0.0 && before.count(pose.id) != 0 && before[pose.id] < 0.0 && past >= 0.0 && past < 20.0) ++passes;
        before[pose.id] = past;
      }
    }
  }
  EXPECT_GE(passes, 5);
  EXPECT_GT(given_up, 0);
  for (const int steps : out_steps) EXPECT_GT(steps, 0);
}

// In the middle of it, and with several threads.
TEST(Overtaking, RestoredAndByThreadsTheSameBits) {
  const auto network = TwoWayRing(Mark("broken"));
  TrafficSettings threads = Drivers(12);
  threads.threads = 4;
  TrafficModel a = WithSlowOnes(Drivers(12), network), four = WithSlowOnes(threads, network);
  int restored = 0;
  for (int i = 0; i < 50 * 400 && restored < 4; ++i) {
    a.Step(kStep_s, {});
    four.Step(kStep_s, {});
    bool out = false;
    for (std::uint32_t id = 0; id < 12; ++id) out = out || a.agent(id).overtaking.active();
    if (!out || i % 150 != 0) continue;
    ++restored;
    base::StateWriter writer;
    a.Save(writer);
    TrafficModel b = TrafficModel::Make(Drivers(12), network, {}).value();
    base::StateReader reader(writer.bytes());
    b.Restore(reader);
    ASSERT_TRUE(reader.Finish().ok());
    TrafficModel c = a;
    for (int k = 0; k < 600; ++k) {
      b.Step(kStep_s, {});
      c.Step(kStep_s, {});
      ASSERT_EQ(DigestOf(b), DigestOf(c)) << i << " + " << k;
    }
  }
  EXPECT_EQ(restored, 4);
  EXPECT_EQ(DigestOf(a), DigestOf(four));
}

// What a person in the car feels on the way out and back.
TEST(Overtaking, IsComfortable) {
  TrafficModel model = WithSlowOnes(Drivers(12, 2), TwoWayRing(Mark("broken")));
  constexpr double kFine_s = 0.01;
  double lateral = 0.0, jerk = 0.0;
  std::map<std::uint32_t, std::pair<double, double>> before;  // heading, lateral acceleration
  for (int i = 0; i < 30000; ++i) {
    model.Step(kFine_s, {});
    for (const AgentPose& pose : model.poses()) {
      const double heading = FootprintOf(pose, model.traits(pose.id)).heading_rad;
      const auto known = before.find(pose.id);
      double now = 0.0;
      if (known != before.end()) {
        now = pose.speed_mps * std::remainder(heading - known->second.first, kRound) / kFine_s;
        lateral = std::max(lateral, std::fabs(now));
        if (i > 2 && std::fabs(pose.acceleration_mps2) < 0.05) jerk = std::max(jerk, std::fabs(now - known->second.second) / kFine_s);
      }
      before[pose.id] = {heading, now};
    }
  }
  RecordProperty("lateral_mps2", std::to_string(lateral));
  RecordProperty("jerk_mps3", std::to_string(jerk));
  EXPECT_GT(lateral, 0.8);
  EXPECT_LE(lateral, 3.0);
  EXPECT_LE(jerk, 3.0);
}

// N222 with lorries' pace before them: passes happen, and only where the world file's middle line is dashed.
TEST(Overtaking, OnTheHillRoadOnlyWhereTheMiddleIsDashed) {
  const auto file = std::filesystem::path(RODEIRA_SOURCE_DIR) / "configs/worlds/n222.yaml";
  const auto world = road::World::Load(file);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  std::set<std::pair<int, int>> dashed;
  std::ifstream in(file);
  const std::regex line(R"(\{t_m: 0, .*from_s_m: (\d+), to_s_m: (\d+), kind: dashed)");
  std::smatch found;
  for (std::string text; std::getline(in, text);) {
    if (std::regex_search(text, found, line)) dashed.insert({std::stoi(found[1]), std::stoi(found[2])});
  }
  ASSERT_GE(dashed.size(), 15u);
  const auto legal = [&](double s_m) { return std::any_of(dashed.begin(), dashed.end(), [&](const auto& d) { return s_m >= d.first - 0.5 && s_m <= d.second + 0.5; }); };
  TrafficSettings settings = Drivers(14, 3);
  TrafficModel model = TrafficModel::Make(settings, NetworkOf(world.value()), {}).value();
  int over = 0;
  std::set<std::pair<std::uint32_t, std::uint32_t>> who;
  for (int i = 0; i < 20 * 900; ++i) {
    for (std::uint32_t id = 0; id < 14; id += 4) model.CapSpeed(id, 6.0);
    model.Step(0.05, {});
    for (const AgentPose& pose : model.poses()) {
      const driver::Footprint body = FootprintOf(pose, model.traits(pose.id));
      for (const double x : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
          const double c = std::cos(body.heading_rad), s = std::sin(body.heading_rad);
          const Eigen::Vector2d corner(body.x_m + x * body.length_m * c - y * body.width_m * s, body.y_m + x * body.length_m * s + y * body.width_m * c);
          for (const lanes::Graph::Beside& beside : model.graph().TracksAt(corner, 5.0)) {
            const lanes::Track& track = model.graph()[beside.track];
            if (track.lane.lane != pose.lane || beside.foot.d_m <= 0.0 || beside.foot.d_m >= track.length_m()) continue;
            if (beside.foot.offset_m < 0.5 * track.curve.WidthAt(beside.foot.d_m)) continue;
            ++over, who.insert({pose.id, pose.trip});
            EXPECT_TRUE(legal(track.curve.StationAt(beside.foot.d_m))) << "car " << pose.id << " at " << i * 0.05 << " s, s " << track.curve.StationAt(beside.foot.d_m);
          }
        }
      }
    }
    for (std::size_t a = 0; i % 4 == 0 && a < model.poses().size(); ++a) {
      for (std::size_t b = a + 1; b < model.poses().size(); ++b) {
        ASSERT_FALSE(driver::Overlap(FootprintOf(model.poses()[a], model.traits(model.poses()[a].id)), FootprintOf(model.poses()[b], model.traits(model.poses()[b].id)))) << i * 0.05;
      }
    }
  }
  EXPECT_GT(over, 0);
  EXPECT_GE(who.size(), 4u);
}

}  // namespace
}  // namespace rodeira::traffic
