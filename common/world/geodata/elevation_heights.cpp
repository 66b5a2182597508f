// SPDX-License-Identifier: Apache-2.0
#include "common/world/geodata/elevation_heights.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>

#include <cmath>
#include <string>

#include "common/world/geodata/gdal_quiet.hpp"
#include "common/world/terrain/elevation_grid.hpp"

namespace rodeira::terrain::geodata {
namespace {

// Metres a unit of height; nothing where the unit is none of length.
std::optional<double> HeightUnit(std::string name) {
  for (char& c : name) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const char* metre :
       {"", "m", "metre", "metres", "meter", "meters", "unknown", "unspecified", "undefined", "none"}) {
    if (name == metre) return 1.0;
  }
  for (const char* foot : {"ft", "foot", "feet", "international foot", "international feet"}) {
    if (name == foot) return 0.3048;
  }
  for (const char* foot : {"us-ft", "sft", "us survey foot", "us survey feet", "u.s. survey foot", "u.s. survey feet",
                           "foot_us", "ftus"}) {
    if (name == foot) return 1200.0 / 3937.0;
  }
  return std::nullopt;
}

// Metres for a number in the file: offset + scale times it.
struct HeightScale {
  double scale = 1.0;
  double offset = 0.0;
};

base::Result<HeightScale> HeightScaleOf(GDALRasterBand& band, const std::optional<BtHeader>& header,
                                        const std::filesystem::path& path) {
  if (header) return HeightScale{header->vertical_scale, 0.0};
  const auto unit = HeightUnit(band.GetUnitType());
  if (!unit) {
    return base::WrongInput("terrain.wrong_elevation_file",
                            fmt::format("the heights are in '{}'; metres or feet were expected", band.GetUnitType()),
                            path.string());
  }
  const HeightScale scale{*unit * band.GetScale(), *unit * band.GetOffset()};
  if (!std::isfinite(scale.scale) || !std::isfinite(scale.offset) || scale.scale == 0.0) {
    return base::WrongInput("terrain.wrong_elevation_file",
                            fmt::format("the heights' scale is {} and their offset {}; numbers were expected",
                                        band.GetScale(), band.GetOffset()),
                            path.string());
  }
  return scale;
}

}  // namespace

std::string BandsSentence(int bands) {
  return fmt::format("the raster has {} bands; one, the heights, was expected (gdal_translate -b picks one)", bands);
}

base::Result<std::vector<float>> ReadHeights(GDALDataset& dataset, const std::optional<BtHeader>& header,
                                             const std::filesystem::path& path) {
  const int columns = dataset.GetRasterXSize();
  const int rows = dataset.GetRasterYSize();
  if (dataset.GetRasterCount() != 1) {
    return base::WrongInput("terrain.wrong_elevation_file", BandsSentence(dataset.GetRasterCount()), path.string());
  }
  GDALRasterBand* band = dataset.GetRasterBand(1);
  const auto metres = HeightScaleOf(*band, header, path);
  if (!metres) return metres.error();
  std::vector<float> by_row(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  if (band->RasterIO(GF_Read, 0, 0, columns, rows, by_row.data(), columns, rows, GDT_Float32, 0, 0, nullptr) !=
      CE_None) {
    return base::WrongInput("file.cannot_read", fmt::format("the heights cannot be read; {}", QuietGdal::Words()),
                            path.string());
  }
  int has_void = 0;
  const auto no_data = static_cast<float>(band->GetNoDataValue(&has_void));
  const bool as_they_are = metres.value().scale == 1.0 && metres.value().offset == 0.0;
  std::vector<float> heights(by_row.size());
  const auto at = [](int line, int length, int place) {
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(length) + static_cast<std::size_t>(place);
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float found = by_row[at(rows - 1 - row, columns, column)];
      const bool is_void =
          !std::isfinite(found) || found == ElevationGrid::kVoid || (has_void != 0 && found == no_data);
      const float scaled =
          as_they_are ? found
                      : static_cast<float>(metres.value().offset + static_cast<double>(found) * metres.value().scale);
      heights[at(column, rows, row)] = is_void || !std::isfinite(scaled) ? ElevationGrid::kVoid : scaled;
    }
  }
  return heights;
}

}  // namespace rodeira::terrain::geodata
