// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>

namespace rodeira::cli {

// The process that holds a name.
struct SocketOwner {
  uid_t user = 0;
  pid_t process = 0;
};

// A name that one process of this PC holds against all others, of every user: a listening socket in the kernel's
// abstract namespace, which has no file. The kernel releases the name when the process ends, however it ends.
// A network namespace has names of its own.
class AbstractSocket {
 public:
  // Nothing if another process holds the name. Precondition: a name of at most 106 bytes.
  static std::optional<AbstractSocket> Take(std::string_view name);
  // The process that holds the name; nothing if none does.
  static std::optional<SocketOwner> OwnerOf(std::string_view name);

  AbstractSocket(AbstractSocket&& other) noexcept;
  AbstractSocket& operator=(AbstractSocket&& other) noexcept;
  ~AbstractSocket();

 private:
  explicit AbstractSocket(int socket) : socket_(socket) {}
  int socket_ = -1;
};

// The user's name in quotes, or "number N" if the PC has no name for it.
std::string UserName(uid_t user);

}  // namespace rodeira::cli
