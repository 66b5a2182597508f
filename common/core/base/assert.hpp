// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Assertions, on in every build.

namespace rodeira::base {

/// Prints the condition and its place on standard error and aborts. Never returns.
/// @param condition text of the condition that is false
/// @param file source file of the assertion
/// @param line line of the assertion in that file
[[noreturn]] void AssertionFailed(const char* condition, const char* file, int line);

}  // namespace rodeira::base

/// Aborts the program if a condition is false, in every build. It is for programming errors only: wrong input from
/// outside is refused with a base::Error instead.
/// @param condition expression that must be true; it is evaluated once
#define RODEIRA_ASSERT(condition) \
  ((condition) ? static_cast<void>(0) : ::rodeira::base::AssertionFailed(#condition, __FILE__, __LINE__))
