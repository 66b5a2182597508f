// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/world/terrain/elevation_grid.hpp"
#include "common/world/terrain/ground_move.hpp"

namespace rodeira::terrain {

// Where the heights of a file stand. kUsual: as its format has it: a .bt's outermost heights on its edges (posts),
// another raster's in the middles of its pixels (cells).
enum class Registration { kUsual, kPosts, kCells };

// Reads an elevation file through GDAL: .bt, gzipped or not, or a raster of another format (GeoTIFF, Arc/Info ASCII …),
// with the .prj beside it. North up; coordinates and heights in metres or feet come out as metres, and the coordinate
// system with them; what is in degrees, or in a map with a scale that is off by more than half a per cent
// (Web Mercator), is brought into the UTM zone of its middle (WarpedToMetres). Wrong input where
// the file is missing, cut short, of no format known, turned, of more than one band, or has a broken .prj.
base::Result<std::shared_ptr<const ElevationGrid>> LoadElevation(const std::filesystem::path& path,
                                                                 Registration registration = Registration::kUsual);

// The same, and the map that the heights were brought from where its scale was off; nothing: they were not.
struct LoadedGround {
  std::shared_ptr<const ElevationGrid> grid;
  std::optional<MapOrigin> origin;
};
base::Result<LoadedGround> LoadGround(const std::filesystem::path& path,
                                      Registration registration = Registration::kUsual);

// The .prj that a .bt says lies beside it, if it is not there: then what its header knows (a UTM zone, or nothing) is
// all that is known of where it lies. Nothing for other files, and for those that cannot be read.
std::optional<std::filesystem::path> MissingProjection(const std::filesystem::path& path);

// The coordinate system as WKT 1, in the spelling of .prj files. `definition` is an EPSG code ("EPSG:3763") or WKT;
// wrong input where PROJ knows no such system or its coordinates are degrees.
base::Result<std::string> ProjectionWkt(std::string_view definition);

}  // namespace rodeira::terrain
