// SPDX-License-Identifier: Apache-2.0
// All wheels driven, with an open, a locked and a limited-slip centre differential.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/same_bits.hpp"
#include "tests/common/vehicle/dynamics/test_car.hpp"
#include "tests/common/vehicle/dynamics/with_assists.hpp"

namespace rodeira::dynamics {
namespace {

using ground::PlaneGround;

enum class Centre { kOpen, kLocked, kPlates };

constexpr double kFrontShare = 0.4, kLocking = 0.3;

PowertrainSettings AllDriven(PowertrainSettings settings, Centre centre) {
  settings.driven = DrivenWheels::kAll;
  settings.centre.front_share = kFrontShare;
  settings.centre.locked = centre == Centre::kLocked;
  if (centre == Centre::kPlates) settings.centre.plates = {.preload_Nm = 20.0, .locking_drive = kLocking};
  return settings;
}

// One step of a driveline that turns and bears what the seed says.
DrivelineLoads DrawnLoads(std::uint32_t seed) {
  const auto draw = [&](std::uint64_t what, double low, double high) {
    return base::RandomUniform({seed, what}, low, high);
  };
  const auto axle = [&](std::uint64_t first) {
    AxleLoads loads;
    loads.wheel_radps = {draw(first, -100, 100), draw(first + 1, -100, 100)};
    loads.road_torque_Nm = {draw(first + 2, -1000, 1000), draw(first + 3, -1000, 1000)};
    loads.friction_torque_Nm = {draw(first + 4, 0, 1500), draw(first + 5, 0, 1500)};
    loads.locking_torque_Nm = std::max(0.0, draw(first + 6, -500, 1500));
    return loads;
  };
  DrivelineLoads loads;
  static_cast<AxleLoads&>(loads) = axle(10);
  loads.rear = axle(20);
  loads.drives_all = true;
  loads.front_share = draw(0, 0.1, 0.9);
  loads.centre_locking_torque_Nm = draw(1, -1, 2) < 0.0 ? 1e9 : std::max(0.0, draw(2, -500, 1500));
  loads.ratio = draw(3, -15, 15);
  loads.clutch_capacity_Nm = draw(4, 0, 200);
  return loads;
}

// Newton's law of each wheel by the torques that are reported, and kinetic energy of the five rotors against the work
// of all torques at mean speeds.
RC_GTEST_PROP(AllWheelDriveline, EachWheelTurnsByItsTorquesAndWorkBalances, (std::uint32_t seed)) {
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  DrivelineLoads loads = DrawnLoads(seed);
  Engine engine;
  engine.Start(base::RandomUniform({seed, 5}, 50, 650));
  double worst = 0.0, scale = 1.0;
  for (int i = 0; i < 200; ++i) {
    engine.Prepare(settings, 0.5, false);
    const double w0 = engine.speed_radps();
    const DrivelineMotion m = StepDriveline(settings, engine, loads, kStep_s);
    const double j = loads.wheel_inertia_kgm2;
    const double drag_Nm =
        settings.inertia_kgm2 * (m.engine_radps - w0) / kStep_s - engine.driving_Nm() + m.clutch_torque_Nm;
    double change_J = 0.5 * settings.inertia_kgm2 * (m.engine_radps * m.engine_radps - w0 * w0);
    double work_W = (engine.driving_Nm() + drag_Nm) * 0.5 * (w0 + m.engine_radps) - m.clutch_heat_W - m.locking_heat_W;
    for (const bool front : {true, false}) {
      const AxleLoads& axle = front ? static_cast<const AxleLoads&>(loads) : loads.rear;
      const AxleMotion& moved = front ? static_cast<const AxleMotion&>(m) : m.rear;
      for (std::size_t k = 0; k < 2; ++k) {
        const double mean = 0.5 * (axle.wheel_radps[k] + moved.wheel_radps[k]);
        const double torque_Nm = axle.road_torque_Nm[k] + moved.friction_torque_Nm[k] + moved.shaft_torque_Nm()[k];
        RC_ASSERT(std::fabs(j * (moved.wheel_radps[k] - axle.wheel_radps[k]) / kStep_s - torque_Nm) <=
                  1e-6 * (std::fabs(torque_Nm) + 1000.0));
        change_J += 0.5 * j * (moved.wheel_radps[k] - axle.wheel_radps[k]) * 2.0 * mean;
        work_W += (axle.road_torque_Nm[k] + moved.friction_torque_Nm[k]) * mean;
        RC_ASSERT(std::fabs(moved.friction_torque_Nm[k]) <= axle.friction_torque_Nm[k] * (1 + 1e-9));
      }
      RC_ASSERT(std::fabs(moved.locking_torque_Nm) <= axle.locking_torque_Nm * (1 + 1e-9));
    }
    RC_ASSERT(std::fabs(m.centre_locking_torque_Nm) <= loads.centre_locking_torque_Nm * (1 + 1e-9));
    RC_ASSERT(std::fabs(m.drive_sum_Nm() - loads.ratio * m.clutch_torque_Nm) <=
              1e-6 * (1.0 + std::fabs(m.drive_sum_Nm())));
    worst = std::max(worst, std::fabs(change_J / kStep_s - work_W));
    scale = std::max({scale, std::fabs(change_J / kStep_s), std::fabs(m.clutch_in_W), std::fabs(m.clutch_out_W)});
    engine.Finish(settings, m.engine_radps, kStep_s);
    loads.wheel_radps = m.wheel_radps;
    loads.rear.wheel_radps = m.rear.wheel_radps;
  }
  RC_ASSERT(worst <= 1e-6 * scale);
}

// The shares of the torque are those of the gear teeth, whatever the wheels do.
RC_GTEST_PROP(AllWheelDriveline, AnOpenCentreSharesTheTorque, (std::uint32_t seed)) {
  DrivelineLoads loads = DrawnLoads(seed);
  loads.centre_locking_torque_Nm = 0.0;
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(base::RandomUniform({seed, 5}, 50, 650));
  engine.Prepare(settings, 0.5, false);
  const DrivelineMotion m = StepDriveline(settings, engine, loads, kStep_s);
  RC_ASSERT(std::fabs(2.0 * m.drive_torque_Nm - loads.front_share * m.drive_sum_Nm()) <=
            1e-9 * (1.0 + std::fabs(m.drive_sum_Nm())));
}

// A locked centre differential makes both axles turn alike after one step; plates slip only with all their torque.
RC_GTEST_PROP(AllWheelDriveline, PlatesSlipOnlyAtTheirBound, (std::uint32_t seed)) {
  DrivelineLoads loads = DrawnLoads(seed);
  const EngineSettings settings = DefaultSettings().powertrain.engine;
  Engine engine;
  engine.Start(base::RandomUniform({seed, 5}, 50, 650));
  engine.Prepare(settings, 0.5, false);
  const DrivelineMotion m = StepDriveline(settings, engine, loads, kStep_s);
  const double slip = m.wheel_radps[0] + m.wheel_radps[1] - m.rear.wheel_radps[0] - m.rear.wheel_radps[1];
  const double left = loads.centre_locking_torque_Nm - std::fabs(m.centre_locking_torque_Nm);
  RC_ASSERT(std::fabs(slip) <= 0.01 || left <= 1e-6 * loads.centre_locking_torque_Nm);
  RC_ASSERT(slip * m.centre_locking_torque_Nm <= 1e-3 * (1.0 + std::fabs(m.centre_locking_torque_Nm)));
}

// Ice under one axle, a dry road under the other.
class IcyAxle final : public ground::Ground {
 public:
  IcyAxle(const double& middle_x_m, bool front) : middle_x_m_(middle_x_m), front_(front) {}
  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      points[i] = {};
      points[i].normal_W = Eigen::Vector3d::UnitZ();
      points[i].friction = (queries[i].x_m > middle_x_m_) == front_ ? 0.05 : 1.0;
      points[i].surface = ground::Surface::kAsphalt;
      points[i].inside = true;
    }
  }

