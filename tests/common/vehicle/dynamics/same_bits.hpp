// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "common/core/base/state.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::dynamics {

// Restores `second` from a snapshot of `first` and steps both, `step(car, i)` each: their states must agree to the bit
// behind every one of `steps` steps.
template <class Step>
void ExpectTheSameBitsFromASnapshot(VehicleModel& first, VehicleModel& second, int steps, const Step& step) {
  base::StateWriter snapshot;
  first.Save(snapshot);
  base::StateReader reader(snapshot.bytes());
  second.Restore(reader);
  ASSERT_TRUE(reader.Finish().ok());
  for (int i = 0; i < steps; ++i) {
    step(first, i);
    step(second, i);
    base::StateWriter a, b;
    first.Save(a);
    second.Save(b);
    ASSERT_EQ(a.bytes(), b.bytes()) << "step " << i;
  }
}

}  // namespace rodeira::dynamics
