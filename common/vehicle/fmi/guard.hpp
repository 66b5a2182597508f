// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

namespace rodeira::fmi {

// Calls foreign code in this thread such that a crash in it (a wrong address, a division by zero, abort) ends the call
// and not the process. Returns 0, or the signal that it crashed with. What the code held then (memory, locks) stays as
// it was: nothing of it may be called again.
int CallGuarded(void (*code)(void* context), void* context);

template <class Code>
int CallGuarded(Code&& code) {
  using Plain = std::remove_reference_t<Code>;
  return CallGuarded([](void* context) { (*static_cast<Plain*>(context))(); }, &code);
}

}  // namespace rodeira::fmi
