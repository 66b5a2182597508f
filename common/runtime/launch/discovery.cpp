// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/discovery.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include "common/core/config/declared.hpp"
#include "common/runtime/launch/launch_schema.hpp"

namespace rodeira::launch {
namespace {

constexpr const char* kExpected = "an IPv4 address as 192.168.10.1 was expected";

bool IsAddress(const std::string& text) {
  in_addr parsed{};
  return ::inet_pton(AF_INET, text.c_str(), &parsed) == 1;
}

}  // namespace

std::string_view Word(DiscoveryKind kind) {
  switch (kind) {
    case DiscoveryKind::kPeers:
      return "peers";
    case DiscoveryKind::kServer:
      return "server";
    default:
      return "multicast";
  }
}

DiscoveryKind ReadDiscoveryKind(const config::Map& map) {
  const std::string kind = map.Choice("kind", {"multicast", "peers", "server"}, "multicast");
  return kind == "peers"    ? DiscoveryKind::kPeers
         : kind == "server" ? DiscoveryKind::kServer
                            : DiscoveryKind::kMulticast;
}

std::uint32_t ReadParticipants(const config::Map& map) {
  return static_cast<std::uint32_t>(
      map.Integer("participants", 1, 119, Discovery().participants));  // the domain has ports for 120
}

std::uint16_t ReadPort(const config::Map& map) {
  return static_cast<std::uint16_t>(map.Integer("port", 1, 65535, Discovery::kServerPort));
}

std::string ReadAddress(const config::Map& map, std::string_view key) {
  const std::string text = map.Text(key);
  if (map.Has(key) && !IsAddress(text)) map.Problem(key, fmt::format("'{}' is '{}'; {}", key, text, kExpected));
  return text;
}

Discovery ReadDiscovery(const config::Map& map) {
  const config::DeclaredMap declared(map, DiscoveryKeys());
  Discovery discovery;
  discovery.kind = ReadDiscoveryKind(declared.MapWith("kind"));
  if (map.Has("interface")) discovery.interface = ReadAddress(declared.MapWith("interface"), "interface");
  if (discovery.kind == DiscoveryKind::kPeers) {
    const config::List addresses = declared.MapWith("addresses").Items("addresses");
    for (std::size_t i = 0; i < addresses.size(); ++i) {
      discovery.addresses.push_back(addresses.Text(i));
      const std::string& address = discovery.addresses.back();
      if (!IsAddress(address)) addresses.Problem(i, fmt::format("address '{}' was found; {}", address, kExpected));
    }
    if (discovery.addresses.empty() && map.Has("addresses")) {
      map.Problem("addresses", "config.too_few",
                  "'addresses' is empty; the address of each PC of the run was expected");
    }
    discovery.participants = ReadParticipants(declared.MapWith("participants"));
  }
  if (discovery.kind == DiscoveryKind::kServer) {
    discovery.address = ReadAddress(declared.MapWith("address"), "address");
    discovery.port = ReadPort(declared.MapWith("port"));
  }
  return discovery;
}

}  // namespace rodeira::launch
