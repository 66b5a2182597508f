// SPDX-License-Identifier: Apache-2.0
// How soon agents answer to what is suddenly there: in the step in which they see it first, wherever it is and however
// their cars move.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "common/traffic/motion/full_cars.hpp"
#include "common/traffic/traffic_model.hpp"
#include "tests/common/traffic/identical.hpp"
#include "tests/common/traffic/ring.hpp"
#include "tests/common/world/lanes/lane_networks.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kStep_s = 0.01;
constexpr std::uint32_t kBody = 9999;

TrafficSettings One(Physics physics) {
  TrafficSettings settings = Identical(1, 1.4);
  settings.physics = physics;
  return settings;
}

// Where the agent of a model will be, step by step; nothing where its trip ends before.
std::optional<std::vector<AgentPose>> Leader(const TrafficModel& model,
                                             const std::shared_ptr<const network::Network>& network,
                                             const TrafficSettings& settings, int steps) {
  base::StateWriter writer;
  model.Save(writer);
  TrafficModel goes_on = TrafficModel::Make(settings, network, {}).value();
  base::StateReader reader(writer.bytes());
  goes_on.Restore(reader);
  std::vector<AgentPose> way;
  for (int i = 0; i < steps; ++i) {
    goes_on.Step(kStep_s, {});
    if (goes_on.poses().empty() || goes_on.poses()[0].trip != model.poses()[0].trip) return std::nullopt;
    way.push_back(goes_on.poses()[0]);
  }
  return way;
}

double HeadingOf(const AgentPose& pose) {
  const Eigen::Vector3d ahead = pose.q_WB * Eigen::Vector3d::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

// From one state with a vehicle at a pose, turned by so much and with a speed of its own, and without it: the step that
// sees it first is driven otherwise, by the pedals of a car with full physics, by acceleration and speed of a planar
// one.
void AnswersAtOnce(const TrafficModel& model, const std::shared_ptr<const network::Network>& network,
                   const TrafficSettings& settings, const AgentPose& at, double turned_rad, double speed_mps,
                   const char* what) {
  base::StateWriter writer;
  model.Save(writer);
  std::vector<TrafficModel> both;
  for (int i = 0; i < 2; ++i) {
    both.push_back(TrafficModel::Make(settings, network, {}).value());
    base::StateReader reader(writer.bytes());
    both.back().Restore(reader);
  }
  const std::vector<driver::Footprint> others{
      {kBody, at.p_WB_W.x(), at.p_WB_W.y(), HeadingOf(at) + turned_rad, speed_mps, 4.5, 1.8}};
  both[0].Step(kStep_s, {});
  both[1].Step(kStep_s, others);
  const AgentPose &without = both[0].poses()[0], &with = both[1].poses()[0];
  if (settings.physics == Physics::kPlanar) {
    EXPECT_LT(with.acceleration_mps2, without.acceleration_mps2 - 0.02) << what;
    EXPECT_LT(with.speed_mps, without.speed_mps) << what;
  } else {
    const dynamics::Controls &feet = both[0].full()->controls(0), &now = both[1].full()->controls(0);
    EXPECT_TRUE(now.throttle < feet.throttle || now.brake > feet.brake)
        << what << ": throttle " << feet.throttle << ", brake " << feet.brake;
    EXPECT_LE(with.acceleration_mps2, without.acceleration_mps2) << what;
  }
  for (int i = 0; i < 100; ++i)
    both[0].Step(kStep_s, {}), both[1].Step(kStep_s, others);  // a second later it is seen in any case
  ASSERT_EQ(both[1].poses().size(), 1u) << what;
  EXPECT_LT(both[1].poses()[0].speed_mps, both[0].poses()[0].speed_mps - 0.5) << what;
}

TEST(Reactions, WithinOneStepOnARoad) {
  const auto network = Ring(600.0);
  for (const Physics physics : {Physics::kPlanar, Physics::kFull}) {
    const TrafficSettings settings = One(physics);
    TrafficModel model = TrafficModel::Make(settings, network, {}).value();
    for (int i = 0; i < 3000; ++i) model.Step(kStep_s, {});
    ASSERT_GT(model.poses()[0].speed_mps, 10.0);
    const auto way = Leader(model, network, settings, 400);
    ASSERT_TRUE(way);
    AnswersAtOnce(model, network, settings, way->back(), 0.0, 0.0, "stands there");
    AnswersAtOnce(model, network, settings, way->back(), 0.5 * std::numbers::pi, 0.0, "stands across");
    AnswersAtOnce(model, network, settings, way->back(), std::numbers::pi, 8.0, "comes against the flow");
  }
}

// In the middle of the crossing, on the way that the car was let into before it is there.
TEST(Reactions, WithinOneStepInAJunction) {
  const auto network = lanes::MapNetwork("crossing");
  constexpr double kMiddle_m = 9.0;  // the crossing's way from its middle
  for (const Physics physics : {Physics::kPlanar, Physics::kFull}) {
    const TrafficSettings settings = One(physics);
    TrafficModel model = TrafficModel::Make(settings, network, {}).value();
    int before = 0, within = 0;
    for (int i = 0; i < 40000 && (before < 3 || within < 3); ++i) {
      model.Step(kStep_s, {});
      if (i % 20 != 0 || model.poses().empty() || model.poses()[0].speed_mps < 4.0) continue;
      const AgentPose& pose = model.poses()[0];
      const Agent& agent = model.agent(0);
      const bool is_within = pose.p_WB_W.head<2>().norm() < kMiddle_m + 3.0;
      if (agent.granted_m <= agent.o_m || (is_within ? within : before) >= 3) continue;
      const auto way = Leader(model, network, settings, 500);
      if (!way) continue;
      for (const AgentPose& later : *way) {
        const double gone = (later.p_WB_W - pose.p_WB_W).head<2>().norm();
        if (gone < (is_within ? 8.0 : 12.0)) continue;
        if (gone > 30.0 || later.p_WB_W.head<2>().norm() > kMiddle_m) break;
        for (const double turned_rad : {0.0, 0.5 * std::numbers::pi, std::numbers::pi})
          AnswersAtOnce(model, network, settings, later, turned_rad, 0.0, is_within ? "within" : "before");
        ++(is_within ? within : before);
        break;
      }
    }
    EXPECT_EQ(before, 3);
    EXPECT_EQ(within, 3);
  }
}

}  // namespace
}  // namespace rodeira::traffic
