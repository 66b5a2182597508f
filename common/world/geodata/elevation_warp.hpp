// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gdal_priv.h>

#include <filesystem>
#include <optional>
#include <string>

#include "common/core/base/result.hpp"
#include "common/world/geodata/map_scale.hpp"
#include "common/world/terrain/bt.hpp"

namespace rodeira::terrain::geodata {

// A raster in degrees, or in a map with a scale that is off (`scale` then says how, and where on the earth its middle
// lies), brought into the UTM zone of its middle (WGS 84; near the poles the polar stereographic map UPS) by GDAL's
// warper: bilinear, north up, square cells as small as the raster's in either direction, voids where the raster has
// none. `wkt`: its coordinates. `bt`: the header where it is a .bt. `posts`: the outermost heights stand on the edges,
// which GDAL takes for those of cells. Wrong input where GDAL cannot, or where it lies on no place of the earth.
base::Result<GDALDatasetUniquePtr> WarpedToMetres(GDALDataset& raster, const std::string& wkt,
                                                  const std::optional<MapScale>& scale,
                                                  const std::optional<BtHeader>& bt, bool posts,
                                                  const std::filesystem::path& path);

}  // namespace rodeira::terrain::geodata
