// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "common/core/base/result.hpp"

namespace rodeira::base {

// The error of a file or program that cannot be opened, made or started: "MESSAGE: what the system says of
// `error_number` (an errno)". Failed where the machine is short of something or broken (descriptors, memory, room, a
// disk that cannot be read); wrong input where the name asked for is to blame.
Error OpenError(std::string_view message, int error_number, std::string_view context);

}  // namespace rodeira::base
