// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/control_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "common/core/base/hash.hpp"

namespace rodeira::cli {

base::Result<std::filesystem::path> ControlFolder() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  const std::filesystem::path folder = runtime != nullptr && *runtime != '\0'
                                           ? std::filesystem::path(runtime) / "rodeira"
                                           : std::filesystem::path(fmt::format("/tmp/rodeira-{}", ::getuid()));
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    return base::Failed("run.no_control_socket",
                        fmt::format("the folder of control sockets cannot be made: {}", std::strerror(errno)),
                        folder.string());
  }
  struct stat found {};
  if (::lstat(folder.c_str(), &found) != 0 || !S_ISDIR(found.st_mode) || found.st_uid != ::getuid() ||
      (found.st_mode & 077) != 0) {
    return base::Failed("run.no_control_socket", "the folder is not yours alone, so no control socket is created in it",
                        folder.string());
  }
  return folder;
}

std::filesystem::path ControlSocket(const std::filesystem::path& folder, const std::string& run) {
  const bool plain = !run.empty() && run.size() <= 40 && run.front() != '.' &&
                     std::all_of(run.begin(), run.end(), [](unsigned char c) {
                       return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                              c == '-' || c == '.';
                     });
  return folder / ((plain ? run : base::Hex(base::Hash(run))) + ".ctl");
}

int ConnectTo(const std::filesystem::path& socket, bool* is_busy) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = socket.string();
  if (path.size() >= sizeof(address.sun_path)) return -1;
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const int file = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (file < 0) return -1;
  if (::connect(file, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) {
    ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
    return file;
  }
  if (is_busy != nullptr) *is_busy = errno == EAGAIN;
  ::close(file);
  return -1;
}

bool IsRunning(const std::string& run) {
  const auto folder = ControlFolder();
  bool is_busy = false;
  const int connection = folder ? ConnectTo(ControlSocket(folder.value(), run), &is_busy) : -1;
  if (connection >= 0) ::close(connection);
  return connection >= 0 || is_busy;
}

std::vector<std::filesystem::path> LivingRuns(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> living;
  std::error_code problem;
  for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
    if (entry.path().extension() != ".ctl") continue;
    bool is_busy = false;
    const int file = ConnectTo(entry.path(), &is_busy);
    if (file < 0 && !is_busy) continue;
    if (file >= 0) ::close(file);
    living.push_back(entry.path());
  }
  std::sort(living.begin(), living.end());
  return living;
}

}  // namespace rodeira::cli
