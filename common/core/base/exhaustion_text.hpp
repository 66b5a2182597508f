// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rodeira::base {

// What a program says that ends for want of memory or threads (exhaustion.hpp).
inline constexpr std::string_view kNoMemoryText =
    "the memory that this program may use is exhausted (ulimit -v, the container's limit, RAM)";
inline constexpr std::string_view kNoThreadText =
    "no further thread can be started (ulimit -u, the container's limit of processes, memory)";

}  // namespace rodeira::base
