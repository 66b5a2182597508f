// SPDX-License-Identifier: Apache-2.0
// A vehicle gets in an agent's way: where half a second of reaction and braking at mu g suffice, the agent does not hit
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/curves.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.02, kReaction_s = 0.5, kGrip_mps2 = 0.8 * 9.81, kFor_s = 12.0;
constexpr double kLane_y = -1.75;  // of the lane's middle; its traffic goes along x

std::shared_ptr<const network::Network> Straight() {
  opendrive::RoadText road;
  road.length = 4000.0;
  road.geometry = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"4000\"><line/></geometry>";
  road.left = "";
  road.right =
      "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/><speed sOffset=\"0\" "
      "max=\"36\" unit=\"m/s\"/></lane>";
  return opendrive::MustRead(opendrive::Document(road.Text()));
}

// How a vehicle comes in: from beside into the lane and perhaps braking, across it, against it, or there all at once.
struct Intruder {
  enum Kind { kCutsIn, kCrosses, kAgainst, kAppears };
  int kind;
  double x_m, y_m, speed_mps, heading_rad, brakes_mps2, sideways_s;

  static Intruder Draw(std::uint64_t number, double front_m, double agent_mps) {
    std::uint64_t key = 0;
    const auto draw = [&](double low, double high) { return base::RandomUniform({77, number, ++key}, low, high); };
    Intruder i{};
    i.kind = static_cast<int>(draw(0.0, 4.0));
    const double gap = draw(2.0, 30.0 + 4.0 * agent_mps);
    i.y_m = kLane_y;
    if (i.kind == kCutsIn)
      i.y_m += draw(0.0, 1.0) < 0.5 ? 3.5 : -3.5, i.speed_mps = draw(0.3, 1.2) * agent_mps,
                                                  i.brakes_mps2 = draw(0.0, 7.0), i.sideways_s = draw(1.0, 4.0);
    if (i.kind == kCrosses)
      i.speed_mps = draw(1.0, 15.0),
      i.heading_rad = draw(0.0, 1.0) < 0.5 ? std::numbers::pi / 2 : -std::numbers::pi / 2;
    if (i.kind == kCrosses) i.y_m -= std::copysign(draw(3.0, 40.0), i.heading_rad);
    if (i.kind == kAgainst)
      i.heading_rad = std::numbers::pi, i.speed_mps = draw(0.0, 10.0), i.brakes_mps2 = draw(0.5, 7.0);
    if (i.kind == kAppears) i.heading_rad = draw(-3.1, 3.1), i.y_m += draw(-1.5, 1.5);
    i.x_m = front_m + gap + 2.2;
    return i;
  }
  driver::Footprint At(double t) const {
    const double stops = brakes_mps2 > 0.0 ? speed_mps / brakes_mps2 : 1e9, moving = std::min(t, stops);
    const double way = speed_mps * moving - 0.5 * brakes_mps2 * moving * moving,
                 speed = std::max(0.0, speed_mps - brakes_mps2 * t);
    driver::Footprint f{
        9999, x_m + way * std::cos(heading_rad), y_m + way * std::sin(heading_rad), heading_rad, speed, 4.4, 1.8};
    if (kind == kCutsIn) {
      const double u = std::min(1.0, t / sideways_s);
      f.y_m += (kLane_y - y_m) * u * u * (3.0 - 2.0 * u);
    }
    return f;
  }
  // Whether it is in the way of a car of that width in the lane.
  static bool InTheWay(const driver::Footprint& f, double width_m) {
    const double across =
        0.5 * (std::fabs(std::sin(f.heading_rad)) * f.length_m + std::fabs(std::cos(f.heading_rad)) * f.width_m);
    return std::fabs(f.y_m - kLane_y) < across + 0.5 * width_m + 0.3;
  }
};

driver::Footprint CarAt(double x_m, double speed_mps, const AgentTraits& traits) {
  return {0, x_m, kLane_y, 0.0, speed_mps, traits.length_m, traits.width_m};
}

