// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/world/traffic_map/heights.hpp"

namespace rodeira::traffic_map {

// The companion file anew (docs/reference/traffic-maps.md); empty where there is nothing to say. Numbers are the
// shortest that read the same.
std::string CompanionText(const Heights& heights);

// The companion file after it was edited: `loaded` is what `text` said. Parts that say the same keep their bytes, and
// so do the heights of curves that stay; comments of a part that is written anew stand above it. `text` again where
// nothing changed; a text in which the parts cannot be told apart (`{…}` in one line) is written anew whole, its
// comments above it. What comes back always reads as `heights`.
std::string CompanionText(const Heights& heights, const Heights& loaded, const std::string& text);

}  // namespace rodeira::traffic_map
