// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"

namespace rodeira::nodes {

// A colour by its name (red, blue, yellow, green, white, silver, grey, black), or by six hexadecimal digits, red, green
// and blue, with or without a # before them. Wrong input with the nearest name otherwise.
base::Result<scene::Colour> PaintOf(std::string_view text);

// The paints that a person chose, by the cars' ids. The others keep theirs.
using CarPaints = std::map<std::uint64_t, scene::Colour>;
// Of the moment's cars.
void PaintCars(scene::SceneSnapshot& moment, const CarPaints& paints);

}  // namespace rodeira::nodes