// Whether one that keeps its speed for the reaction's time, from when it is in the way, and then brakes as hard as it
// can, gets by without driving into it. What drives into a car at rest is not that one's doing.
bool Suffices(const Intruder& intruder, double x_m, double speed_mps, const AgentTraits& traits) {
  double since = -1.0, x = x_m, v = speed_mps;
  for (double t = 0.0; t < kFor_s; t += 0.005) {
    const driver::Footprint other = intruder.At(t);
    if (since < 0.0 && Intruder::InTheWay(other, traits.width_m)) since = t;
    if (driver::Overlap(CarAt(x, v, traits), other)) return v <= 0.0;
    const double before = v;
    if (since >= 0.0 && t > since + kReaction_s) v = std::max(0.0, v - 0.005 * kGrip_mps2);
    x += 0.0025 * (before + v);
  }
  return true;
}

// What became of so many drawn intrusions: whether half a second and 0.8 g sufficed, and whether a vehicle was driven
// into all the same.
struct Intruded {
  std::uint64_t sufficed = 0, hopeless = 0;
  PlotCurve could{"half a second and 0.8 g suffice: no vehicle is hit", "#1f5f8b", {}, false},
      hit{"hit all the same", "#b03020", {}, false}, beyond{"they do not suffice", "#b8b8b8", {}, false};
};

// One after another before each of these in turn, each the only one on its road.
Intruded Intrude(const std::vector<TrafficModel>& driving, std::uint64_t count, double step_s) {
  Intruded told;
  for (std::uint64_t number = 0; number < count; ++number) {
    TrafficModel model = driving[number % driving.size()];
    const AgentTraits& traits = model.traits(0);
    const AgentPose start = model.poses()[0];
    const Intruder intruder = Intruder::Draw(number, start.p_WB_W.x() + 0.5 * traits.length_m, start.speed_mps);
    const std::pair<double, double> drawn(start.speed_mps,
                                          intruder.x_m - 2.2 - start.p_WB_W.x() - 0.5 * traits.length_m);
    if (!Suffices(intruder, start.p_WB_W.x(), start.speed_mps, traits)) {
      ++told.hopeless;
      told.beyond.points.push_back(drawn);
      continue;
    }
    ++told.sufficed;
    told.could.points.push_back(drawn);
    for (double t = 0.0; t < kFor_s && model.on_road() == 1; t += step_s) {
      const std::vector<driver::Footprint> others{intruder.At(t)};
      model.Step(step_s, others);
      if (model.on_road() == 0) break;
      const AgentPose& pose = model.poses()[0];
      const bool touches = driver::Overlap(FootprintOf(pose, traits), intruder.At(t + step_s)),
                 hits = touches && pose.speed_mps > 0.05;
      EXPECT_FALSE(hits) << "intruder " << number << " of kind " << intruder.kind << " at " << t << " s, "
                         << start.speed_mps << " m/s, " << pose.speed_mps << " m/s when it touches, a car of kind "
                         << static_cast<int>(traits.kind);
      if (hits) told.hit.points.push_back(drawn);
      if (touches) break;
    }
  }
  EXPECT_GT(told.sufficed, count / 2);
  EXPECT_GT(told.hopeless, count / 50);
  return told;
}

// RODEIRA_INTRUSIONS: how many (400; tests/run --endurance traffic takes 10 000).
std::uint64_t Intrusions() {
  const char* text = std::getenv("RODEIRA_INTRUSIONS");
  return text == nullptr ? 400 : std::strtoull(text, nullptr, 10);
}

// Alone on that road, as fast as `cap_mps` or the driver wishes, ten seconds after it came.
TrafficModel Alone(const TrafficSettings& settings, const std::shared_ptr<const network::Network>& network,
                   double cap_mps, double step_s) {
  TrafficModel model = TrafficModel::Make(settings, network, {}).value();
  model.CapSpeed(0, cap_mps);
  for (double t = 0.0; t < 10.0; t += step_s) model.Step(step_s, {});
  EXPECT_EQ(model.on_road(), 1u);
  return model;
}

constexpr std::array<double, 7> kCaps_mps = {6.0, 10.0, 14.0, 19.0, 25.0, 31.0, 36.0};

