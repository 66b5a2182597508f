// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/abstract_socket.hpp"

#include <fmt/format.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include "common/core/base/assert.hpp"

namespace rodeira::cli {
namespace {

struct Address {
  sockaddr_un value{};
  socklen_t size = 0;
};
// An abstract name begins with a zero byte.
Address AddressOf(std::string_view name) {
  Address address;
  address.value.sun_family = AF_UNIX;
  RODEIRA_ASSERT(name.size() < sizeof(address.value.sun_path));
  std::memcpy(address.value.sun_path + 1, name.data(), name.size());
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

}  // namespace

std::optional<AbstractSocket> AbstractSocket::Take(std::string_view name) {
  AbstractSocket taken(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const Address address = AddressOf(name);
  // Connections are never accepted: a connection is all that OwnerOf needs.
  if (taken.socket_ < 0 ||
      ::bind(taken.socket_, reinterpret_cast<const sockaddr*>(&address.value), address.size) != 0 ||
      ::listen(taken.socket_, SOMAXCONN) != 0)
    return std::nullopt;
  return taken;
}

std::optional<SocketOwner> AbstractSocket::OwnerOf(std::string_view name) {
  const Address address = AddressOf(name);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return std::nullopt;
  ucred peer{};
  socklen_t size = sizeof(peer);
  const bool found = ::connect(socket, reinterpret_cast<const sockaddr*>(&address.value), address.size) == 0 &&
                     ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0;
  ::close(socket);
  return found ? std::optional(SocketOwner{peer.uid, peer.pid}) : std::nullopt;
}

AbstractSocket::AbstractSocket(AbstractSocket&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

AbstractSocket& AbstractSocket::operator=(AbstractSocket&& other) noexcept {
  std::swap(socket_, other.socket_);
  return *this;
}

AbstractSocket::~AbstractSocket() {
  if (socket_ >= 0) ::close(socket_);
}

std::string UserName(uid_t user) {
  std::vector<char> buffer(16'384);
  passwd entry{};
  passwd* found = nullptr;
  if (::getpwuid_r(user, &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr)
    return fmt::format("'{}'", found->pw_name);
  return fmt::format("number {}", user);
}

}  // namespace rodeira::cli
