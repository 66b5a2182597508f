// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/use_devices.hpp"

namespace rodeira::nodes {

void UseDevices() {}

}  // namespace rodeira::nodes
