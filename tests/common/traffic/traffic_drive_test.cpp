// SPDX-License-Identifier: Apache-2.0
// The autopilot drives the bicycle among the traffic of N222: all see one another, none touches another.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

#include "common/driving/driver/autopilot.hpp"
#include "common/driving/driver/route_path.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "tests/n222.hpp"

namespace rodeira::traffic {
namespace {

using driver::Footprint;

TEST(TrafficDrive, TwoMinutesAmongSixtyCarsWithoutTouching) {
  const std::filesystem::path source = SourceDir();
  const auto world = N222();
  const auto ground = world->MakeGround();
  auto car = dynamics::LoadVehicle(source / "configs/vehicles/default.yaml").value();
  driver::Autopilot autopilot(
      driver::AutopilotSettings{},
      std::make_unique<driver::RoutePath>(*world->network(), driver::StraightOn(*world->network(), {0, 0, -1}, 1e5)));
  const driver::LaneFrame start = autopilot.path().At(400.0);
  ASSERT_TRUE(
      car->Initialise({.x_m = start.p_W.x(), .y_m = start.p_W.y(), .heading_rad = start.heading_rad, .speed_mps = 8.0},
                      *ground)
          .ok());
  std::vector<Footprint> driver_car{driver::FootprintOf(0, car->state(), car->dimensions())};
  TrafficSettings settings;
  settings.vehicles = 60;
  TrafficModel traffic = TrafficModel::Make(settings, world, driver_car).value();
  dynamics::Controls controls;
  double followed_s = 0.0;
  for (int k = 0; k < 120000; ++k) {
    if (k % 10 == 0) {
      std::vector<Footprint> others;
      for (const AgentPose& pose : traffic.poses()) others.push_back(FootprintOf(pose, traffic.traits(pose.id)));
      driver_car[0] = driver::FootprintOf(0, car->state(), car->dimensions());
      for (const Footprint& other : others) ASSERT_FALSE(Overlap(driver_car[0], other)) << k << " with " << other.id;
      controls = autopilot.Step({car->state(), car->dimensions(), others}, 0.01);
      traffic.Step(0.01, driver_car);
      if (autopilot.leader()) followed_s += 0.01;
    }
    car->Step(controls, *ground, 0.001);
  }
  EXPECT_GT(car->state().odometer_m, 800.0);
  EXPECT_GT(followed_s, 10.0);
}

}  // namespace
}  // namespace rodeira::traffic
