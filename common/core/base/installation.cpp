// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/installation.hpp"

#include <cstdlib>
#include <system_error>

namespace rodeira::base {
namespace {

namespace fs = std::filesystem;

bool HoldsData(const fs::path& folder) {
  std::error_code problem;
  return fs::is_directory(folder / "launch", problem) && fs::is_directory(folder / "configs", problem);
}

// The prefix of the installation that has `folder` as its bin/ or libexec/rodeira/; empty in a build folder: there all
// programs lie side by side.
fs::path PrefixOf(const fs::path& folder) {
  std::error_code problem;
  for (const char* up : {"..", "../.."}) {
    const fs::path prefix = (folder / up).lexically_normal();
    const fs::path lies = folder.lexically_relative(prefix);
    if (lies != "bin" && lies != "libexec/rodeira") continue;
    if (fs::is_directory(prefix / "libexec/rodeira", problem)) return prefix;
  }
  return {};
}

}  // namespace

fs::path ProgramFolder() {
  std::error_code problem;
  const fs::path self = fs::read_symlink("/proc/self/exe", problem);
  return problem ? fs::path(".") : self.parent_path();
}

fs::path FindProgram(std::string_view name, const fs::path& folder) {
  if (fs::path(name).is_absolute()) return name;
  const fs::path beside = folder / name;
  const fs::path prefix = PrefixOf(folder);
  if (prefix.empty()) return beside;
  std::error_code problem;
  for (const fs::path& found : {beside, prefix / "libexec/rodeira" / name, prefix / "bin" / name}) {
    if (fs::exists(found, problem)) return found;
  }
  return beside;
}

bool IsInstalled(const fs::path& folder) { return !PrefixOf(folder).empty(); }

fs::path SharedDataFolder(const fs::path& folder) {
  const char* set = std::getenv("RODEIRA_DATA");
  if (set != nullptr && *set != '\0') return set;
  const fs::path prefix = PrefixOf(folder);
  if (!prefix.empty()) return HoldsData(prefix / "share/rodeira") ? prefix / "share/rodeira" : fs::path();
  for (fs::path tree = folder; !tree.empty() && tree != tree.parent_path(); tree = tree.parent_path()) {
    if (HoldsData(tree)) return tree;
  }
  return {};
}

}  // namespace rodeira::base
