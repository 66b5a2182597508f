// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>

#include "common/core/base/nearest_file.hpp"
#include "common/world/geodata/functions.hpp"
#include "common/world/geodata/gdal_quiet.hpp"

namespace rodeira::terrain::geodata {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPictureDrivers[] = {"JPEG", "PNG", "BMP", "GTiff", nullptr};

base::Result<GDALDatasetUniquePtr> OpenFile(const fs::path& path) {
  std::error_code problem;
  if (!fs::is_regular_file(path, problem)) {
    return base::WrongInput("file.not_found",
                            fmt::format("there is no texture file '{}'{}", path.string(), base::NearestFile(path)));
  }
  GDALDatasetUniquePtr dataset(GDALDataset::Open(
      fs::absolute(path).c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, kPictureDrivers));
  if (!dataset)
    return base::WrongInput("terrain.wrong_picture",
                            fmt::format("'{}' is no picture that can be read (JPEG, PNG, BMP, TIFF); {}", path.string(),
                                        QuietGdal::Words()));
  const int width = dataset->GetRasterXSize(), height = dataset->GetRasterYSize();
  if (width < 1 || height < 1 || dataset->GetRasterCount() < 1 || width > kMaxPicture_px || height > kMaxPicture_px) {
    return base::WrongInput("terrain.wrong_picture",
                            fmt::format("the picture '{}' has {} x {} pixels; at most {} a side were expected",
                                        path.string(), width, height, kMaxPicture_px));
  }
  return dataset;
}

// One colour of all pixels. Deeper than 8 bits: their upper ones.
bool ReadBand(GDALRasterBand& band, PictureFile& picture, std::size_t colour) {
  const auto count = static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
  if (band.GetRasterDataType() == GDT_Byte) {
    return band.RasterIO(GF_Read, 0, 0, picture.width_px, picture.height_px, picture.rgb.data() + colour,
                         picture.width_px, picture.height_px, GDT_Byte, 3, 3 * static_cast<GSpacing>(picture.width_px),
                         nullptr) == CE_None;
  }
  std::vector<std::uint16_t> deep(count);
  if (band.RasterIO(GF_Read, 0, 0, picture.width_px, picture.height_px, deep.data(), picture.width_px,
                    picture.height_px, GDT_UInt16, 0, 0, nullptr) != CE_None)
    return false;
  for (std::size_t i = 0; i < count; ++i) picture.rgb[3 * i + colour] = static_cast<std::uint8_t>(deep[i] >> 8);
  return true;
}

// Where one band holds numbers of colours.
void LookUp(const GDALColorTable& table, PictureFile& picture) {
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
    GDALColorEntry entry{0, 0, 0, 255};
    if (picture.rgb[i] < table.GetColorEntryCount()) table.GetColorEntryAsRGB(picture.rgb[i], &entry);
    picture.rgb[i] = static_cast<std::uint8_t>(entry.c1);
    picture.rgb[i + 1] = static_cast<std::uint8_t>(entry.c2);
    picture.rgb[i + 2] = static_cast<std::uint8_t>(entry.c3);
  }
}

}  // namespace

base::Result<PictureFacts> ReadPictureFacts(const fs::path& path) {
  const QuietGdal quiet;
  const auto dataset = OpenFile(path);
  if (!dataset) return dataset.error();
  PictureFacts facts{dataset.value()->GetRasterXSize(), dataset.value()->GetRasterYSize(), std::nullopt};
  std::array<double, 6> g{};
  const bool lies = dataset.value()->GetGeoTransform(g.data()) == CE_None;
  if (lies && g[2] == 0.0 && g[4] == 0.0 && g[1] > 0.0 && g[5] < 0.0) {
    facts.place = PicturePlace{g[0], g[3] + facts.height_px * g[5], g[0] + facts.width_px * g[1], g[3]};
  }
  return facts;
}

base::Result<PictureFile> ReadPicturePixels(const fs::path& path) {
  const QuietGdal quiet;
  const auto opened = OpenFile(path);
  if (!opened) return opened.error();
  GDALDataset& dataset = *opened.value();
  PictureFile picture{dataset.GetRasterXSize(), dataset.GetRasterYSize(), {}};
  picture.rgb.resize(3 * static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px));
  const bool coloured = dataset.GetRasterCount() >= 3;
  for (int colour = 0; colour < 3; ++colour) {
    if (!ReadBand(*dataset.GetRasterBand(coloured ? colour + 1 : 1), picture, static_cast<std::size_t>(colour))) {
      return base::WrongInput("terrain.wrong_picture", fmt::format("the picture '{}' is cut short or broken; {}",
                                                                   path.string(), QuietGdal::Words()));
    }
  }
  const GDALColorTable* table = coloured ? nullptr : dataset.GetRasterBand(1)->GetColorTable();
  if (table != nullptr) LookUp(*table, picture);
  return picture;
}

}  // namespace rodeira::terrain::geodata
