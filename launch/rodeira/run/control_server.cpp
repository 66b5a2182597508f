// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/control_server.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "common/runtime/launch/command_answer.hpp"
#include "launch/rodeira/run/control_folder.hpp"

namespace rodeira::cli {
namespace {

constexpr std::size_t kMaxConnections = 32;
constexpr std::size_t kLongestLine = 1024;  // the clock takes at most 4096 at a time

}  // namespace

ControlServer::Connection::~Connection() { ::close(file); }

void ControlServer::Connection::Say(const std::string& line) const {
  const std::string text = line + "\n";
  (void)::send(file, text.data(), text.size(),
               MSG_NOSIGNAL | MSG_DONTWAIT);  // a client that does not read loses answers
}

base::Result<std::unique_ptr<ControlServer>> ControlServer::Open(const std::filesystem::path& socket) {
  if (const int living = ConnectTo(socket); living >= 0) {
    ::close(living);
    return base::Failed("run.already_running", "a run of this name is controlled there already", socket.string());
  }
  // Bound beside its name and renamed when it listens: no client finds a socket that refuses.
  const std::string path = socket.string() + fmt::format(".{}", ::getpid());
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path))
    return base::Failed("run.no_control_socket", "the path is too long for a socket", path);
  std::memcpy(address.sun_path, path.c_str(), path.size());
  ::unlink(path.c_str());
  const int file = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (file < 0 || ::bind(file, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      ::listen(file, 8) != 0 || ::rename(path.c_str(), socket.c_str()) != 0) {
    const int error = errno;
    if (file >= 0) ::close(file);
    ::unlink(path.c_str());
    return base::Failed("run.no_control_socket",
                        fmt::format("cannot create a control socket: {}", std::strerror(error)), socket.string());
  }
  return std::unique_ptr<ControlServer>(new ControlServer(file, socket));
}

ControlServer::~ControlServer() {
  ::unlink(socket_.c_str());
  ::close(file_);
}

void ControlServer::Accept() {
  while (connections_.size() < kMaxConnections) {
    const int file = ::accept4(file_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (file < 0) return;
    connections_.push_back(std::make_shared<Connection>(file));
  }
}

void ControlServer::Read(Connection& connection) {
  char buffer[1024];
  while (connection.open && connection.pending.size() <= kLongestLine) {
    const ssize_t size = ::recv(connection.file, buffer, sizeof(buffer), 0);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) {
      connection.open = false;
      return;
    }
    connection.pending.append(buffer, static_cast<std::size_t>(size));
  }
}

std::optional<AskedLine> ControlServer::Next() {
  Accept();
  for (const auto& connection : connections_) {
    Read(*connection);
    const auto end = connection->pending.find('\n');
    if (end == std::string::npos && connection->pending.size() > kLongestLine) {
      connection->Say(launch::AnswerLine(
          base::WrongInput("command.too_long", fmt::format("a line of more than {} bytes was found", kLongestLine))));
      connection->pending.clear();
      connection->open = false;
    }
    if (end == std::string::npos) continue;
    AskedLine asked{connection->pending.substr(0, end),
                    [connection](const std::string& answer) { connection->Say(answer); }};
    connection->pending.erase(0, end + 1);
    return asked;
  }
  std::erase_if(connections_, [](const auto& connection) {
    return !connection->open && connection->pending.find('\n') == std::string::npos;
  });
  return std::nullopt;
}

}  // namespace rodeira::cli
