// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/udp_port.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace rodeira::dds {
namespace {

bool CanBind(in_addr_t address, int port) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return false;
  sockaddr_in where{};
  where.sin_family = AF_INET;
  where.sin_addr.s_addr = address;
  where.sin_port = htons(static_cast<std::uint16_t>(port));
  const bool bound = ::bind(socket, reinterpret_cast<const sockaddr*>(&where), sizeof(where)) == 0;
  ::close(socket);
  return bound;
}

}  // namespace

bool UdpPortIsFree(int port) { return CanBind(htonl(INADDR_ANY), port); }

bool IsOwnAddress(const std::string& address) {
  in_addr wanted{};
  ifaddrs* all = nullptr;
  if (::inet_pton(AF_INET, address.c_str(), &wanted) != 1 || ::getifaddrs(&all) != 0) return false;
  bool found = false;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET || (one->ifa_flags & IFF_RUNNING) == 0)
      continue;
    found = found || reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr.s_addr == wanted.s_addr;
  }
  ::freeifaddrs(all);
  return found;
}

}  // namespace rodeira::dds
