// SPDX-License-Identifier: Apache-2.0
// Changes of lanes: each against MOBIL's inequality, worked out here from the published poses alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/traffic/results/study.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/traffic/scripted.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kRadius_m = 500.0, kLaneWidth_m = 3.5, kLimit_mps = 30.0, kRound = 2.0 * std::numbers::pi,
                 kNoLeader_m = 1e9;
constexpr double kExact_mps2 =
    1e-3;  // what a centimetre of gap makes at most: poses are of the middle between the axles

// Two lanes of one direction around a circle to the left, each going on into itself, with a mark of the given type
// between them. One keeps to lane 2, the road's outer one; in left-hand traffic it lies towards the circle's middle.
std::shared_ptr<const network::Network> TwoLaneRing(const std::string& mark = "broken", bool left_hand = false) {
  opendrive::RoadText road = CircleRoad(kRound * kRadius_m, left_hand);
  const auto lane = [&](int id) { return CircleLane(id, kLimit_mps, Mark(std::abs(id) == 1 ? mark : "solid")); };
  road.left = left_hand ? lane(2) + lane(1) : "";
  road.right = left_hand ? "" : lane(-1) + lane(-2);
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

TrafficSettings Drivers(std::uint32_t vehicles, std::uint64_t seed = 1) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.seed = seed;
  settings.speed_factor_low = 0.5;
  return settings;
}

// A car on the ring as its pose says: which lane's middle is nearer, and how far around.
struct Seen {
  std::uint32_t id;
  int lane;  // 1: the one to pass on, 2: the one to keep to
  double angle;
  double speed_mps, length_m;
  bool changing;
};

class RingSeen {
 public:
  explicit RingSeen(const TrafficModel& model, bool left_hand = false) : model_(model), left_hand_(left_hand) {
    for (const AgentPose& pose : model.poses()) {
      const double x = pose.p_WB_W.x(), y = pose.p_WB_W.y() - kRadius_m, r = std::hypot(x, y);
      const int lane = std::fabs(r - RadiusOf(1)) < std::fabs(r - RadiusOf(2)) ? 1 : 2;
      seen_.push_back({pose.id, lane, std::atan2(x, -y), pose.speed_mps, model.traits(pose.id).length_m,
                       model.agent(pose.id).change.side != 0});
    }
  }
  double RadiusOf(int lane) const {
    return kRadius_m + (left_hand_ ? -1.0 : 1.0) * (lane == 1 ? 0.5 : 1.5) * kLaneWidth_m;
  }

  struct Verdict {
    std::vector<std::uint32_t> near;
    bool clean;  // none near is on both lanes
    bool safe;
    double surplus_mps2;
  };
  // MOBIL's own words for a change of this car to the other lane.
  Verdict Judge(std::uint32_t id) const {
    const Seen& me = *std::find_if(seen_.begin(), seen_.end(), [&](const Seen& s) { return s.id == id; });
    const int other = 3 - me.lane;
    const Seen *leader = Next(me, me.lane, true), *then_leader = Next(me, other, true);
    const Seen *old_follower = Next(me, me.lane, false), *new_follower = Next(me, other, false);
    for (const Seen* near : {leader, then_leader, old_follower, new_follower}) {
      if (near != nullptr && near->changing) return {{}, false, false, 0.0};
    }
    const double gap = leader == nullptr ? kNoLeader_m : Gap(me, *leader, me.lane),
                 then_gap = then_leader == nullptr ? kNoLeader_m : Gap(me, *then_leader, other);
    const double a_c = Idm(me, leader, gap), then_c = Idm(me, then_leader, then_gap);
    double a_o = 0.0, then_o = 0.0, a_n = 0.0, then_n = 0.0;
    if (old_follower != nullptr) {
      const double behind = Gap(*old_follower, me, me.lane);
      a_o = Idm(*old_follower, &me, behind), then_o = Idm(*old_follower, leader, behind + me.length_m + gap);
    }
    if (new_follower != nullptr) {
      const double behind = Gap(*new_follower, me, other);
      a_n = Idm(*new_follower, then_leader, behind + me.length_m + then_gap), then_n = Idm(*new_follower, &me, behind);
    }
    const driver::MobilSettings mobil;
    const bool room = (then_leader == nullptr || Gap(me, *then_leader, other) > 2.0) &&
                      (new_follower == nullptr || Gap(*new_follower, me, other) > 2.0);
    const double bias = other == 2 ? mobil.bias_mps2 : -mobil.bias_mps2;
    std::vector<std::uint32_t> near;
    for (const Seen* seen : {leader, then_leader, old_follower, new_follower}) {
      if (seen != nullptr) near.push_back(seen->id);
    }
    return {near, true, room && then_n >= -mobil.safe_mps2 && then_c >= -mobil.safe_mps2,
            then_c - a_c + mobil.politeness * (then_n - a_n + then_o - a_o) - mobil.threshold_mps2 + bias};
  }
  const std::vector<Seen>& seen() const { return seen_; }

