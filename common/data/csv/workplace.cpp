// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/workplace.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "common/core/base/files.hpp"
#include "common/core/base/put_in_place.hpp"

namespace rodeira::csv {

namespace fs = std::filesystem;

Workplace::~Workplace() {
  std::error_code problem;
  if (!path_.empty()) fs::remove_all(path_, problem);
}

base::Status Workplace::Begin() {
  std::error_code problem;
  if (fs::exists(fs::symlink_status(target_, problem))) {
    const bool folder = fs::is_directory(target_, problem);
    return base::WrongInput("file.exists",
                            fmt::format("{} is there already; another name was expected",
                                        folder ? "the folder for the tables" : "a file of that name"),
                            target_.string());
  }
  const fs::path beside = target_.string() + fmt::format(".{}.part", ::getpid());
  if (target_.has_parent_path()) fs::create_directories(target_.parent_path(), problem);
  if (!fs::create_directory(beside, problem)) {
    return base::Failed("table.cannot_write",
                        fmt::format("the folder for the tables cannot be made: {}", problem.message()),
                        target_.string());
  }
  path_ = beside;
  return {};
}

base::Status Workplace::Finish(const std::string& name) {
  if (auto status = base::SyncFolder(path_); !status) return status.error().WithContext(target_.string());
  const fs::path made = name.empty() ? path_ : path_ / name;
  if (::renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) != 0) {
    const std::string what = fmt::format("the tables cannot be put in their place: {}", std::strerror(errno));
    return base::Failed("table.cannot_write", what, target_.string());
  }
  if (name.empty()) path_.clear();
  base::SyncName(target_);
  return {};
}

}  // namespace rodeira::csv
