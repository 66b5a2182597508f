// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "common/vehicle/dynamics/powertrain.hpp"

namespace rodeira::dynamics {

// A step of many cars' powertrains: arrays of one length, one element a car; its settings may be those of any other
// car too. Each car gets the bits that Powertrain::Step gives it alone; nothing allocates. Its result is
// cars[i].motion().
void StepPowertrains(std::span<const PowertrainSettings* const> settings, std::span<const Controls> controls,
                     std::span<const PowertrainInput> inputs, double dt_s, std::span<Powertrain> cars);

}  // namespace rodeira::dynamics
