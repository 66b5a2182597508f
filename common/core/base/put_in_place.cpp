// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/put_in_place.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace rodeira::base {

Status PutInPlace(const std::filesystem::path& from, const std::filesystem::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0)
    return Failed("file.cannot_write", fmt::format("the file cannot be put in its place: {}", std::strerror(errno)),
                  to.string());
  SyncName(to);
  return {};
}

void SyncName(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) return;
  (void)::fsync(opened);
  ::close(opened);
}

}  // namespace rodeira::base
