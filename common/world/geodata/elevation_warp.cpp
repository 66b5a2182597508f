// SPDX-License-Identifier: Apache-2.0
#include "common/world/geodata/elevation_warp.hpp"

#include <fmt/format.h>
#include <gdal_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "common/core/geometry/angle.hpp"
#include "common/world/geodata/gdal_quiet.hpp"
#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::terrain::geodata {
namespace {

constexpr double kPolar_deg = 84.0;   // UTM ends there
constexpr double kWidest_deg = 12.0;  // so far from a zone's middle its scale is off by half a per cent
constexpr double kMaxTimes = 16.0;    // as many heights as the raster has, where its cells are long and thin
constexpr double kDegree_m = 111'000.0;

// EPSG's number of the map for a place.
int MapFor(double longitude_deg, double latitude_deg) {
  if (std::fabs(latitude_deg) > kPolar_deg) return latitude_deg > 0.0 ? 5041 : 5042;
  const double turned = longitude_deg - 360.0 * std::floor((longitude_deg + 180.0) / 360.0);  // from -180 on
  const int zone = std::clamp(static_cast<int>(std::floor((turned + 180.0) / 6.0)) + 1, 1, 60);
  return (latitude_deg < 0.0 ? 32700 : 32600) + zone;
}

class Arguments {
 public:
  explicit Arguments(std::vector<std::string> words) : words_(std::move(words)) {
    for (std::string& word : words_) pointers_.push_back(word.data());
    pointers_.push_back(nullptr);
  }
  char** get() { return pointers_.data(); }

 private:
  std::vector<std::string> words_;
  std::vector<char*> pointers_;
};

}  // namespace

base::Result<GDALDatasetUniquePtr> WarpedToMetres(GDALDataset& raster, const std::string& wkt,
                                                  const std::optional<MapScale>& scale,
                                                  const std::optional<BtHeader>& bt, bool posts,
                                                  const std::filesystem::path& path) {
  const std::string units = scale ? "in units of its map" : "in degrees";
  const auto refuse = [&] {
    return base::WrongInput(
        "terrain.cannot_project",
        fmt::format("the heights, {}, cannot be brought into metres; {}", units, QuietGdal::Words()), path.string());
  };
  const int columns = raster.GetRasterXSize(), rows = raster.GetRasterYSize();
  std::array<double, 6> g{};
  if (raster.GetGeoTransform(g.data()) != CE_None)
    return base::WrongInput("terrain.wrong_georeference", "the raster does not say where it lies (no georeference)",
                            path.string());
  if (bt) g = {bt->left, (bt->right - bt->left) / columns, 0.0, bt->top, 0.0, -(bt->top - bt->bottom) / rows};
  if (posts && columns > 1 && rows > 1 && g[2] == 0.0 && g[4] == 0.0) {
    const double step_x = g[1] * columns / (columns - 1), step_y = g[5] * rows / (rows - 1);
    g = {g[0] - 0.5 * step_x, step_x, 0.0, g[3] - 0.5 * step_y, 0.0, step_y};
  }
  const double longitude = scale ? scale->place.longitude_deg : g[0] + 0.5 * columns * g[1] + 0.5 * rows * g[2],
               latitude = scale ? scale->place.latitude_deg : g[3] + 0.5 * columns * g[4] + 0.5 * rows * g[5];
  if (!(std::fabs(latitude) <= 90.0 && std::fabs(longitude) <= 720.0)) {
    return base::WrongInput("terrain.cannot_project",
                            fmt::format("the middle of the grid, in degrees, lies at longitude {} and latitude {}; a "
                                        "place on the earth was expected",
                                        longitude, latitude),
                            path.string());
  }
  // Metres on the ground by unit of the raster's coordinates.
  const double metres_x = scale ? 1.0 / scale->east_units_a_m : kDegree_m * std::cos(latitude * geometry::kPi / 180.0),
               metres_y = scale ? 1.0 / scale->north_units_a_m : kDegree_m;
  const double width = (columns * std::fabs(g[1]) + rows * std::fabs(g[2])) *
                       (scale ? metres_x / (kDegree_m * std::cos(latitude * geometry::kPi / 180.0)) : 1.0);
  if (!(width <= kWidest_deg)) {
    return base::WrongInput("terrain.cannot_project",
                            fmt::format("the grid, {}, spans {:.6g} degrees of longitude; at most {} was "
                                        "expected, which one map in metres holds (gdalwarp brings it into another one)",
                                        units, width, kWidest_deg),
                            path.string());
  }
  // Square cells as small as the raster's are in either direction: where larger ones are asked for, GDAL's warper takes
  // means of several heights.
  const double across_m = scale ? std::hypot(g[1], g[2]) * metres_x
                                : std::hypot(g[1], g[2]) * kDegree_m * std::cos(latitude * geometry::kPi / 180.0),
               along_m = std::hypot(g[4], g[5]) * metres_y, cell_m = std::min(across_m, along_m);
  if (const double times = std::max(across_m, along_m) / cell_m; !(times <= kMaxTimes)) {
    return base::WrongInput(
        "terrain.cannot_project",
        fmt::format("the cells, {}, are {:.4g} m x {:.4g} m on the ground: too long and thin for a map in "
                    "metres (gdalwarp brings them into one of cells as they should be)",
                    units, across_m, along_m),
        path.string());
  }
  GDALRasterBand* band = raster.GetRasterBand(1);
  int has_void = 0;
  const double no_data = band->GetNoDataValue(&has_void);
  const std::string map = fmt::format("EPSG:{}", MapFor(longitude, latitude));
  std::vector<std::string> lay{"-of", "VRT", "-a_srs", wkt, "-a_ullr"};
  for (const double corner : {g[0], g[3], g[0] + columns * g[1], g[3] + rows * g[5]})
    lay.push_back(fmt::format("{}", corner));
  if (g[2] != 0.0 || g[4] != 0.0) lay.resize(4);  // turned: as it says itself
  if (bt && has_void == 0) lay.insert(lay.end(), {"-a_nodata", "-32768"});
  Arguments lay_words(lay);
  GDALTranslateOptions* how_laid = GDALTranslateOptionsNew(lay_words.get(), nullptr);
  int failed = 0;
  const GDALDatasetUniquePtr laid(
      GDALDataset::FromHandle(GDALTranslate("", GDALDataset::ToHandle(&raster), how_laid, &failed)));
  GDALTranslateOptionsFree(how_laid);
  if (!laid || failed != 0) return refuse();
  Arguments words(
      {"-of", "MEM", "-ot", "Float32", "-r", "bilinear", "-et", "0", "-tr", fmt::format("{}", cell_m),
       fmt::format("{}", cell_m), "-t_srs", map, "-dstnodata",
       fmt::format("{}",
                   has_void != 0 && std::isfinite(no_data) ? no_data : static_cast<double>(ElevationGrid::kVoid))});
  GDALWarpAppOptions* how = GDALWarpAppOptionsNew(words.get(), nullptr);
  GDALDatasetH from = GDALDataset::ToHandle(laid.get());
  GDALDatasetUniquePtr warped(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &from, how, &failed)));
  GDALWarpAppOptionsFree(how);
  if (!warped || failed != 0) return refuse();
  // What a number means stays what it was.
  GDALRasterBand* heights = warped->GetRasterBand(1);
  heights->SetScale(band->GetScale());
  heights->SetOffset(band->GetOffset());
  heights->SetUnitType(band->GetUnitType());
  return warped;
}

}  // namespace rodeira::terrain::geodata
