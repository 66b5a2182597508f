// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rodeira::terrain {

// The WKT (Esri's form) of a projection that needs no library: the PROJ string of a transverse Mercator or a UTM zone
// of the northern hemisphere on GRS80 or WGS84, in metres, with every parameter given once, in digits without an
// exponent. The text is the one that GDAL writes. Nothing for all other definitions.
std::optional<std::string> PlainProjectionWkt(std::string_view definition);

}  // namespace rodeira::terrain
