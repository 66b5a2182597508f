// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/hash.hpp"

namespace rodeira::base {

// The digest of some sixty thousand results of the mathematics library (sin … pow, arguments without
// pattern). Two processes with equal digests compute the same bits; glibc chooses code by processor (law L7).
Digest MathLibraryFingerprint();

// Whether this process was started with the choice of code that law L7 fixes.
bool MathematicsFixed();

// Law L7: glibc's choice is fixed by GLIBC_TUNABLES, which is read before main. Where it is not set as needed, sets it
// and executes this program anew with the same arguments; returns where nothing was to be done. Call it first in main.
void PinMathLibrary(char** argv);

// The same for the programs that this one starts, without executing it anew: that costs a start of the program. For a
// program that computes nothing of a run itself.
void PinMathLibraryOfChildren();

}  // namespace rodeira::base
