// SPDX-License-Identifier: Apache-2.0
// Into the walls of a tunnel: a car that leaves its road is held by them, and stays on its floor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/vehicle/dynamics/collision_space.hpp"
#include "nodes/vehicle/obstacle_map.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"

namespace rodeira::nodes {
namespace {

// A tunnel that bends 20 m under a plane, with a beginning that is straight.
std::shared_ptr<const road::World> Bend() {
  const auto world = road::World::Parse(
      "rodeira: world/2\nname: tunnel bend\nground: {kind: plane, z_m: 20, surface: grass}\nroads:\n  - id: a\n    "
      "start: {x_m: 0, y_m: 0, heading_deg: 0}\n    axis: [line: {length_m: 150}, arc: {radius_m: 60, turn_deg: 200}]\n"
      "    z_m: 0\n    section: {template: rural}\n    tunnels: [{from_s_m: 60, to_s_m: 350}]\n",
      "w.yaml");
  EXPECT_TRUE(world.ok()) << (world.ok() ? "" : world.error().Text());
  return world.ok() ? world.value() : nullptr;
}

class InATunnel : public ::testing::TestWithParam<dynamics::ModelCase> {};

// Steps of 1 ms from a start until the car has come to s = 340 m or the time is over.
struct Drive {
  int hits = 0;
  double highest_m = -1e9, farthest_m = 0.0,
         farthest_wheel_m = 0.0;  // of B over 0, of B and of a wheel from the road's axis
};

Drive Through(const road::World& world, dynamics::VehicleModel& car, const dynamics::InitialCondition& start,
              double throttle, double seconds) {
  Drive drive;
  const auto ground = world.MakeGround();
  const ObstacleMap map(world, dynamics::BoxOf(car.dimensions(), {}).reach_m());
  const dynamics::CollisionSpace space(car.dimensions(), {});
  EXPECT_TRUE(car.Initialise(start, *ground).ok());
  dynamics::Controls controls;
  controls.gearbox = dynamics::GearboxMode::kManual, controls.gear = 2;
  controls.throttle = throttle;
  const network::Network& network = *world.network();
  for (int i = 0; i < static_cast<int>(1000.0 * seconds); ++i) {
    std::vector<dynamics::Obstacle> near;
    for (const std::uint32_t number : map.Near(car.state().p_WB_W)) near.push_back(map.all()[number]);
    const auto touched = space.Touch(car.state(), near);
    for (const dynamics::Impact& impact : touched) {
      ++drive.hits;
      EXPECT_EQ(map.NameOf(impact.id), "a-tunnel0");
    }
    car.SetPush(dynamics::WrenchOf(touched));
    car.Step(controls, *ground, 0.001);
    const Eigen::Vector3d& p = car.state().p_WB_W;
    if (!p.allFinite()) ADD_FAILURE() << "at step " << i;
    const auto place = network.Locate(p.x(), p.y(), 0.0);
    if (!place || place->s_m > 340.0) break;
    drive.highest_m = std::max(drive.highest_m, p.z()),
    drive.farthest_m = std::max(drive.farthest_m, std::fabs(place->t_m));
    for (const dynamics::WheelState& wheel : car.state().wheels) {
      if (const auto of_wheel = network.Locate(wheel.contact_W.x(), wheel.contact_W.y(), 0.0))
        drive.farthest_wheel_m = std::max(drive.farthest_wheel_m, std::fabs(of_wheel->t_m));
    }
  }
  return drive;
}

// At 72 km/h straight on where the road bends to the left, on the throttle: it hits the right wall and scrapes along
// it, on the floor, through the tube.
TEST_P(InATunnel, ACarStraightOnInABendHitsItsWallAndStaysInside) {
  const auto world = Bend();
  ASSERT_NE(world, nullptr);
  auto car = dynamics::MakeModel(GetParam());
  const Drive drive =
      Through(*world, *car, {.x_m = 130.0, .y_m = -1.75, .z_hint_m = 0.0, .speed_mps = 20.0}, 1.0, 12.0);
  EXPECT_GT(drive.hits, 20);
  EXPECT_LT(drive.highest_m, 1.0) << "thrown up";
  EXPECT_LT(drive.farthest_m, 6.0) << "through the wall";
}

// Head-on at 216 km/h: the nose is pressed in so far that the front wheels pass the road's edge. They stand on the
// floor there, not on the hill.
TEST_P(InATunnel, ACarPressedIntoItsWallStandsOnItsFloor) {
  const auto world = Bend();
  ASSERT_NE(world, nullptr);
  auto car = dynamics::MakeModel(GetParam());
  const Drive drive = Through(
      *world, *car, {.x_m = 110.0, .y_m = 2.0, .z_hint_m = 0.0, .heading_rad = -1.5708, .speed_mps = 60.0}, 0.0, 3.0);
  EXPECT_GT(drive.hits, 20);
  EXPECT_GT(drive.farthest_wheel_m, 5.78) << "else it shows nothing";
  EXPECT_LT(drive.highest_m, 4.0) << "thrown up: more than it rears";
  EXPECT_LT(drive.farthest_m, 6.0) << "through the wall";
}

INSTANTIATE_TEST_SUITE_P(Models, InATunnel, ::testing::Values(dynamics::kBicycle, dynamics::kOde, dynamics::kMultibody),
                         dynamics::NameOf);

}  // namespace
}  // namespace rodeira::nodes
