// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "common/core/base/file_cache.hpp"
#include "common/world/road/hills.hpp"

namespace rodeira::road {

// MakeHills, to the bit. Its heights are read from the cache where it has them, and kept there; null: no cache.
terrain::ElevationGrid MakeHillsOnce(const HillsSpec& spec, std::span<const AxisPoint> axis, base::FileCache* cache);

}  // namespace rodeira::road
