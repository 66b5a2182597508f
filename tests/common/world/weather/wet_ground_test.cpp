// SPDX-License-Identifier: Apache-2.0
#include "common/world/weather/wet_ground.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>
#include <string>

#include "common/core/base/temporary_folder.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "tests/tree.hpp"

namespace rodeira::weather {
namespace {

using ground::Surface;

TEST(WetGround, DryItIsTheGroundBitByBit) {
  ground::PlaneGround plane({0.0, 0.0, 3.0}, 0.05, -0.02, 0.83, Surface::kGravel);
  WetGround ground(plane);
  const ground::GroundPoint a = ground.At(12.0, 7.0), b = plane.At(12.0, 7.0);
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.z_m, b.z_m);
  EXPECT_EQ(a.normal_W, b.normal_W);
}

TEST(WetGround, OnlyTheFrictionBecomesLess) {
  for (const Surface surface :
       {Surface::kAsphalt, Surface::kConcrete, Surface::kGravel, Surface::kGrass, Surface::kSoil, Surface::kRoadMark}) {
    ground::PlaneGround plane({0.0, 0.0, 3.0}, 0.05, -0.02, 0.9, surface);
    WetGround ground(plane);
    const double left = FrictionLeft(surface);
    EXPECT_GT(left, 0.3);
    EXPECT_LT(left, 0.95);
    double before = 0.9;
    for (const double wetness : {0.25, 0.5, 1.0}) {
      ground.set_wetness(wetness);
      const ground::GroundPoint point = ground.At(12.0, 7.0);
      EXPECT_DOUBLE_EQ(point.friction, 0.9 * (1.0 - wetness * (1.0 - left)));
      EXPECT_LT(point.friction, before);
      EXPECT_EQ(point.z_m, plane.At(12.0, 7.0).z_m);
      EXPECT_EQ(point.surface, surface);
      before = point.friction;
    }
  }
  EXPECT_EQ(FrictionLeft(Surface::kOutside), 1.0);
}

// From 20 m/s without assists and with all wheels at their limit, d = v^2 / (2 mu g): on the wet road as much longer as
// its friction is less. The car's drag (some 2 % of the wet deceleration at this speed) and its tyres' rise to full
// force are in both.
double StoppingDistance_m(const std::string& file, double wetness) {
  const auto folder = base::TemporaryFolder::Make("rodeira-wet").value();
  const auto path = folder.path() / file;
  std::ifstream shipped(SourceDir() + "/configs/vehicles/" + file);
  std::ofstream without(path);
  for (std::string line; std::getline(shipped, line);)
    if (!line.starts_with("assists:") && !line.starts_with("models:")) without << line << '\n';
  without.close();
  auto loaded = dynamics::LoadVehicle(path);
  EXPECT_TRUE(loaded.ok()) << loaded.error().Text();
  ground::PlaneGround plane;
  WetGround ground(plane);
  ground.set_wetness(wetness);
  dynamics::VehicleModel& car = *loaded.value();
  dynamics::InitialCondition start;
  start.speed_mps = 20.0;
  EXPECT_TRUE(car.Initialise(start, ground).ok());
  dynamics::Controls controls;
  controls.brake = 1.0;
  controls.gear = 0;
  for (int i = 0; i < 20'000 && car.state().v_WB_W.norm() > 0.05; ++i) car.Step(controls, ground, 0.001);
  EXPECT_LT(car.state().v_WB_W.norm(), 0.06);
  return car.state().p_WB_W.head<2>().norm();
}

TEST(WetGround, OnAWetRoadACarStopsAsMuchLater) {
  for (const std::string file : {"default.yaml", "prototype.yaml", "ode.yaml"}) {
    const double dry_m = StoppingDistance_m(file, 0.0), half_m = StoppingDistance_m(file, 0.5),
                 wet_m = StoppingDistance_m(file, 1.0);
    EXPECT_NEAR(half_m / dry_m, 1.0 / 0.85, 0.05) << file << ": " << dry_m << " m, " << half_m << " m";
    EXPECT_NEAR(wet_m / dry_m, 1.0 / 0.70, 0.08) << file << ": " << dry_m << " m, " << wet_m << " m";
  }
}

}  // namespace
}  // namespace rodeira::weather
