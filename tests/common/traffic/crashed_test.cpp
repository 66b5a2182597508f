// SPDX-License-Identifier: Apache-2.0
// Agents that are hit: momentum, sliding to rest against closed forms, and what the others do about them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/traffic/motion/crashed.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kGravity_mps2 = 9.81, kMu = 0.7;

AgentTraits Saloon() {
  AgentTraits traits;
  traits.length_m = 4.5, traits.width_m = 1.8, traits.wheelbase_m = 2.7, traits.mass_kg = 1500.0;
  return traits;
}

// v = J/m; it comes to rest after v/(mu g), v²/(2 mu g) further on.
TEST(Crashed, SlidesAsFarAsFrictionSays) {
  for (const double v : {1.0, 5.0, 20.0}) {
    for (const double way_rad : {0.0, 0.7, 2.9}) {
      const AgentTraits traits = Saloon();
      Crashed crashed;
      crashed.heading_rad = 0.4;
      crashed.p_W = {10.0, -3.0};
      const Eigen::Vector2d way(std::cos(way_rad), std::sin(way_rad));
      crashed.Push(traits, v * traits.mass_kg * way, crashed.p_W);
      EXPECT_NEAR((crashed.v_W - v * way).norm(), 0.0, 1e-12);
      double time = 0.0;
      for (; !crashed.at_rest() && time < 60.0; time += 0.01) crashed.Slide(traits, kMu, 0.01);
      EXPECT_NEAR(time, v / (kMu * kGravity_mps2), 0.011);
      EXPECT_NEAR((crashed.p_W - Eigen::Vector2d(10.0, -3.0)).dot(way), v * v / (2.0 * kMu * kGravity_mps2),
                  1e-3 * v + 1e-4);
      EXPECT_NEAR(crashed.heading_rad, 0.4, 1e-9);
    }
  }
}

// A couple turns it about its middle: r × J = I ω; all wheels slide at the distance R, so that it stops after ω I/(m mu
// g R).
TEST(Crashed, SpinsAsLongAsFrictionSays) {
  const AgentTraits traits = Saloon();
  const double inertia = traits.mass_kg * (4.5 * 4.5 + 1.8 * 1.8) / 12.0, R = std::hypot(1.35, 0.9);
  Crashed crashed;
  crashed.Push(traits, {0.0, 3000.0}, {1.0, 0.0});
  crashed.Push(traits, {0.0, -3000.0}, {-1.0, 0.0});
  const double rate = 6000.0 / inertia;
  EXPECT_NEAR(crashed.yaw_rate_radps, rate, 1e-12);
  EXPECT_NEAR(crashed.v_W.norm(), 0.0, 1e-12);
  const double slows = traits.mass_kg * kMu * kGravity_mps2 * R / inertia;
  double time = 0.0;
  for (; !crashed.at_rest() && time < 60.0; time += 0.01) crashed.Slide(traits, kMu, 0.01);
  EXPECT_NEAR(time, rate / slows, 0.011);
  EXPECT_NEAR(crashed.heading_rad, rate * rate / (2.0 * slows), 0.002 * rate);
  EXPECT_NEAR(crashed.p_W.norm(), 0.0, 1e-6);
}

// A car of a column is hit: it takes the momentum, slides, and stays; the others stop behind it; none is lost, and a
// snapshot goes on with the same bits.
void StaysAnObstacle(Physics physics) {
  // The last one of the column comes to the wreck after a ring's length.
  const auto cars = BriefOrLong(10u, 20u);
  const double ring_m = 50.0 * cars;
  TrafficSettings settings = Identical(cars, 1.4);
  settings.physics = physics;
  TrafficModel model = TrafficModel::Make(settings, Ring(ring_m), {}).value();
  for (int i = 0; i < 2000; ++i) model.Step(0.02, {});
  const std::size_t on_road = model.on_road();
  const std::uint32_t id = model.poses()[3].id;
  const AgentPose before = model.poses()[3];
  const Eigen::Vector2d ahead = (before.q_WB * Eigen::Vector3d::UnitX()).head<2>().normalized(),
                        left(-ahead.y(), ahead.x());
  const double mass = model.traits(id).mass_kg;
  model.Strike(id, 0.0005 * mass * left, before.p_WB_W.head<2>());
  EXPECT_FALSE(model.agent(id).is_crashed) << "a touch is nothing";
  model.Strike(id, 1.0 * mass * left - 2.0 * mass * ahead, before.p_WB_W.head<2>());
  ASSERT_TRUE(model.agent(id).is_crashed);
  const Eigen::Vector2d expected = (before.speed_mps - 2.0) * ahead + 1.0 * left;
  EXPECT_NEAR((model.agent(id).crashed.v_W - expected).norm(), 0.0, 1e-9);
  base::StateWriter writer;
  model.Save(writer);
  TrafficModel again = TrafficModel::Make(settings, Ring(ring_m), {}).value();
  base::StateReader reader(writer.bytes());
  again.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  for (int i = 0; i < BriefOrLong(3500, 6000); ++i) {
    model.Step(0.02, {});
    ASSERT_EQ(model.on_road(), on_road);
    if (i < 500) {
      again.Step(0.02, {});
      base::StateWriter one, other;
      model.Save(one);
      again.Save(other);
      ASSERT_EQ(one.digest(), other.digest()) << i;
    }
    for (const AgentPose& a : model.poses()) {
      for (const AgentPose& b : model.poses()) {
        if (a.id >= b.id || i < 100 || i % 5 != 0) continue;  // a touch lasts longer than a tenth of a second
        ASSERT_FALSE(driver::Overlap(FootprintOf(a, model.traits(a.id)), FootprintOf(b, model.traits(b.id))))
            << a.id << " " << b.id << " " << 0.02 * i;
      }
    }
  }
  const double slid = expected.squaredNorm() / (2.0 * kMu * kGravity_mps2);
  const AgentPose& wreck =
      *std::find_if(model.poses().begin(), model.poses().end(), [&](const AgentPose& p) { return p.id == id; });
  EXPECT_NEAR((wreck.p_WB_W - before.p_WB_W).norm(), slid, 0.02 * slid + 0.01);
  EXPECT_EQ(wreck.speed_mps, 0.0);
  for (const AgentPose& pose : model.poses())
    EXPECT_LT(pose.speed_mps, 0.05) << pose.id << " has not come to rest behind it";
}

TEST(Crashed, StaysAnObstacleToTheOthers) { StaysAnObstacle(Physics::kPlanar); }

// The others' cars feel the ground; the hit one slides, as in the plane.
TEST(Crashed, StaysAnObstacleToOthersWithFullPhysics) { StaysAnObstacle(Physics::kFull); }

}  // namespace
}  // namespace rodeira::traffic
