// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/core/config/config.hpp"

namespace rodeira::launch {

// How the processes of a run find each other.
enum class DiscoveryKind {
  kMulticast,  // by the domain's multicast address; over shared memory, by its ports
  kPeers,      // by telling every address of a list; no multicast
  kServer,     // by asking a server, which is the clock's process; no multicast
};

// How the processes of a run find each other. The first member says which of the others count.
struct Discovery {
  static constexpr std::uint16_t kServerPort = 11811;

  DiscoveryKind kind = DiscoveryKind::kMulticast;
  std::string interface;               // address by which this PC takes part; empty: all that it has
  std::vector<std::string> addresses;  // kPeers: of every PC that may hold processes of the run, this one's too
  std::uint32_t participants = 32;     // kPeers: so many processes are looked for at each address
  std::string address;                 // kServer: the PC of the clock
  std::uint16_t port = kServerPort;    // kServer: UDP
};

// "multicast", "peers", "server".
std::string_view Word(DiscoveryKind kind);
// Of the key `kind`; the others of `participants` (1 to 119) and `port`. Problems stay in the file's collection.
DiscoveryKind ReadDiscoveryKind(const config::Map& map);
// The parts that a launch file and a laboratory file write in the same way.
std::uint32_t ReadParticipants(const config::Map& map);
std::uint16_t ReadPort(const config::Map& map);
// An IPv4 address in dotted form; a problem of the file where it is none.
std::string ReadAddress(const config::Map& map, std::string_view key);

// `discovery: {kind, …}` of a launch file. Keys that belong to another kind are unknown keys.
Discovery ReadDiscovery(const config::Map& map);

}  // namespace rodeira::launch