 private:
  // The next one on a lane: before it, or within 200 m behind it.
  const Seen* Next(const Seen& me, int lane, bool ahead) const {
    const Seen* next = nullptr;
    double least = 1e9;
    for (const Seen& s : seen_) {
      if (s.id == me.id || (s.lane != lane && !s.changing)) continue;
      const double around = std::remainder((s.angle - me.angle) * (ahead ? 1.0 : -1.0), kRound);
      if (around < 0.0 || around >= least || (!ahead && Gap(s, me, lane) >= 200.0)) continue;
      least = around, next = &s;
    }
    return next;
  }
  double Gap(const Seen& behind, const Seen& ahead, int lane) const {
    return std::remainder(ahead.angle - behind.angle, kRound) * RadiusOf(lane) -
           0.5 * (ahead.length_m + behind.length_m);
  }
  double Idm(const Seen& car, const Seen* leader, double s) const {
    const AgentTraits& traits = model_.traits(car.id);
    const driver::IdmSettings& idm = traits.idm;
    const double v = car.speed_mps, v0 = std::min(kLimit_mps * traits.speed_factor, model_.agent(car.id).cap_mps);
    double a = v <= v0 ? idm.acceleration_mps2 * (1.0 - std::pow(v / v0, 4.0))
                       : -idm.braking_mps2 * (1.0 - std::pow(v0 / v, 4.0 * idm.acceleration_mps2 / idm.braking_mps2));
    if (leader != nullptr && s < 200.0) {
      const double wanted =
          idm.min_gap_m +
          std::max(0.0, v * idm.time_gap_s +
                            v * (v - leader->speed_mps) / (2.0 * std::sqrt(idm.acceleration_mps2 * idm.braking_mps2)));
      a -= idm.acceleration_mps2 * (wanted / s) * (wanted / s);
      if (s <= 0.0) a = -idm.max_deceleration_mps2;
    }
    return std::clamp(a, -idm.max_deceleration_mps2, idm.acceleration_mps2);
  }

  const TrafficModel& model_;
  bool left_hand_;
  std::vector<Seen> seen_;
};

// A vehicle that changes lanes has MOBIL's leave, and a vehicle that has had it for longer than the time between two
// looks has gone.
void ChangesAsMobilSays(bool left_hand) {
  const auto network = TwoLaneRing("broken", left_hand);
  int changes = 0, judged = 0, to_keep = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    TrafficModel model = TrafficModel::Make(Drivers(40, seed), network, {}).value();
    std::map<std::uint32_t, double> due_s, settled_s;
    for (int i = 0; i < 8000; ++i) {
      const RingSeen before(model, left_hand);
      std::map<std::uint32_t, RingSeen::Verdict> verdicts;
      for (const Seen& s : before.seen()) {
        if (s.changing)
          settled_s[s.id] = 0.0;
        else
          settled_s[s.id] += 0.02;
        if (!s.changing) verdicts[s.id] = before.Judge(s.id);
      }
      model.Step(0.02, {});
      for (const auto& [id, verdict] : verdicts) {
        const bool began = model.agent(id).change.side != 0;
        // One that began in the same step was seen by some and not by others.
        const bool clean =
            verdict.clean && std::none_of(verdict.near.begin(), verdict.near.end(),
                                          [&](std::uint32_t n) { return model.agent(n).change.side != 0; });
        if (began) ++changes;
        if (began && (model.agent(id).change.side < 0) != left_hand) ++to_keep;
        if (began && clean) {
          ++judged;
          EXPECT_TRUE(verdict.safe) << id << " at " << 0.02 * i;
          EXPECT_GT(verdict.surplus_mps2, -kExact_mps2) << id << " at " << 0.02 * i;
        }
        const bool wants = clean && verdict.safe && verdict.surplus_mps2 > kExact_mps2 && settled_s[id] > 4.1 &&
                           !began && model.agent(id).speed_mps > 3.1;
        due_s[id] = wants ? due_s[id] + 0.02 : 0.0;
        EXPECT_LT(due_s[id], 0.57) << id << " at " << 0.02 * i;
      }
    }
  }
  EXPECT_GT(judged, 30);
  EXPECT_GT(to_keep, changes / 4);
  EXPECT_LT(to_keep, 3 * changes / 4 + 3);
  ::testing::Test::RecordProperty("changes", changes);
}

