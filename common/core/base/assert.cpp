// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace rodeira::base {

void AssertionFailed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, condition);
  std::fflush(stderr);
  std::abort();
}

}  // namespace rodeira::base
