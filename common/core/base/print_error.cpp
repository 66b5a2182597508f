// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/print_error.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace rodeira::base {

int PrintError(std::string_view program, const Error& error) {
  fmt::print(stderr, "{}: {}\n", program, error.Text());
  return error.exit_status();
}

}  // namespace rodeira::base
