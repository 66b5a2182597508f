// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rodeira::base {

// The text as a JSON string with its quotes: quotes, backslashes and control characters are escaped. Precondition: the
// text is UTF-8.
std::string JsonText(std::string_view text);

}  // namespace rodeira::base
