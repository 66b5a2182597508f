// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/domains.hpp"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/base/assert.hpp"
#include "common/core/base/hash.hpp"
#include "launch/rodeira/run/shared_memory.hpp"

namespace rodeira::cli {
namespace {

constexpr std::uint32_t kDomains = 200;  // 1 to 200; `rodeira doctor` and other programs begin at 0
// DDSI-RTPS 2.2, 9.6.1.1. Fast DDS numbers its ports in shared memory in the same way.
constexpr std::uint32_t kFirstPort = 7400, kPortsOfDomain = 250;

struct Address {
  sockaddr_un value{};
  socklen_t size = 0;
};
// An abstract name begins with a zero byte and is in no file system.
Address AddressOf(std::uint32_t domain, const DomainPlace& place) {
  Address address;
  address.value.sun_family = AF_UNIX;
  const std::string name = fmt::format("{}{}", place.sockets, domain);
  RODEIRA_ASSERT(name.size() < sizeof(address.value.sun_path));
  std::memcpy(address.value.sun_path + 1, name.data(), name.size());
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

// Of a file such as sem.fastrtps_port7410_mutex.
std::optional<std::uint32_t> DomainOfPort(const std::string& file) {
  constexpr std::string_view kWord = "fastrtps_port";
  const auto at = file.find(kWord);
  std::uint32_t port = 0;
  if (at == std::string::npos) return std::nullopt;
  const char* begin = file.data() + at + kWord.size();
  if (std::from_chars(begin, file.data() + file.size(), port).ec != std::errc{} || port < kFirstPort)
    return std::nullopt;
  return (port - kFirstPort) / kPortsOfDomain;
}

std::string UserName(uid_t user) {
  std::vector<char> buffer(16'384);
  passwd entry{};
  passwd* found = nullptr;
  if (::getpwuid_r(user, &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr)
    return fmt::format("'{}'", found->pw_name);
  return fmt::format("number {}", user);
}

// The user whose run listens on the domain's socket.
std::optional<uid_t> SocketHolder(std::uint32_t domain, const DomainPlace& place) {
  const Address address = AddressOf(domain, place);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return std::nullopt;
  ucred peer{};
  socklen_t size = sizeof(peer);
  const bool found = ::connect(socket, reinterpret_cast<const sockaddr*>(&address.value), address.size) == 0 &&
                     ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
  ::close(socket);
  return found ? std::optional(peer.uid) : std::nullopt;
}

}  // namespace

std::uint32_t PreferredDomain(const std::string& run) {
  return static_cast<std::uint32_t>(1 + base::Hash(run) % kDomains);
}

base::Result<DomainHold> DomainHold::FindFree(const std::string& run, const DomainPlace& place) {
  std::set<std::uint32_t> with_ports;
  for (const std::string& file : SharedMemoryFiles(place.folder)) {
    if (const auto domain = DomainOfPort(file)) with_ports.insert(*domain);
  }
  const std::uint32_t preferred = PreferredDomain(run);
  for (std::uint32_t i = 0; i < kDomains; ++i) {
    const std::uint32_t domain = 1 + (preferred - 1 + i) % kDomains;
    if (with_ports.contains(domain)) continue;
    if (auto hold = Take(domain, place)) return std::move(*hold);
  }
  return base::WrongInput(fmt::format("all DDS domains from 1 to {} are in use on this PC; end other runs, or name one "
                                      "by --domain",
                                      kDomains),
                          fmt::format("run '{}'", run));
}

std::optional<DomainHold> DomainHold::Take(std::uint32_t domain, const DomainPlace& place) {
  DomainHold hold;
  hold.domain_ = domain;
  hold.socket_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const Address address = AddressOf(domain, place);
  // Nothing accepts: a connection is all that it takes to learn the user.
  if (hold.socket_ < 0 || ::bind(hold.socket_, reinterpret_cast<const sockaddr*>(&address.value), address.size) != 0 ||
      ::listen(hold.socket_, SOMAXCONN) != 0)
    return std::nullopt;
  return hold;
}

DomainHold::DomainHold(DomainHold&& other) noexcept { *this = std::move(other); }

DomainHold& DomainHold::operator=(DomainHold&& other) noexcept {
  std::swap(domain_, other.domain_);
  std::swap(socket_, other.socket_);
  return *this;
}

DomainHold::~DomainHold() {
  if (socket_ >= 0) ::close(socket_);
}

std::optional<std::string> OtherUserOf(std::uint32_t domain, const DomainPlace& place) {
  if (const auto holder = SocketHolder(domain, place); holder && *holder != ::geteuid())
    return fmt::format("a run of user {} has domain {}", UserName(*holder), domain);
  for (const std::string& file : SharedMemoryFiles(place.folder)) {
    struct stat found {};
    if (DomainOfPort(file) != domain || ::stat((place.folder / file).c_str(), &found) != 0) continue;
    if (found.st_uid == ::geteuid()) continue;
    return fmt::format("{} of domain {} belongs to user {}", (place.folder / file).string(), domain,
                       UserName(found.st_uid));
  }
  return std::nullopt;
}

}  // namespace rodeira::cli
