// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::base {

// Prints the condition and its place on standard error and aborts. Never returns.
[[noreturn]] void AssertionFailed(const char* condition, const char* file, int line);

}  // namespace rodeira::base

// For our own mistakes only, on in every build. What comes from outside is refused with an Error instead.
#define RODEIRA_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::rodeira::base::AssertionFailed(#condition, __FILE__, __LINE__))
