// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rodeira::base {

// The text as one line for a terminal, whatever it holds: control characters and what is no UTF-8 become
// visible ("\n", "\x1b"), and behind `limit_bytes` it ends with "…".
std::string Printable(std::string_view text, std::size_t limit_bytes = 2000);

}  // namespace rodeira::base
