// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/command.hpp"

namespace rodeira::launch {

// As `rodeira ctl` and the control socket take them (docs/reference/run-control.md).
const std::vector<std::string>& CommandNames();

// "pause", "step 10", "pace 0.5", "mark second lap": one line. Wrong input with what was expected and the nearest name.
base::Result<lockstep::Command> ParseCommand(std::string_view line);

}  // namespace rodeira::launch
