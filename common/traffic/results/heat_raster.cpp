// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/traffic/motion/drivetrain.hpp"
#include "common/traffic/network/graph_bounds.hpp"
#include "common/traffic/results/lane_tables.hpp"
#include "common/world/terrain/geodata.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kMaxPixels = 1e8;

struct Pixel {
  LaneCell sum;
  double length_m = 0.0;
  double free_m2ps = 0.0;  // the free speed of its cells, each as often as it is long
};

// Row by row from the north-west.
struct Raster {
  double west_m = 0.0, north_m = 0.0, pixel_m = 1.0;
  int columns = 0, rows = 0;
  std::vector<Pixel> pixels;
};

// A raster around all lanes, without pixels.
base::Result<Raster> MakeRaster(const lanes::Graph& graph, double pixel_m, const std::string& file) {
  const GraphBounds bounds = BoundsOf(graph);
  Raster raster;
  raster.pixel_m = pixel_m;
  raster.west_m = pixel_m * std::floor(bounds.west_m / pixel_m);
  raster.north_m = pixel_m * std::ceil(bounds.north_m / pixel_m);
  const double columns = std::floor((bounds.east_m - raster.west_m) / pixel_m) + 1.0,
               rows = std::floor((raster.north_m - bounds.south_m) / pixel_m) + 1.0;
  if (!(columns * rows <= kMaxPixels) || columns < 1.0 || rows < 1.0) {
    return base::WrongInput(
        "traffic.raster_too_large",
        fmt::format("{:.0f} by {:.0f} pixels of {} m were found; at most 10^8 were expected (larger pixels make fewer)",
                    columns, rows, pixel_m),
        file);
  }
  raster.columns = static_cast<int>(columns), raster.rows = static_cast<int>(rows);
  return raster;
}

base::Result<Raster> Gather(const lanes::Graph& graph, const LaneStatistics& statistics, double pixel_m,
                            const std::string& file) {
  auto framed = MakeRaster(graph, pixel_m, file);
  if (!framed) return framed.error();
  Raster raster = std::move(framed).value();
  const auto columns = static_cast<double>(raster.columns), rows = static_cast<double>(raster.rows);
  raster.pixels.resize(static_cast<std::size_t>(columns * rows));
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const double length = statistics.CellLength_m(track);
    for (std::size_t i = 0; i < statistics.CellsOf(track).size(); ++i) {
      const Eigen::Vector3d p = graph[track].curve.At((static_cast<double>(i) + 0.5) * length).p_W;
      const auto column =
          static_cast<std::size_t>(std::clamp(std::floor((p.x() - raster.west_m) / pixel_m), 0.0, columns - 1.0));
      const auto row =
          static_cast<std::size_t>(std::clamp(std::floor((raster.north_m - p.y()) / pixel_m), 0.0, rows - 1.0));
      Pixel& pixel = raster.pixels[row * static_cast<std::size_t>(raster.columns) + column];
      const LaneCell& cell = statistics.CellsOf(track)[i];
      pixel.length_m += length;
      pixel.free_m2ps += length * statistics.FreeSpeed_mps(track, i);
      pixel.sum.distance_m += cell.distance_m, pixel.sum.time_s += cell.time_s, pixel.sum.fuel_mg += cell.fuel_mg;
    }
  }
  return raster;
}

}  // namespace

base::Status CheckHeatRaster(const lanes::Graph& graph, double pixel_m, const std::string& file) {
  const auto frame = MakeRaster(graph, pixel_m, file);
  if (!frame) return frame.error();
  return {};
}

base::Status WriteHeatRaster(const lanes::Graph& graph, const LaneStatistics& statistics, double pixel_m,
                             const std::string& file) {
  auto gathered = Gather(graph, statistics, pixel_m, file);
  if (!gathered) return gathered.error();
  const Raster& raster = gathered.value();
  constexpr std::array<const char*, 5> kBands = {"flow_vehph", "density_vehpkm", "speed_mps", "fuel_mlpkm", "free_mps"};
  const auto& geodata = terrain::SharedGeodata();
  if (!geodata) return geodata.error();
  const double watched = std::max(statistics.watched_s(), 1e-9);
  std::vector<float> values(raster.pixels.size());
  terrain::GeoTiff tiff{raster.west_m, raster.north_m, raster.pixel_m, raster.columns, raster.rows, {}, {}};
  tiff.bands.assign(kBands.begin(), kBands.end());
  tiff.values = [&](std::size_t k) -> const std::vector<float>& {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto& [sum, length, free_m2ps] = raster.pixels[i];
      const std::array<double, 5> told = {
          3600.0 * sum.Flow_vehps(length, watched), 1000.0 * sum.Density_vehpm(length, watched), sum.Speed_mps(),
          sum.distance_m > 0.0 ? 1e6 * sum.fuel_mg / kFuelDensity_mgpl / sum.distance_m : 0.0, free_m2ps / length};
      values[i] = length > 0.0 ? static_cast<float>(told[k]) : std::numeric_limits<float>::quiet_NaN();
    }
    return values;
  };
  return geodata.value()->WriteGeoTiff(tiff, file);
}

}  // namespace rodeira::traffic
