// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/config.hpp"
#include "common/vehicle/assists/assists.hpp"
#include "common/vehicle/dynamics/powertrain.hpp"
#include "common/vehicle/dynamics/suspension.hpp"
#include "common/vehicle/dynamics/tyre.hpp"
#include "common/vehicle/dynamics/wheel.hpp"

// The parts of a vehicle file that every model shares. Each reads one mapping; problems stay in the file's collection.
namespace rodeira::dynamics {

// engine, clutch, gearbox and, where it is there, automatic.
PowertrainSettings ReadPowertrain(const config::Map& root);
SuspensionSettings ReadSuspension(const config::Map& map);
WheelSettings ReadWheel(const config::Map& map);
Enveloping ReadEnveloping(const config::Map& map);
BrakeSettings ReadBrakes(const config::Map& map);
// `assists`: wrong where the brakes that they work have no torque.
assists::AssistSettings ReadAssists(const config::Map& root, const BrakeSettings& brakes);
TyreSettings ReadTyre(const config::Map& map);
// Damping at low speeds no larger than wheels so light can bear in steps of this length: at most I / (R² dt), half of
// where the step of a wheel is no longer stable.
void LimitDamping(const WheelSettings& wheel, double step_s, TyreSettings& tyre);

}  // namespace rodeira::dynamics
