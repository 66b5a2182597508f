// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::nodes {

// Registers the devices that this build of rodeira-input can read: SDL's, or none (RODEIRA_VIEW=OFF).
void UseDevices();

}  // namespace rodeira::nodes
