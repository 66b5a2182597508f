// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "common/core/base/bytes.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"

namespace rodeira::scene {

// A level of a tile as bytes, for a cache of the same program: no format that is read elsewhere.
base::Bytes BytesOf(const GroundLevel& level);
// The same level, to the bit; nothing where the bytes are not exactly one.
std::optional<GroundLevel> LevelFrom(std::span<const std::byte> bytes);

}  // namespace rodeira::scene
