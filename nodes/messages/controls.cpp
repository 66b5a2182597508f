// SPDX-License-Identifier: Apache-2.0
#include "nodes/messages/controls.hpp"

#include <cstdint>

namespace rodeira::nodes {

dynamics::Controls FromMessage(const msg::Controls& in) {
  dynamics::Controls out;
  out.steering_wheel_rad = in.steering_wheel_rad();
  out.throttle = in.throttle();
  out.brake = in.brake();
  out.clutch = in.clutch();
  out.handbrake = in.handbrake();
  out.gear = in.gear();
  out.gearbox = in.gearbox_mode() == 1 ? dynamics::GearboxMode::kManual : dynamics::GearboxMode::kAutomatic;
  out.starter = in.starter() != 0;
  return dynamics::Clamp(out);
}

msg::Controls ToMessage(const dynamics::Controls& in) {
  msg::Controls out;
  out.steering_wheel_rad(in.steering_wheel_rad);
  out.throttle(in.throttle);
  out.brake(in.brake);
  out.clutch(in.clutch);
  out.handbrake(in.handbrake);
  out.gear(in.gear);
  out.gearbox_mode(static_cast<std::uint32_t>(in.gearbox));
  out.starter(in.starter ? 1 : 0);
  return out;
}

}  // namespace rodeira::nodes