TEST(LaneChange, EachChangeIsWhatMobilSays) { ChangesAsMobilSays(false); }
TEST(LaneChange, MirroredInLeftHandTraffic) { ChangesAsMobilSays(true); }

// Alone on the road every vehicle comes to the lane to keep to, and stays there.
TEST(LaneChange, AFreeRoadIsDrivenOnItsOuterLane) {
  for (const bool left_hand : {false, true}) {
    TrafficModel model = TrafficModel::Make(Drivers(6), TwoLaneRing("broken", left_hand), {}).value();
    for (int i = 0; i < 3000; ++i) model.Step(0.02, {});
    int outer = 0, looked = 0;
    for (int i = 0; i < 3000; ++i) {
      model.Step(0.02, {});
      for (const AgentPose& pose : model.poses()) outer += std::abs(pose.lane) == 2, ++looked;
    }
    EXPECT_GT(outer, 0.6 * looked) << left_hand;
  }
}

// A lorry's pace before them: every other vehicle passes it, on the side for it, and no vehicle touches another.
TEST(LaneChange, ASlowOneIsPassedByAll) {
  TrafficSettings settings = Drivers(12);
  settings.speed_factor_low = 0.9;
  TrafficModel model = TrafficModel::Make(settings, TwoLaneRing(), {}).value();
  model.CapSpeed(5, 12.0);
  std::vector<double> passed(12, 0.0);  // angle gained on the slow one
  std::vector<double> before(12, 0.0);
  int inside = 0;  // on the side to pass on
  for (int i = 0; i < 30000; ++i) {
    model.Step(0.02, {});
    const RingSeen ring(model);
    const Seen& slow = ring.seen()[5];
    for (const Seen& s : ring.seen()) {
      const double gained = std::remainder(s.angle - slow.angle, kRound);
      if (i > 0 && s.id != 5 && before[s.id] < 0.0 && gained >= 0.0 && gained < 0.1)
        inside += s.lane == 1 && slow.lane == 2;
      if (i > 0) passed[s.id] += std::remainder(gained - before[s.id], kRound);
      before[s.id] = gained;
    }
    if (i % 5 != 0) continue;
    for (std::size_t a = 0; a < model.poses().size(); ++a) {
      for (std::size_t b = a + 1; b < model.poses().size(); ++b) {
        ASSERT_FALSE(driver::Overlap(FootprintOf(model.poses()[a], model.traits(model.poses()[a].id)),
                                     FootprintOf(model.poses()[b], model.traits(model.poses()[b].id))))
            << 0.02 * i;
      }
    }
  }
  for (std::uint32_t id = 0; id < 12; ++id) {
    if (id == 5) continue;
    EXPECT_GT(passed[id], kRound) << id;
  }
  EXPECT_GE(inside, 11);
}

// A continuous line is not crossed, nor one that is continuous on the own side.
TEST(LaneChange, MarksAreKept) {
  struct Case {
    const char* mark;
    bool in, out;
  };
  for (const Case& c : {Case{"solid", false, false},
                        {"solid solid", false, false},
                        {"solid broken", true, false},
                        {"broken solid", false, true},
                        {"none", true, true}}) {
    TrafficModel model = TrafficModel::Make(Drivers(30), TwoLaneRing(c.mark), {}).value();
    int in = 0, out = 0;
    for (int i = 0; i < 4000; ++i) {
      std::vector<int> before;
      for (std::uint32_t id = 0; id < 30; ++id) before.push_back(model.agent(id).change.side);
      model.Step(0.05, {});
      for (std::uint32_t id = 0; id < 30; ++id) {
        in += before[id] == 0 && model.agent(id).change.side > 0,
            out += before[id] == 0 && model.agent(id).change.side < 0;
      }
    }
    EXPECT_EQ(in > 0, c.in) << c.mark;
    EXPECT_EQ(out > 0, c.out) << c.mark;
  }
}

