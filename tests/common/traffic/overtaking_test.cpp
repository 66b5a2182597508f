// SPDX-License-Identifier: Apache-2.0
// Overtaking on the lane of oncoming traffic: everything is told from the published poses.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "common/traffic/results/study.hpp"
#include "tests/common/traffic/digest_of.hpp"
#include "tests/common/traffic/two_way_ring.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.02;
constexpr double kLeast_s = 2.0;  // oncoming traffic needs at least so long to where a vehicle is back on its side

TrafficSettings Drivers(std::uint32_t vehicles, std::uint64_t seed = 1) {
  TrafficSettings settings;
  settings.vehicles = vehicles;
  settings.seed = seed;
  settings.speed_factor_low = 0.9;
  return settings;
}

// Two crawl, one in each direction.
TrafficModel WithSlowOnes(const TrafficSettings& settings, const std::shared_ptr<const network::Network>& network) {
  TrafficModel model = TrafficModel::Make(settings, network, {}).value();
  model.CapSpeed(3, 8.0);
  model.CapSpeed(9, 8.0);
  return model;
}

// Slow ones are passed against oncoming traffic by all behind them; oncoming traffic is never nearer than two seconds
// when a vehicle is back on its side; no vehicle touches another. One that goes over indicates to that side, before it
// is over, and to the other one on the way back.
void PassesInTime(bool left_hand) {
  const auto network = TwoWayRing(Mark("broken"), left_hand);
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    TrafficModel model = WithSlowOnes(Drivers(12, seed), network);
    RingWatch watch(left_hand);
    const std::uint32_t out = left_hand ? 4u : 2u, in = left_hand ? 2u : 4u;
    std::map<std::uint32_t, std::pair<bool, bool>> shown;  // to the other side, and back
    for (int i = 0; i < 50 * 500; ++i) {
      model.Step(kStep_s, {});
      const std::size_t before = watch.crossings.size();
      watch.Observe(model, i * kStep_s);
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
    for (const RingWatch::Crossing& c : watch.crossings) {
      EXPECT_GE(c.spare_s, kLeast_s) << seed << ": car " << c.id << " from " << c.from_m << " to " << c.to_m;
      EXPECT_LT(c.length_s, 30.0);
    }
  }
}

TEST(Overtaking, SlowOnesArePassedBeforeOncomingTrafficIsNear) { PassesInTime(false); }
TEST(Overtaking, MirroredInLeftHandTraffic) { PassesInTime(true); }

// More of them, which come closer to one another: no vehicle touches another, and one that goes over is back in time.
TEST(Overtaking, DenseTrafficBothWaysIsSafe) {
  std::size_t crossings = 0;
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    TrafficSettings settings = Drivers(20, seed);
    settings.mix.shares = {0.7, 0.1, 0.15, 0.05};
    settings.speed_factor_low = 0.6;
    TrafficModel model = WithSlowOnes(settings, TwoWayRing(Mark("broken")));
    RingWatch watch;
    for (int i = 0; i < 25 * 400; ++i) {
      model.Step(0.04, {});
      watch.Observe(model, i * 0.04);
    }
    crossings += watch.crossings.size();
    EXPECT_TRUE(watch.touches.empty()) << seed;
    for (const RingWatch::Crossing& c : watch.crossings) EXPECT_GE(c.spare_s, kLeast_s) << seed << ": car " << c.id;
  }
  EXPECT_GE(crossings, 3u);
}

