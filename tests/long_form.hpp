// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

namespace rodeira {

// Whether tests run in their long form: RODEIRA_LONG_TESTS is set (tests/run --endurance tests).
inline bool IsLongForm() { return std::getenv("RODEIRA_LONG_TESTS") != nullptr; }

// A test's seconds, seeds or counts: what its claim needs, and those of its long form.
template <class Value>
Value BriefOrLong(const Value& brief, const Value& long_form) {
  return IsLongForm() ? long_form : brief;
}

}  // namespace rodeira
