// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::dds {

// Errors of Fast DDS go to standard error as lines "rodeira: Fast DDS: …", and nowhere if that is a terminal: what a
// person needs to know Rodeira says itself. Once a process.
void RedirectLibraryLog();

}  // namespace rodeira::dds