TEST(Intrusion, NothingThatCouldBeAvoidedIsHit) {
  const auto network = Straight();
  std::vector<TrafficModel> driving;  // by speed
  for (const double cap : kCaps_mps) driving.push_back(Alone(Identical(1, 1.4), network, cap, kStep_s));
  const Intruded told = Intrude(driving, Intrusions(), kStep_s);
  EXPECT_TRUE(
      WritePicture("traffic_intrusions.svg", PlotSvg("Who gets in the way", "speed of the car, m/s", "how far ahead, m",
                                                     5.0, 25.0, {told.beyond, told.could, told.hit})));
  RecordProperty("sufficed", std::to_string(told.sufficed));
}

// The same before drivers who differ, of cars, vans, lorries and buses.
TEST(Intrusion, NorByDriversOfAllKinds) {
  const auto network = Straight();
  std::vector<TrafficModel> driving;
  std::array<int, 4> kinds{};
  for (std::uint64_t seed = 1; seed <= 28; ++seed) {
    TrafficSettings settings;
    settings.vehicles = 1;
    settings.seed = seed;
    settings.mix.shares = {0.25, 0.25, 0.25, 0.25};
    driving.push_back(Alone(settings, network, kCaps_mps[seed % kCaps_mps.size()], kStep_s));
    ++kinds[static_cast<std::size_t>(driving.back().traits(0).kind)];
  }
  for (const int kind : kinds) EXPECT_GE(kind, 3);
  Intrude(driving, Intrusions(), kStep_s);
}

// The same with full physics: pedals, tyres, and wheels that may slide.
TEST(Intrusion, NorWithFullPhysics) {
  constexpr double kFine_s = 0.01;
  const auto network = Straight();
  std::vector<TrafficModel> driving;
  for (const double cap : kCaps_mps) {
    TrafficSettings settings = Identical(1, 1.4);
    settings.physics = Physics::kFull;
    driving.push_back(Alone(settings, network, cap, kFine_s));
  }
  Intrude(driving, Intrusions() / 4, kFine_s);
}

// Every two agents that touch.
std::string Touching(const TrafficModel& model) {
  std::string told;
  const auto& poses = model.poses();
  for (std::size_t a = 0; a < poses.size(); ++a) {
    for (std::size_t b = a + 1; b < poses.size(); ++b) {
      if ((poses[a].p_WB_W - poses[b].p_WB_W).head<2>().norm() > 12.0) continue;
      if (driver::Overlap(FootprintOf(poses[a], model.traits(poses[a].id)),
                          FootprintOf(poses[b], model.traits(poses[b].id))))
        told += fmt::format(" {} and {}", poses[a].id, poses[b].id);
    }
  }
  return told;
}

// Twenty cars follow one another around a ring, and a vehicle is there all at once before one of them, in its lane, at
// rest or braking to it: one that comes does not drive into it where half a second and braking at 0.8 g suffice, and
// none of those behind drives into the one before.
TEST(Intrusion, FollowersDoNotRunIntoOneAnother) {
  constexpr double kLength_m = 700.0;
  const auto network = Ring(kLength_m, 25.0);
  TrafficModel start = TrafficModel::Make(Identical(20, 1.4), network, {}).value();
  ASSERT_EQ(start.on_road(), 20u);
  for (int i = 0; i < 3000; ++i) start.Step(kStep_s, {});
  const double lane_m = start.graph()[0].length_m(), radius = lane_m / (2.0 * std::numbers::pi),
               centre_y = kLength_m / (2.0 * std::numbers::pi);
  int sufficed = 0, hopeless = 0;
  double hardest = 0.0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    TrafficModel model = start;
    const auto draw = [&](std::uint64_t key, double low, double high) {
      return base::RandomUniform({78, number, key}, low, high);
    };
    for (int i = 0, wait = static_cast<int>(draw(1, 0.0, 400.0)); i < wait; ++i) model.Step(kStep_s, {});
    const AgentPose agent = model.poses()[static_cast<std::size_t>(draw(2, 0.0, 20.0))];
    const AgentTraits& traits = model.traits(agent.id);
    const double gap = model.GapAhead(agent.id), room = gap - 4.4 - 1.0;
    if (room < 2.0) continue;
    const double free_m = draw(3, 1.0, room), brakes = draw(4, 2.0, 7.0),
                 u0 = draw(5, 0.0, 1.0) < 0.5 ? 0.0 : draw(6, 0.2, 1.0) * agent.speed_mps;
    const double angle0 =
        std::atan2(agent.p_WB_W.x(), centre_y - agent.p_WB_W.y()) + (0.5 * traits.length_m + free_m + 2.2) / radius;
    const auto intruder = [&](double t) {
      const double moving = std::min(t, u0 / brakes),
                   angle = angle0 + (u0 * moving - 0.5 * brakes * moving * moving) / radius;
      return driver::Footprint{9999,  radius * std::sin(angle),       centre_y - radius * std::cos(angle),
                               angle, std::max(0.0, u0 - brakes * t), 4.4,
                               1.8};
    };
    double x = 0.0, v = agent.speed_mps;
    bool suffices = true;
    for (double t = 0.0; t < kFor_s && suffices; t += 0.005) {
      const double moving = std::min(t, u0 / brakes), other = free_m + u0 * moving - 0.5 * brakes * moving * moving;
      suffices = x < other || v <= 0.0;
      const double before = v;
      if (t > kReaction_s) v = std::max(0.0, v - 0.005 * kGrip_mps2);
      x += 0.0025 * (before + v);
    }
    (suffices ? sufficed : hopeless) += 1;
    if (!suffices) continue;
    for (double t = 0.0; t < kFor_s; t += kStep_s) {
      model.Step(kStep_s, std::vector<driver::Footprint>{intruder(t)});
      ASSERT_EQ(Touching(model), "") << "intruder " << number << " at " << t;
      for (const AgentPose& pose : model.poses()) {
        hardest = std::max(hardest, -pose.acceleration_mps2);
        ASSERT_FALSE(pose.speed_mps > 0.05 &&
                     driver::Overlap(FootprintOf(pose, model.traits(pose.id)), intruder(t + kStep_s)))
            << "intruder " << number << ", car " << pose.id << " at " << t;
      }
    }
  }
  EXPECT_GT(sufficed, 60);
  EXPECT_GT(hopeless, 5);
  EXPECT_GT(hardest, 4.0);
}

