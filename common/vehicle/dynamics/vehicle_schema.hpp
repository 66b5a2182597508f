// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::dynamics {

// The keys of `rodeira: vehicle/1` for the models `bicycle` and `ode`; for the model `fmu`.
const config::Schema& VehicleSchema();
const config::Schema& FmuSchema();

// The keys of each part.
const std::vector<config::Key>& BodyKeys();
const std::vector<config::Key>& SteeringKeys();
const std::vector<config::Key>& DimensionKeys();
const std::vector<config::Key>& SuspensionKeys();
const std::vector<config::Key>& WheelKeys();
const std::vector<config::Key>& BrakeKeys();
const std::vector<config::Key>& AssistKeys();
const std::vector<config::Key>& EngineKeys();
const std::vector<config::Key>& ClutchKeys();
const std::vector<config::Key>& GearboxKeys();
const std::vector<config::Key>& DifferentialKeys();
const std::vector<config::Key>& AutomaticKeys();
const std::vector<config::Key>& SlipCurveKeys();
const std::vector<config::Key>& TyreKeys();
const std::vector<config::Key>& OdeKeys();
const std::vector<config::Key>& FmuDimensionKeys();
// Coefficients of the Magic Formula with those of its aligning moment; of the aligning moment alone.
const std::vector<config::Key>& FormulaKeys();
const std::vector<config::Key>& AligningKeys();
config::Key EnvelopingKey();

}  // namespace rodeira::dynamics
