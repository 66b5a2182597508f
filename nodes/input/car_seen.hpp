// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/inbox.hpp"
#include "idl/messages.hpp"

namespace rodeira::nodes {

// What a person's controls need to know of the car: nothing where no vehicle is wired to the node.
struct CarSeen {
  double speed_mps = 0.0;                // forward
  std::int32_t gear = 1;                 // that is in
  double steering_torque_Nm = 0.0;       // what the road gives back to its steering wheel, positive to the left
  double front_load_difference_N = 0.0;  // left less right: what its front wheels stand on
};
// Of a vehicle's newest sample.
CarSeen SeenOf(const msg::VehicleState& state);
// Wrong input where the sample cannot be read.
base::Result<CarSeen> SeeCar(const lockstep::Inbox& inbox);

}  // namespace rodeira::nodes
