// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/run_control_client.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>

namespace rodeira::launch {

std::unique_ptr<RunControlClient> RunControlClient::Open() {
  const char* named = std::getenv(kVariable);
  const std::string path = named == nullptr ? "" : named;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof(address.sun_path)) return nullptr;
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const int file = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (file < 0) return nullptr;
  std::unique_ptr<RunControlClient> client(new RunControlClient(file));
  return ::connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 ? std::move(client)
                                                                                            : nullptr;
}

RunControlClient::~RunControlClient() { ::close(file_); }

void RunControlClient::Send(const std::string& command) {
  const std::string line = command + "\n";
  (void)::send(file_, line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

std::optional<std::string> RunControlClient::Answer() {
  std::array<char, 1024> buffer;
  const ssize_t size = ::recv(file_, buffer.data(), buffer.size(), MSG_DONTWAIT);
  if (size > 0) pending_.append(buffer.data(), static_cast<std::size_t>(size));
  const auto end = pending_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = pending_.substr(0, end);
  pending_.erase(0, end + 1);
  return line;
}

}  // namespace rodeira::launch
