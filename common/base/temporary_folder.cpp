#include "common/base/temporary_folder.hpp"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

namespace rodeira::base {
namespace fs = std::filesystem;

Result<TemporaryFolder> TemporaryFolder::Make(std::string_view what) {
  std::error_code problem;
  const fs::path where = fs::temp_directory_path(problem);
  if (problem) return Failed("no temporary folder can be made: " + problem.message(), where.string());
  // mkdtemp asks for six letters to replace.
  std::string name = (where / ("rodeira-" + std::string(what) + "-")).string() + std::string(6, 'X');
  if (::mkdtemp(name.data()) == nullptr) return Failed(std::string("no temporary folder can be made: ") + std::strerror(errno), where.string());
  return TemporaryFolder(name);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace rodeira::base