 private:
  const double& middle_x_m_;
  bool front_;
};

struct Started {
  double front_Nm = 0.0, rear_Nm = 0.0;  // of the shafts, over the last second
  double slip_radps = 0.0;               // least difference of the axles' speeds
  double speed_mps = 0.0;
};

Started StartOnIce(Centre centre, bool front_on_ice) {
  BicycleSettings settings = SettingsWithoutAssists();
  settings.powertrain = AllDriven(settings.powertrain, centre);
  double middle_x_m = 0.0;
  IcyAxle ground(middle_x_m, front_on_ice);
  BicycleModel car = PlacedCar(settings, ground);
  Controls controls;
  controls.throttle = 0.8;
  Started found{.slip_radps = 1e9};
  Drive(car, ground, controls, 3.0, [&](int step) {
    const VehicleState& state = car.state();
    middle_x_m = state.p_WB_W.x();
    if (step < 2000) return;
    const auto& wheels = state.wheels;
    const double front = 0.5 * (wheels[kFrontLeft].spin_radps + wheels[kFrontRight].spin_radps);
    const double rear = 0.5 * (wheels[kRearLeft].spin_radps + wheels[kRearRight].spin_radps);
    found.slip_radps = std::min(found.slip_radps, std::fabs(front - rear));
    found.front_Nm += wheels[kFrontLeft].drive_torque_Nm + wheels[kFrontRight].drive_torque_Nm;
    found.rear_Nm += wheels[kRearLeft].drive_torque_Nm + wheels[kRearRight].drive_torque_Nm;
  });
  found.speed_mps = car.state().v_WB_B().x();
  return found;
}

