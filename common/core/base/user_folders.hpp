// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

// Where a person's own files lie (XDG Base Directory Specification). Nothing is made here.
namespace rodeira::base {

// $XDG_DATA_HOME/rodeira, else ~/.local/share/rodeira.
std::filesystem::path UserDataFolder();
// $XDG_CONFIG_HOME/rodeira, else ~/.config/rodeira.
std::filesystem::path UserConfigFolder();
// $RODEIRA_CACHE, else $XDG_CACHE_HOME/rodeira, else ~/.cache/rodeira; empty where $RODEIRA_CACHE is "off".
std::filesystem::path UserCacheFolder();

}  // namespace rodeira::base
