// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "common/world/terrain/geographic.hpp"

namespace rodeira::terrain::geodata {

// How a map in metres, feet … shows the ground about one of its places.
struct MapScale {
  EarthPlace place;
  double east_units_a_m = 1.0, north_units_a_m = 1.0;  // of the map's x and y, by a metre on the ground
};

// Units of the map: those of its own coordinates. By small steps on WGS 84's ellipsoid. Nothing where PROJ does not
// know the system, or it has no such place.
std::optional<MapScale> ScaleAt(const std::string& wkt, double x, double y);

// Whether the scale, in units of `metres_a_unit`, is off by more than half a per cent: that of UTM is off by 0.1 % at
// most, that of Web Mercator by 47 % at 47 degrees north.
bool IsOffScale(const MapScale& scale, double metres_a_unit);

}  // namespace rodeira::terrain::geodata