// By the definition of share and locking value: the axle on ice has what ice bears, the other its share over that;
// plates add up to half of S times the whole torque; a locked one gives all that the engine has.
TEST(AllWheelCar, OnIceUnderOneAxleTheCentreDifferentialSharesByItsKind) {
  for (const bool front_on_ice : {true, false}) {
    const Started open = StartOnIce(Centre::kOpen, front_on_ice), plates = StartOnIce(Centre::kPlates, front_on_ice),
                  locked = StartOnIce(Centre::kLocked, front_on_ice);
    EXPECT_GT(open.slip_radps, 5.0);
    EXPECT_NEAR(open.front_Nm / (open.front_Nm + open.rear_Nm), kFrontShare, 1e-9);
    EXPECT_LT(locked.slip_radps, 1e-3);
    EXPECT_GT(locked.speed_mps, 1.5 * open.speed_mps) << front_on_ice;
    EXPECT_GT(plates.speed_mps, 1.1 * open.speed_mps) << front_on_ice;
    const double sum = plates.front_Nm + plates.rear_Nm;
    const double way = front_on_ice ? -1.0 : 1.0;  // the axle on ice turns faster and gives torque away
    EXPECT_NEAR(plates.front_Nm, kFrontShare * sum + way * 0.5 * (kLocking * sum + 1000 * 20.0), 0.01 * sum)
        << front_on_ice;
    EXPECT_GT(plates.slip_radps, 1.0) << front_on_ice;
  }
}

