#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "common/base/result.hpp"
#include "common/terrain/elevation_grid.hpp"

namespace rodeira::terrain {

// Reads an elevation file through GDAL: .bt, gzipped or not, with the .prj beside it; or a raster of another format
// (GeoTIFF, Arc/Info ASCII …), whose heights then stand in the middles of its pixels. Metres in plan; north up.
// Wrong input where the file is missing, cut short, of no format known, in degrees, turned, or has a broken .prj.
base::Result<std::shared_ptr<const ElevationGrid>> LoadElevation(const std::filesystem::path& path);

// The coordinate system as WKT 1, in the spelling of .prj files. `definition` is an EPSG code ("EPSG:3763") or WKT;
// wrong input where PROJ knows no such system or its coordinates are degrees.
base::Result<std::string> ProjectionWkt(std::string_view definition);

}  // namespace rodeira::terrain
