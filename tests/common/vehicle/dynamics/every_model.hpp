// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include "common/vehicle/dynamics/vehicle_model.hpp"
#include "tests/common/vehicle/dynamics/own_vehicle.hpp"
#include "tests/common/vehicle/fmi/test_fmu.hpp"
#include "tests/tree.hpp"

// One car in each model, for what holds whatever the model is.
namespace rodeira::dynamics {

struct ModelCase {
  const char* name;
  const char* file;     // of configs/vehicles; empty: the tests' FMU, a point on the ground with a speed, or a library
  bool is_body = true;  // it has springs, gears and tyres
  // A mechanism: its step is solved to some 1e-3 m/s² (docs/explanation/multibody.md), and tyres that stand hold the
  // track at which they met the ground.
  bool is_mechanism = false;
  bool is_library = false;  // examples/own_vehicle: it never leaves the ground
};

inline constexpr ModelCase kBicycle{"bicycle", "default.yaml"}, kOde{"ode", "ode.yaml"},
    kMultibody{"multibody", "prototype.yaml", true, true},
    kSecondMultibody{"double_wishbones", "double_wishbones.yaml", true, true}, kFmu{"fmu", "", false},
    kLibrary{"library", "", false, false, true};

// `more`: lines of the FMU's vehicle file.
inline std::unique_ptr<VehicleModel> MakeModel(const ModelCase& model, const std::string& more = "") {
  if (*model.file != '\0') {
    auto car = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles" / model.file);
    EXPECT_TRUE(car.ok()) << (car.ok() ? "" : car.error().Text());
    return std::move(car).value();
  }
  if (model.is_library) {
    const OwnVehicleFolder folder;
    auto car = LoadVehicle(folder.Write());
    EXPECT_TRUE(car.ok()) << (car.ok() ? "" : car.error().Text());
    return std::move(car).value();
  }
  const fmi::FmuFolder folder;
  folder.Pack();
  auto car = LoadVehicle(folder.WriteCar(more));
  EXPECT_TRUE(car.ok()) << (car.ok() ? "" : car.error().Text());
  return std::move(car).value();
}

inline Controls Neutral(double brake = 0.0) {
  Controls controls;
  controls.gearbox = GearboxMode::kManual;
  controls.gear = 0;
  controls.brake = brake;
  return controls;
}

inline void DriveFor(VehicleModel& car, ground::Ground& ground, const Controls& controls, double seconds,
                     double step_s = 0.001) {
  const auto steps = static_cast<int>(std::lround(seconds / step_s));
  for (int i = 0; i < steps; ++i) car.Step(controls, ground, step_s);
}

inline std::string NameOf(const ::testing::TestParamInfo<ModelCase>& info) { return info.param.name; }

}  // namespace rodeira::dynamics
