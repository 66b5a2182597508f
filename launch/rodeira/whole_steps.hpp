// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/step.hpp"

namespace rodeira::cli {

// The base steps of a time in seconds, which `option` names. Wrong input at `place` where it is no multiple of the base
// step.
base::Result<lockstep::Step> WholeSteps(double seconds, std::int64_t base_step_ns, const char* option,
                                        const std::string& place);

}  // namespace rodeira::cli
