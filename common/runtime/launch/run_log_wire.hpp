// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/runtime/lockstep/run_log.hpp"
#include "idl/messages.hpp"

// The clock's log as messages: between processes and in recordings.
namespace rodeira::launch {

// Remarks also get the simulated time of their step.
msg::WallTime ToWire(const lockstep::WallTime& wall);
msg::Remark ToWire(const lockstep::Remark& remark, std::int64_t base_step_ns);

}  // namespace rodeira::launch
