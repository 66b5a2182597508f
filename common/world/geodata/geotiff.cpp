// SPDX-License-Identifier: Apache-2.0
#include <gdal_priv.h>

#include <array>
#include <limits>
#include <memory>

#include "common/world/geodata/functions.hpp"
#include "common/world/geodata/gdal_quiet.hpp"

namespace rodeira::terrain::geodata {

base::Status WriteGeoTiff(const GeoTiff& raster, const std::string& file) {
  std::unique_ptr<GDALDataset> set;
  {
    const QuietGdal quiet;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    if (driver == nullptr) return base::Failed("file.cannot_write", "this GDAL cannot write GeoTIFF files", file);
    set.reset(driver->Create(file.c_str(), raster.columns, raster.rows, static_cast<int>(raster.bands.size()),
                             GDT_Float32, nullptr));
  }
  if (set == nullptr) return base::Failed("file.cannot_write", "the raster cannot be written", file);
  std::array<double, 6> transform = {raster.west_m, raster.pixel_m, 0.0, raster.north_m, 0.0, -raster.pixel_m};
  bool good = set->SetGeoTransform(transform.data()) == CE_None;
  for (std::size_t k = 0; k < raster.bands.size(); ++k) {
    const std::vector<float>& values = raster.values(k);
    GDALRasterBand& band = *set->GetRasterBand(static_cast<int>(k) + 1);
    band.SetDescription(raster.bands[k].c_str());
    good = good && band.SetNoDataValue(std::numeric_limits<double>::quiet_NaN()) == CE_None;
    good = good && band.RasterIO(GF_Write, 0, 0, raster.columns, raster.rows, const_cast<float*>(values.data()),
                                 raster.columns, raster.rows, GDT_Float32, 0, 0) == CE_None;
  }
  if (!good) return base::Failed("file.cannot_write", "the raster could not be written to its end", file);
  return {};
}

}  // namespace rodeira::terrain::geodata
