// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::dds {

// Fast DDS 2.9.1 keeps a plain mutex in each of its ports of shared memory. A process that is killed while it holds one
// takes it along: a process that writes to that port then waits a second, again and again, until after some seconds the
// library makes the port anew (docs/decisions/0012-recovery.md says how often). A program that calls this function has
// the process-shared mutexes that it makes robust: the kernel gives them back when their owner dies, and the next that
// locks one goes on. What they protect stays usable: a ring of counters and cells that are written one by one, and a
// count of waiters.
//
// It does so by taking the place of functions of the C library (see the .cpp; steady_waits.hpp); calling it links them
// in, and it returns whether they are the ones that the whole program uses.
bool SharedMutexesAreRobust();

}  // namespace rodeira::dds
