// SPDX-License-Identifier: Apache-2.0
#pragma once

// Ctrl-C and SIGTERM as a flag that long work polls, so that it ends in order and removes what it unpacked.
namespace rodeira::cli {

// From here on SIGINT, SIGTERM and SIGHUP do nothing but make Interrupted() true, and a limit on the size of files is
// an error of writing to report, like a full disk.
void CatchInterrupts();
// Whether one of these signals has come. Any thread.
bool Interrupted();

}  // namespace rodeira::cli
