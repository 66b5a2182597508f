// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rodeira::dds {

// Whether no process has this UDP port, on any address of this PC. Fast DDS itself says nothing of a taken port.
bool UdpPortIsFree(int port);
// Whether this PC has the IPv4 address, on an interface that runs: where a cable is missing Fast DDS silently opens
// nothing.
bool IsOwnAddress(const std::string& address);

}  // namespace rodeira::dds
