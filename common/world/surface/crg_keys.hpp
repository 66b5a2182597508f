// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "common/world/surface/crg_header.hpp"

namespace rodeira::surface {

// A key of a section: its name in lower case, what it may be, and where it goes. Keys without a place are known and
// change no answer (limits of messages, search strategies, geographic coordinates of the ends).
struct CrgKey {
  std::string_view name;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  void (*put)(CrgHeader& header, double value) = nullptr;
  bool whole = false;  // a whole number
};

// The keys of $ROAD_CRG, $ROAD_CRG_OPTS and $ROAD_CRG_MODS.
std::span<const CrgKey> CrgRoadKeyTable();
std::span<const CrgKey> CrgOptionTable();
std::span<const CrgKey> CrgModifierTable();

}  // namespace rodeira::surface
