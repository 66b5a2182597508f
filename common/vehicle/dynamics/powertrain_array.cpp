// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/powertrain_array.hpp"

#include "common/core/base/assert.hpp"

namespace rodeira::dynamics {

void StepPowertrains(std::span<const PowertrainSettings* const> settings, std::span<const Controls> controls,
                     std::span<const PowertrainInput> inputs, double dt_s, std::span<Powertrain> cars) {
  RODEIRA_ASSERT(settings.size() == cars.size() && controls.size() == cars.size() && inputs.size() == cars.size());
  for (std::size_t i = 0; i < cars.size(); ++i) (void)cars[i].Step(*settings[i], controls[i], inputs[i], dt_s);
}

}  // namespace rodeira::dynamics
