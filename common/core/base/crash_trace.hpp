// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::base {

// From here on a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) writes the signal and a backtrace to standard error
// before it ends the process by the same signal: one line a frame, "PROGRAM(+0xOFFSET)", for addr2line. Call it once,
// from main, before other threads start. Without effect under sanitizers, which have their own.
void TraceCrashes();

}  // namespace rodeira::base
