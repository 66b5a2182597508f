// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/launch_path.hpp"

#include <filesystem>
#include <system_error>

namespace rodeira::cli {

namespace fs = std::filesystem;

base::Result<std::string> LaunchPath(const std::string& file) {
  std::error_code problem;
  const fs::file_status status = fs::status(file, problem);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) {
    return base::WrongInput(
        "file.not_regular",
        "is not a regular file; every node reads the launch file, and relative paths in it are resolved against its "
        "folder; write it into a file first",
        file);
  }
  const fs::path folder = fs::absolute(file, problem).parent_path();
  const fs::path real = fs::canonical(folder, problem);
  if (problem || real == folder.lexically_normal()) return file;
  return (real / fs::path(file).filename()).string();
}

}  // namespace rodeira::cli
