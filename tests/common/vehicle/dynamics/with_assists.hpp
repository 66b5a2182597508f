// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"
#include "tests/common/vehicle/dynamics/every_model.hpp"
#include "tests/common/vehicle/dynamics/test_car.hpp"

namespace rodeira::dynamics {

// A shipped car with these controllers, whatever its file says.
inline std::unique_ptr<VehicleModel> MakeWith(const ModelCase& model, const assists::AssistSettings& assists) {
  auto car = MakeModel(model);
  if (const auto* bicycle = dynamic_cast<BicycleModel*>(car.get())) {
    BicycleSettings settings = bicycle->settings();
    settings.assists = assists;
    return std::make_unique<BicycleModel>(settings);
  }
  if (const auto* ode = dynamic_cast<OdeModel*>(car.get())) {
    OdeSettings settings = ode->settings();
    settings.car.assists = assists;
    auto made = std::make_unique<OdeModel>(settings);
    EXPECT_TRUE(made->Build().ok());
    return made;
  }
  if (const auto* mechanism = dynamic_cast<MultibodyModel*>(car.get())) {
    MultibodySettings settings = mechanism->settings();
    settings.assists = assists;
    auto made = std::make_unique<MultibodyModel>(settings);
    EXPECT_TRUE(made->Build().ok());
    return made;
  }
  return car;  // it has none
}

// With the brakes and the engine that the driver asks for: wheels lock and spin.
inline std::unique_ptr<VehicleModel> MakeWithoutAssists(const ModelCase& model) { return MakeWith(model, {}); }

inline BicycleSettings SettingsWithoutAssists() {
  BicycleSettings settings = DefaultSettings();
  settings.assists = {};
  return settings;
}

}  // namespace rodeira::dynamics
