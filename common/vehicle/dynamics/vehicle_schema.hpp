// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::dynamics {

// The keys of `rodeira: vehicle/1` for the models `bicycle` and `ode`, and for each other model. A file of the model
// `library` has the keys of its shared object, too.
const config::Schema& VehicleSchema();
const config::Schema& MultibodySchema();
const config::Schema& FmuSchema();
const config::Schema& LibrarySchema();

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
const std::vector<config::Key>& CentreDifferentialKeys();
const std::vector<config::Key>& DrivenAxleKeys();  // `driven_axle` alone
const std::vector<config::Key>& AutomaticKeys();
const std::vector<config::Key>& SlipCurveKeys();
const std::vector<config::Key>& TyreKeys();
const std::vector<config::Key>& OdeKeys();
const std::vector<config::Key>& FmuDimensionKeys();
// Of the model `multibody`.
const std::vector<config::Key>& ChassisKeys();
const std::vector<config::Key>& HungWheelKeys();
const std::vector<config::Key>& ColumnKeys();
const std::vector<config::Key>& OuterDimensionKeys();
// Coefficients of the Magic Formula with those of its aligning moment; of the aligning moment alone.
const std::vector<config::Key>& FormulaKeys();
const std::vector<config::Key>& AligningKeys();
// `enveloping` of a wheel and of an FMU.
config::Key EnvelopingKey();

}  // namespace rodeira::dynamics