// What a person in the car feels: from the published headings and speeds, not from the plan.
TEST(LaneChange, IsComfortable) {
  TrafficModel model = TrafficModel::Make(Drivers(40), TwoLaneRing(), {}).value();
  struct Felt {
    double heading, lateral_mps2;
    int steps;
  };
  std::map<std::uint32_t, Felt> felt;
  double lateral = 0.0, jerk = 0.0, yaw = 0.0;
  constexpr double kStep_s = 0.01;
  std::map<std::uint32_t, double> yaw_rate;
  for (int i = 0; i < 20000; ++i) {
    model.Step(kStep_s, {});
    for (const AgentPose& pose : model.poses()) {
      const double heading = FootprintOf(pose, model.traits(pose.id)).heading_rad;
      Felt& f = felt[pose.id];
      if (f.steps > 0) {
        const double rate = std::remainder(heading - f.heading, kRound) / kStep_s;
        const double now = pose.speed_mps * rate;
        lateral = std::max(lateral, std::fabs(now));
        // Where the speed changes so does v² κ; that is not the steering's.
        if (f.steps > 1 && std::fabs(pose.acceleration_mps2) < 0.05)
          jerk = std::max(jerk, std::fabs(now - f.lateral_mps2) / kStep_s);
        if (f.steps > 1) yaw = std::max(yaw, std::fabs(rate - yaw_rate[pose.id]) / kStep_s);
        f.lateral_mps2 = now;
        yaw_rate[pose.id] = rate;
      }
      f.heading = heading;
      ++f.steps;
    }
  }
  RecordProperty("lateral_mps2", std::to_string(lateral));
  RecordProperty("jerk_mps3", std::to_string(jerk));
  EXPECT_GT(lateral, kLimit_mps * kLimit_mps * 0.25 / kRadius_m);
  EXPECT_LE(lateral, 3.0);
  EXPECT_LE(jerk, 3.0);
  EXPECT_LE(yaw, 200.0 * std::numbers::pi / 180.0);
}

// Two roads of two lanes to the east, the one going on as the other from x = kJoin_m on.
constexpr double kJoin_m = 400.0;
std::shared_ptr<const network::Network> TwoRoads() {
  const std::string lanes = CircleLane(-1, kLimit_mps, Mark("broken")) + CircleLane(-2, kLimit_mps, Mark("solid"));
  opendrive::RoadText one, other;
  one.left = other.left = "";
  one.right = other.right = lanes;
  one.length = other.length = kJoin_m;
  one.geometry = fmt::format("<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"{}\"><line/></geometry>", kJoin_m);
  other.id = "2";
  other.geometry =
      fmt::format("<geometry s=\"0\" x=\"{0}\" y=\"0\" hdg=\"0\" length=\"{0}\"><line/></geometry>", kJoin_m);
  one.link = "<successor elementType=\"road\" elementId=\"2\" contactPoint=\"start\"/>";
  other.link = "<predecessor elementType=\"road\" elementId=\"1\" contactPoint=\"end\"/>";
  return opendrive::MustRead(opendrive::Document(one.Text() + other.Text()));
}

// One that has gone over sees no vehicle on the lane that it has left, though its rear is not quite there yet, where
// its front comes onto another road as well: one that crawls there, and appears when it is clear of that lane, is
// nothing to it. Until now the front's piece of path there began without an offset, and it seemed to be at the
// beginning of its change again.
TEST(LaneChange, AfterALaneChangeTheOldLaneIsClearOnTheNextRoadToo) {
  constexpr double kSpeed_mps = 15.0, kAhead_m = 30.0;
  int came_onto_it = 0;
  for (double before_m = 66.0; before_m < 80.0; before_m += 0.5) {
    TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), TwoRoads(), {}).value();
    Put(model, 0, "1:-2", kJoin_m - before_m, kSpeed_mps);
    model.CapSpeed(0, kSpeed_mps);
    Step(model);
    model.CommandLaneChange(0, 1);
    Step(model);
    ASSERT_EQ(model.agent(0).change.side, 1) << before_m;
    const auto& agent = model.agent(0);
    const double half_m = 0.5 * model.traits(0).length_m;
    while (agent.o_m + half_m < agent.change.from_m + 0.8 * (agent.change.to_m - agent.change.from_m)) Step(model);
    const double s_m = kAhead_m + PoseOf(model, 0)->p_WB_W.x();
    Put(model, 1, "2:-2", s_m - kJoin_m, 2.0);
    model.CapSpeed(1, 2.0);
    for (bool goes_over = true; goes_over;) {
      Step(model);
      goes_over = agent.change.side != 0;
      if (goes_over && agent.o_m + half_m > agent.change.to_m && agent.path.size() > 1 &&
          agent.path.back().begin_m > agent.change.to_m)
        ++came_onto_it;
      ASSERT_EQ(model.GapAhead(0), kNoLeader_m)
          << before_m << " m before the road's end, at " << PoseOf(model, 0)->p_WB_W.x() << " m";
      ASSERT_FALSE(model.Hurries(0)) << before_m;
    }
  }
  EXPECT_GT(came_onto_it, 10);
}

