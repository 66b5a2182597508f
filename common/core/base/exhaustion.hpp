// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace rodeira::base {

// From here on a program that needs more memory or threads than this machine or its limits allow ends with one sentence
// on standard error and exit status 1, on whichever thread that happens. Every other exception that is caught nowhere
// aborts as before. Call it once, from main. The sentence begins with the program's name.
void NameExhaustion(std::string_view program);

// Ends the process at once with the program's name and `sentence` on standard error and exit status 1: for a library
// that waits without end for what this machine does not give it. Any thread.
[[noreturn]] void EndExhausted(std::string_view sentence);

}  // namespace rodeira::base
