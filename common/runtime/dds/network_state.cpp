// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/network_state.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <set>

namespace rodeira::dds {
namespace {

constexpr std::string_view kLoopBack = "127.0.0.1";

bool Has(const NetworkState& state, std::string_view address) {
  return std::ranges::find(state.addresses, address) != state.addresses.end();
}

std::optional<std::string> LoopBackProblem(const NetworkState& state) {
  if (state.has_loop_back) return std::nullopt;
  return "the loop-back interface is down, over which the processes of one PC reach each other by UDP; sudo ip link "
         "set lo up, or transport: shared_memory";
}

}  // namespace

NetworkState ReadNetworkState() {
  NetworkState state;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return state;
  std::set<std::string> ipv4, ipv6;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if ((one->ifa_flags & IFF_LOOPBACK) != 0 && (one->ifa_flags & IFF_UP) != 0) state.has_loop_back = true;
    if (one->ifa_addr == nullptr || (one->ifa_flags & IFF_RUNNING) == 0) continue;
    if (one->ifa_addr->sa_family == AF_INET6) ipv6.insert(one->ifa_name);
    if (one->ifa_addr->sa_family != AF_INET) continue;
    ipv4.insert(one->ifa_name);
    std::array<char, INET_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr, text.data(), text.size());
    state.addresses.emplace_back(text.data());
  }
  ::freeifaddrs(all);
  std::ranges::set_difference(ipv6, ipv4, std::back_inserter(state.only_ipv6));
  return state;
}

NetworkNeed NeedOf(const launch::Launch& launch) {
  return {launch.transport_settings(), launch.discovery().interface, launch.keeps_for_restarts()};
}

std::optional<std::string> NetworkProblem(const NetworkNeed& need, const NetworkState& state) {
  const bool over_udp = need.transport.kind == launch::Transport::kUdp || need.transport.has_observers;
  if (!over_udp) {
    if (!need.meets_later || Has(state, kLoopBack)) return std::nullopt;
    return "the loop-back interface has no address 127.0.0.1, over which the processes meet with 'recovery: restart'; "
           "sudo ip link set lo up, or --set recovery=stop";
  }
  if (!need.interface.empty()) {
    if (Has(state, need.interface)) return LoopBackProblem(state);
    return fmt::format(
        "no running interface of this PC has the address {}; is its cable plugged in, its network up (ip address)?",
        need.interface);
  }
  if (!state.addresses.empty()) return LoopBackProblem(state);
  const std::string others =
      state.only_ipv6.empty() ? "" : fmt::format(" (with IPv6 alone: {})", fmt::join(state.only_ipv6, ", "));
  return fmt::format(
      "no running interface of this PC has an IPv4 address{}, which UDP needs; sudo ip link set lo up, or transport: "
      "shared_memory",
      others);
}

}  // namespace rodeira::dds
