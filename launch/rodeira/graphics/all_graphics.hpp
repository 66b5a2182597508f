// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::cli {

// Registers every drawing part of the front door (UseGraphics).
void UseAllGraphics();

}  // namespace rodeira::cli