// Marks, signs and settings: where they say no, no vehicle is on the other side.
TEST(Overtaking, MarksAndSignsAreKept) {
  const auto run = [](const std::shared_ptr<const network::Network>& network, const TrafficSettings& settings) {
    TrafficModel model = WithSlowOnes(settings, network);
    RingWatch watch;
    for (int i = 0; i < 20 * 300; ++i) {
      model.Step(0.05, {});
      watch.Observe(model, i * 0.05);
    }
    return watch;
  };
  const auto count = [&](const std::shared_ptr<const network::Network>& network, bool with) {
    const RingWatch watch = run(network, Drivers(12, 2));
    return std::count_if(watch.crossings.begin(), watch.crossings.end(),
                         [&](const RingWatch::Crossing& c) { return c.with == with; });
  };
  EXPECT_EQ(count(TwoWayRing(Mark("solid")), true) + count(TwoWayRing(Mark("solid")), false), 0);
  EXPECT_EQ(count(TwoWayRing(Mark("solid solid")), true), 0);
  // Of two lines the one on the own side counts.
  const auto one = TwoWayRing(Mark("solid broken")), other = TwoWayRing(Mark("broken solid"));
  EXPECT_EQ((count(one, true) > 0) + (count(one, false) > 0), 1);
  EXPECT_EQ((count(other, true) > 0) + (count(other, false) > 0), 1);
  EXPECT_NE(count(one, true) > 0, count(other, true) > 0);
  // Dashed for a part of the road.
  const RingWatch part = run(TwoWayRing(Mark("broken") + Mark("solid", 1800.0)), Drivers(12, 2));
  EXPECT_GT(part.crossings.size(), 0u);
  for (const RingWatch::Crossing& c : part.crossings)
    EXPECT_TRUE(std::max(c.from_m, c.to_m) <= 1800.0) << c.from_m << " to " << c.to_m;
  const auto sign = TwoWayRing(Mark("broken"), false,
                               "<signals><signal id=\"s\" s=\"5\" t=\"-5\" type=\"276\" subtype=\"-1\" "
                               "orientation=\"+\" dynamic=\"no\"/></signals>");
  EXPECT_EQ(count(sign, true), 0);
  EXPECT_GT(count(sign, false), 0);
  TrafficSettings never = Drivers(12, 2);
  never.overtaking.allowed = false;
  EXPECT_TRUE(run(TwoWayRing(Mark("broken")), never).crossings.empty());
}

// A driver's car that crawls is passed; one that goes faster as soon as somebody is beside it, one that comes faster
// than the law allows, and one that stops: no vehicle drives into it.
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
          for (const AgentPose& pose : model.poses())
            free = free &&
                   std::fabs(std::remainder(std::atan2(pose.p_WB_W.x(), kRadius_m - pose.p_WB_W.y()) - angle, kRound)) *
                           radius >
                       120.0;
          if (free) break;
        }
        entered = angle < kRound;
      }
      bool beside = false;
      for (const AgentPose& pose : model.poses())
        beside = beside || std::hypot(pose.p_WB_W.x() - car.x_m, pose.p_WB_W.y() - car.y_m) < 12.0;
      double wants = comes ? 30.0 : 8.0;
      if (kind == 1 && beside) wants = 17.0;
      if (kind == 3 && beside && i % 3000 < 1500) wants = 0.0;
      const double free = gap() - 3.0;
      wants = std::min(wants, free > 0.0 ? std::sqrt(2.0 * 2.5 * free) : 0.0);  // it follows its leader
      car.speed_mps += std::clamp(wants - car.speed_mps, -4.0 * kStep_s, 2.0 * kStep_s);
      angle += (comes ? -1.0 : 1.0) * car.speed_mps * kStep_s / radius;
      car.x_m = radius * std::sin(angle), car.y_m = kRadius_m - radius * std::cos(angle),
      car.heading_rad = comes ? angle + std::numbers::pi : angle;
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
        if (!comes && std::cos(body.heading_rad - car.heading_rad) > 0.0 && before.count(pose.id) != 0 &&
            before[pose.id] < 0.0 && past >= 0.0 && past < 20.0)
          ++passes;
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
        if (i > 2 && std::fabs(pose.acceleration_mps2) < 0.05)
          jerk = std::max(jerk, std::fabs(now - known->second.second) / kFine_s);
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

}  // namespace
}  // namespace rodeira::traffic