// A vehicle stands all at once anywhere on a crossing, whichever way it points, for eight seconds, and is gone again:
// as long as every vehicle is so far from it that half a second and braking at 0.8 g suffice on the straight way to it,
// no vehicle drives into it, nor into another.
TEST(Intrusion, OnACrossingNoCarIsDrivenInto) {
  TrafficSettings settings;
  settings.vehicles = 22;
  TrafficModel model = TrafficModel::Make(settings, lanes::MapNetwork("crossing"), {}).value();
  int intrusions = 0;
  std::uint64_t number = 0;
  std::optional<driver::Footprint> there;
  double until = 0.0, standing = 0.0;
  for (int i = 0; i < 50 * 1200; ++i) {
    const double t = i * kStep_s;
    const auto draw = [&](std::uint64_t key, double low, double high) {
      return base::RandomUniform({79, number, key}, low, high);
    };
    if (there && t > until) there.reset();
    if (!there && t > until + 4.0) {
      ++number;
      const driver::Footprint other{9999, draw(1, -14.0, 14.0), draw(2, -14.0, 14.0), draw(3, -3.1, 3.1), 0.0, 4.4,
                                    1.8};
      const bool far = std::all_of(model.poses().begin(), model.poses().end(), [&](const AgentPose& pose) {
        const double v = pose.speed_mps, way = std::hypot(pose.p_WB_W.x() - other.x_m, pose.p_WB_W.y() - other.y_m) -
                                               0.5 * model.traits(pose.id).length_m - 2.4;
        return way > kReaction_s * v + v * v / (2.0 * kGrip_mps2) + 0.3;
      });
      if (far) there = other, until = t + 8.0, ++intrusions;
    }
    std::vector<driver::Footprint> others;
    if (there) others.push_back(*there);
    model.Step(kStep_s, others);
    ASSERT_EQ(Touching(model), "") << t;
    for (const AgentPose& pose : model.poses()) {
      standing += there && pose.speed_mps < 0.05 ? kStep_s : 0.0;
      if (there) {
        ASSERT_FALSE(pose.speed_mps > 0.05 && driver::Overlap(FootprintOf(pose, model.traits(pose.id)), *there))
            << "intruder " << number << ", car " << pose.id << " at " << t;
      }
    }
  }
  EXPECT_GT(intrusions, 60);
  EXPECT_GT(standing, 300.0);
}

}  // namespace
}  // namespace rodeira::traffic
