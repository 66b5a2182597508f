// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::cli {

// Splits each text, "KEY=VALUE", at its first '='; the value may be empty. Wrong input where a text has no '=' or
// nothing before it; the error names `option`.
base::Result<std::vector<std::pair<std::string, std::string>>> KeyValues(std::string_view option,
                                                                         const std::vector<std::string>& texts);

}  // namespace rodeira::cli
