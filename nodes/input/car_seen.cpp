// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/car_seen.hpp"

#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::nodes {

CarSeen SeenOf(const msg::VehicleState& state) {
  const auto& q = state.attitude_wb();
  const auto& v = state.velocity_w_mps();
  // The first column of the rotation is the car's own x axis.
  const double forward = (1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z())) * v.x() +
                         2.0 * (q.x() * q.y() + q.w() * q.z()) * v.y() + 2.0 * (q.x() * q.z() - q.w() * q.y()) * v.z();
  return CarSeen{forward, state.gear(), static_cast<double>(state.steering_torque_nm()),
                 static_cast<double>(state.wheels()[0].load_n()) - static_cast<double>(state.wheels()[1].load_n())};
}

base::Result<CarSeen> SeeCar(const lockstep::Inbox& inbox) {
  if (!inbox.Has(idl::topics::kVehicleState)) return CarSeen{};
  const auto state = idl::Decode<msg::VehicleState>(*inbox.Latest(idl::topics::kVehicleState).payload);
  if (!state) return state.error();
  return SeenOf(state.value());
}

}  // namespace rodeira::nodes
