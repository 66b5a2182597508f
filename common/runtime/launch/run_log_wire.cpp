// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/run_log_wire.hpp"

#include <string>

namespace rodeira::launch {

msg::WallTime ToWire(const lockstep::WallTime& wall) {
  msg::WallTime out;
  out.after_step(wall.after);
  out.through_step(wall.through);
  out.utc_ns(wall.utc_ns);
  out.monotonic_ns(wall.monotonic_ns);
  out.late_ns(wall.late_ns);
  out.pace(wall.pace);
  out.paused(wall.paused ? 1 : 0);
  return out;
}

msg::Remark ToWire(const lockstep::Remark& remark, std::int64_t base_step_ns) {
  msg::Remark out;
  out.step(remark.step);
  out.time_ns(remark.step * base_step_ns);
  out.utc_ns(remark.utc_ns);
  out.monotonic_ns(remark.monotonic_ns);
  out.pace(remark.pace);
  out.kind(std::string(lockstep::RemarkName(remark.kind)));
  out.text(remark.text);
  out.number(remark.number);
  return out;
}

}  // namespace rodeira::launch
