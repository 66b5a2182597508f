// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/runtime/launch/launch.hpp"

namespace rodeira::dds {

// The running interfaces of this PC.
struct NetworkState {
  std::vector<std::string> addresses;  // IPv4, 127.0.0.1 of the loop-back interface included
  std::vector<std::string> only_ipv6;  // names of interfaces with an IPv6 address and no IPv4 address
  bool has_loop_back = false;          // it is up: packets to an address of this PC go over it
};
// Empty where the system does not tell its interfaces.
NetworkState ReadNetworkState();

// What of the network a run needs.
struct NetworkNeed {
  launch::TransportSettings transport;
  std::string interface;     // address of `discovery.interface`; empty: any
  bool meets_later = false;  // processes may be started again
};
// Of any process of the launch.
NetworkNeed NeedOf(const launch::Launch& launch);

// Why the processes of a run cannot reach each other over this PC's network; nothing if they can. Fast DDS itself waits
// without an error.
std::optional<std::string> NetworkProblem(const NetworkNeed& need, const NetworkState& state);

}  // namespace rodeira::dds
