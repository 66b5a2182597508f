// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

// The user's folders (XDG Base Directory Specification). No folder is created here.
namespace rodeira::base {

// $XDG_DATA_HOME/rodeira, else ~/.local/share/rodeira.
std::filesystem::path UserDataFolder();
// $XDG_CONFIG_HOME/rodeira, else ~/.config/rodeira.
std::filesystem::path UserConfigFolder();
// $RODEIRA_CACHE, else $XDG_CACHE_HOME/rodeira, else ~/.cache/rodeira; empty where $RODEIRA_CACHE is "off".
std::filesystem::path UserCacheFolder();

}  // namespace rodeira::base