// One that leaves a lane on which a vehicle crawls brakes for that one until it is clear of it, though a vehicle nearer
// drives away before it on the new lane: no vehicle comes into an emergency.
TEST(LaneChange, ACrawlingCarOnTheOldLaneIsSeenBeyondALeaderThatDrivesAwayOnTheNewOne) {
  constexpr double kSpeed_mps = 12.0, kAway_mps = 14.0, kCrawls_mps = 1.0;
  int hidden = 0;
  for (double stands_m = 70.0; stands_m < 120.0; stands_m += 2.0) {
    for (const double away_m : {25.0, 35.0, 45.0}) {
      TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar, kCar}), TwoLaneRing(), {}).value();
      Put(model, 0, "1:-2", 400.0, kSpeed_mps);
      Put(model, 1, "1:-1", 400.0 + away_m, kAway_mps);
      Put(model, 2, "1:-2", 400.0 + stands_m, kCrawls_mps);
      model.CapSpeed(1, kAway_mps);
      model.CapSpeed(2, kCrawls_mps);
      Step(model);
      ASSERT_EQ(model.on_road(), 3u) << stands_m;
      model.CommandLaneChange(0, 1);
      for (int i = 0; i * kStep_s < 20.0 && (i == 0 || model.agent(0).change.side != 0); ++i) {
        Step(model);
        if (i == 0) {
          ASSERT_EQ(model.agent(0).change.side, 1) << stands_m << " " << away_m;
        }
        ASSERT_FALSE(model.Hurries(0)) << "one crawls " << stands_m << " m ahead, one drives away " << away_m
                                       << " m ahead, after " << i * kStep_s << " s";
        if (i == 0 && model.GapAhead(0) > away_m) ++hidden;
      }
      EXPECT_EQ(model.agent(0).change.side, 0) << stands_m << " " << away_m;
    }
  }
  EXPECT_GT(hidden, 10);  // the one that lets it drive on less is farther away
}

// A change that begins behind a standing car ends beside it: no vehicle stays between two lanes. From too near no
// change begins, and the vehicle stands behind that car on its lane. The boxes never overlap.
TEST(LaneChange, AChangeBehindAStandingCarEnds) {
  int passed = 0, stayed = 0;
  for (double stands_m = 12.0; stands_m < 90.0; stands_m += 6.0) {
    TrafficModel model = TrafficModel::Make(OnlyScripted({kCar, kCar}), TwoLaneRing(), {}).value();
    Put(model, 0, "1:-2", 400.0, 8.0);
    Put(model, 1, "1:-2", 400.0 + stands_m, 0.0);
    model.Brake(1, 2.0);
    Step(model);
    if (model.on_road() < 2) continue;  // no room for both
    model.CommandLaneChange(0, 1);
    int changing = 0;
    for (int i = 0; i * kStep_s < 40.0; ++i) {
      Step(model);
      const AgentPose &one = *PoseOf(model, 0), &other = *PoseOf(model, 1);
      ASSERT_FALSE(driver::Overlap(FootprintOf(one, model.traits(0)), FootprintOf(other, model.traits(1)))) << stands_m;
      changing = model.agent(0).change.side == 0 ? 0 : changing + 1;
      ASSERT_LT(changing * kStep_s, 20.0) << stands_m;
    }
    ++(model.agent(0).speed_mps > 5.0 ? passed : stayed);
    EXPECT_EQ(model.agent(0).change.side, 0) << stands_m;
  }
  EXPECT_GT(passed, 6);
  EXPECT_GT(stayed, 0);
}

TEST(LaneChange, RestoredInTheMiddleOfAChangeItGoesOnWithTheSameBits) {
  const auto network = TwoLaneRing();
  TrafficModel a = TrafficModel::Make(Drivers(40), network, {}).value();
  int restored = 0;
  for (int i = 0; i < 6000 && restored < 5; ++i) {
    a.Step(0.02, {});
    int changing = 0;
    for (std::uint32_t id = 0; id < 40; ++id) changing += a.agent(id).change.side != 0;
    if (changing < 2 || i % 100 != 0) continue;
    ++restored;
    base::StateWriter writer;
    a.Save(writer);
    TrafficModel b = TrafficModel::Make(Drivers(40), network, {}).value();
    base::StateReader reader(writer.bytes());
    b.Restore(reader);
    ASSERT_TRUE(reader.Finish().ok());
    TrafficModel c = a;
    for (int k = 0; k < 300; ++k) {
      b.Step(0.02, {});
      c.Step(0.02, {});
      ASSERT_EQ(DigestOf(b), DigestOf(c)) << i << " + " << k;
    }
  }
  EXPECT_EQ(restored, 5);
}

}  // namespace
}  // namespace rodeira::traffic
