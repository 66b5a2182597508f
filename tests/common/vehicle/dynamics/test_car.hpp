// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "common/core/base/state.hpp"
#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {

inline constexpr double kStep_s = 0.001;
inline constexpr double kG_mps2 = 9.81;

inline BicycleSettings DefaultSettings() {
  static const BicycleSettings settings = [] {
    auto model = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/default.yaml");
    EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().Text());
    return static_cast<const BicycleModel&>(*model.value()).settings();
  }();
  return settings;
}

// A car that has been placed on the ground.
inline BicycleModel PlacedCar(const BicycleSettings& settings, ground::Ground& ground,
                              const InitialCondition& initial = {}) {
  BicycleModel car(settings);
  const base::Status status = car.Initialise(initial, ground);
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().Text());
  return car;
}

template <class Until>
void Drive(BicycleModel& car, ground::Ground& ground, const Controls& controls, double seconds, Until&& each) {
  const int steps = static_cast<int>(seconds / kStep_s + 0.5);
  for (int i = 0; i < steps; ++i) {
    car.Step(controls, ground, kStep_s);
    each(i + 1);
  }
}
inline void Drive(BicycleModel& car, ground::Ground& ground, const Controls& controls, double seconds) {
  Drive(car, ground, controls, seconds, [](int) {});
}

inline base::Digest DigestOf(const VehicleModel& car) {
  base::StateWriter writer(base::StateWriter::Names::kWithout);
  car.Save(writer);
  return writer.digest();
}

}  // namespace rodeira::dynamics
