// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rodeira::base {

// Version of Rodeira, "MAJOR.MINOR.PATCH" (PROJECT_VERSION of CMake).
std::string_view Version();

}  // namespace rodeira::base
