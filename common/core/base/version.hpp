// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// The version of Rodeira.

#include <string_view>

namespace rodeira::base {

/// Version of the Rodeira library that the program is linked with.
/// @return "MAJOR.MINOR.PATCH" (PROJECT_VERSION of CMake)
std::string_view Version();

}  // namespace rodeira::base
