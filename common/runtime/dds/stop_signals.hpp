// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::dds {

// From now on SIGINT, SIGTERM and SIGHUP are counted and do not end the process.
void CountStopSignals();
// How many of them have arrived since the process began to count them. Any thread.
int StopSignals();

}  // namespace rodeira::dds
