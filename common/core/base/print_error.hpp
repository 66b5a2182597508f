// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "common/core/base/result.hpp"

namespace rodeira::base {

// Writes "program: text of the error" as one line to standard error. Returns the error's exit status.
int PrintError(std::string_view program, const Error& error);

}  // namespace rodeira::base