std::string TextOf(const std::string& file) {
  std::ifstream in(std::filesystem::path(SourceDir()) / "configs/vehicles" / file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// A shipped car with another line in the place of `driven_axle: …`.
base::Result<std::unique_ptr<VehicleModel>> LoadDriven(const std::string& file, const std::string& lines) {
  std::string text = TextOf(file);
  const auto at = text.find("driven_axle: ");
  EXPECT_NE(at, std::string::npos);
  text.replace(at, text.find('\n', at) - at, lines);
  const std::filesystem::path folder = std::filesystem::path(SourceDir()) / "configs/vehicles";
  const auto models = text.find("\nmodels:");
  if (models != std::string::npos) text.erase(models + 1, text.find('\n', models + 1) - models);
  const auto path =
      std::filesystem::temp_directory_path() / ("rodeira-all-wheel-" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(path) << text;
  auto car = LoadVehicle(path);
  std::filesystem::remove(path);
  return car;
}

const std::vector<std::string> kCentres{"", "centre_differential: {locked: true, front_share: 0.35}",
                                        "centre_differential: {preload_Nm: 60, locking_drive: 0.3, front_share: 0.6}\n"
                                        "rear_differential: {preload_Nm: 40, locking_drive: 0.2}"};

class AllWheelModel : public ::testing::TestWithParam<ModelCase> {};

// As the cars with one driven axle: uphill at a speed nothing accelerates, and with the throttle that was found the car
// goes on as it began. Where the plates or the lock share the torque, the tyres' slips agree to the first order.
TEST_P(AllWheelModel, AtASpeedItBeginsSteadily) {
  for (const std::string& centre : kCentres) {
    SCOPED_TRACE(centre);
    auto made = LoadDriven(GetParam().file, "driven_axle: all\n" + centre);
    ASSERT_TRUE(made.ok()) << made.error().Text();
    VehicleModel& car = *made.value();
    PlaneGround ground(Eigen::Vector3d::Zero(), 0.03, 0.0);
    ASSERT_TRUE(car.Initialise({.speed_mps = 20.0}, ground).ok());
    const VehicleState began = car.state();
    Controls controls;
    controls.gearbox = GearboxMode::kManual;
    controls.gear = began.gear;
    controls.throttle = began.throttle;
    EXPECT_GT(began.throttle, 0.01);
    EXPECT_LT(began.throttle, 0.99);
    car.Step(controls, ground, kStep_s);
    EXPECT_LE(car.state().a_WB_W.norm(), GetParam().is_mechanism ? 1e-3 : centre.empty() ? 1e-6 : 1e-4);
    for (std::size_t i = 0; i < kWheels; ++i)
      EXPECT_NEAR(car.state().wheels[i].spin_radps, began.wheels[i].spin_radps, centre.empty() ? 1e-6 : 1e-3) << i;
    DriveFor(car, ground, controls, 2.0);
    EXPECT_NEAR(car.state().speed_mps(), 20.0, 2e-3);
    EXPECT_NEAR(car.state().engine_speed_radps, began.engine_speed_radps, 0.05);
  }
}

// On a road that holds all, the same engine drives it off as fast as with one axle; all four wheels pull. It goes on
// with the same bits from a saved state.
TEST_P(AllWheelModel, DrivesOffWithAllWheelsAndGoesOnWithTheSameBits) {
  Controls controls;
  controls.throttle = 0.5;
  PlaneGround level(Eigen::Vector3d::Zero(), 0.0, 0.0);
  auto one_axle = LoadDriven(GetParam().file, "driven_axle: front");
  ASSERT_TRUE(one_axle.ok() && one_axle.value()->Initialise({}, level).ok());
  DriveFor(*one_axle.value(), level, controls, 3.0);
  const double one_axle_mps = one_axle.value()->state().v_WB_B().x();
  for (const std::string& centre : kCentres) {
    auto made = LoadDriven(GetParam().file, "driven_axle: all\n" + centre);
    auto again = LoadDriven(GetParam().file, "driven_axle: all\n" + centre);
    ASSERT_TRUE(made.ok() && again.ok());
    VehicleModel& car = *made.value();
    PlaneGround ground(Eigen::Vector3d::Zero(), 0.0, 0.0);
    ASSERT_TRUE(car.Initialise({}, ground).ok());
    controls.steering_wheel_rad = 0.0;
    DriveFor(car, ground, controls, 3.0);
    for (std::size_t i = 0; i < kWheels; ++i) EXPECT_GT(car.state().wheels[i].drive_torque_Nm, 30.0) << centre << i;
    EXPECT_NEAR(car.state().v_WB_B().x(), one_axle_mps, 0.02 * one_axle_mps) << centre;
    ASSERT_TRUE(again.value()->Initialise({.x_m = 3.0}, ground).ok());
    ExpectTheSameBitsFromASnapshot(car, *again.value(), 500, [&](VehicleModel& each, int i) {
      controls.steering_wheel_rad = 0.01 * (i % 70);
      each.Step(controls, ground, kStep_s);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Models, AllWheelModel, ::testing::Values(kBicycle, kOde, kMultibody), NameOf);

TEST(AllWheelFile, WhatDoesNotFitIsRefused) {
  const auto problem = [](const std::string& lines) {
    const auto car = LoadDriven("default.yaml", lines);
    return car.ok() ? base::Error{} : car.error();
  };
  for (const char* key : {"centre_differential", "rear_differential"}) {
    for (const char* axle : {"front", "rear"}) {
      const base::Error error = problem(std::string("driven_axle: ") + axle + "\n" + key + ": {preload_Nm: 40}");
      EXPECT_EQ(error.id.text(), "vehicle.not_all_driven");
      EXPECT_EQ(error.exit_status(), 2);
      EXPECT_THAT(error.Text(), testing::HasSubstr(":10: ")) << "the line";
    }
  }
  EXPECT_EQ(problem("driven_axle: all\ncentre_differential: {locked: true, preload_Nm: 40}").id.text(),
            "vehicle.locked_with_plates");
  EXPECT_EQ(problem("driven_axle: all\ncentre_differential: {front_share: 1}").id.text(), "config.out_of_range");
  EXPECT_EQ(problem("driven_axle: both").exit_status(), 2);
}

}  // namespace
}  // namespace rodeira::dynamics
