// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/view/scene/playback/player.hpp"

namespace rodeira::nodes {

// What the keys of a window do in which a recording is watched. `symbol` and `modifiers` are SDL's; `marks_ns` ascend.
// False where the key does nothing to the player.
bool TakeReplayKey(scene::Player& player, const std::vector<std::int64_t>& marks_ns, int symbol, int modifiers);
// These keys and the window's own, a line each.
std::string ReplayHelp();
// The most important ones, in a few words.
std::string ReplayKeysInShort();

}  // namespace rodeira::nodes
