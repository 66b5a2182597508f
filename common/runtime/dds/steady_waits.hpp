// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::dds {

// Fast DDS 2.9.1 waits at its ports of shared memory until a moment of the system time (boost::interprocess). While the
// system time is before 1970 each of these waits ends at once, and a process that waits takes half a core; where the
// system time is set back during a wait, the wait is as much longer. A program that calls this function waits on the
// monotonic clock instead, for what was left when the wait began, at most two seconds: the library waits again.
//
// Its stamps of samples begin at the system time and go on by the monotonic clock; a stamp of a year before 1970 would
// hold the writing thread for minutes.
//
// It does so by taking the place of sem_timedwait and pthread_mutex_timedlock of the C library and of the library's own
// Time_t::now; calling it links them in, and it returns whether they are the ones that the whole program uses.
bool SharedWaitsAreSteady();

}  // namespace rodeira::dds
