// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/user_folders.hpp"

#include <cstdlib>
#include <string_view>

namespace rodeira::base {
namespace {

std::filesystem::path Folder(const char* variable, const char* below_home) {
  const char* set = std::getenv(variable);
  if (set != nullptr && *set != '\0') return std::filesystem::path(set) / "rodeira";
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr ? home : ".") / below_home / "rodeira";
}

}  // namespace

std::filesystem::path UserDataFolder() { return Folder("XDG_DATA_HOME", ".local/share"); }

std::filesystem::path UserConfigFolder() { return Folder("XDG_CONFIG_HOME", ".config"); }

std::filesystem::path UserCacheFolder() {
  const char* cache = std::getenv("RODEIRA_CACHE");
  if (cache == nullptr || *cache == '\0') return Folder("XDG_CACHE_HOME", ".cache");
  return std::string_view(cache) == "off" ? std::filesystem::path() : std::filesystem::path(cache);
}

}  // namespace rodeira::base
