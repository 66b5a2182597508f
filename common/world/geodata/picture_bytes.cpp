// SPDX-License-Identifier: Apache-2.0
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "common/world/geodata/functions.hpp"
#include "common/world/geodata/gdal_quiet.hpp"

namespace rodeira::terrain::geodata {
namespace {

// A file of GDAL's that lies in memory and goes with this.
class MemoryFile {
 public:
  // Not there yet.
  MemoryFile() : name_(NewName()) {}
  // To be read. The bytes must outlive it.
  explicit MemoryFile(std::string_view bytes) : MemoryFile() {
    auto* data = reinterpret_cast<GByte*>(const_cast<char*>(bytes.data()));  // read only below
    VSIFCloseL(VSIFileFromMemBuffer(name_.c_str(), data, bytes.size(), 0));
  }
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const std::string& name() const { return name_; }

 private:
  static std::string NewName() {
    static std::atomic<std::uint64_t> count{0};
    return fmt::format("/vsimem/rodeira-picture-{}", ++count);
  }
  std::string name_;
};

using Dataset = std::unique_ptr<GDALDataset>;

constexpr const char* kExpected = "a PNG, JPEG, BMP or TIFF file was expected";

// Rows of one band as bytes, every third one of the pixels written.
bool ReadRows(GDALRasterBand& band, int first, int rows, int width, std::uint8_t* rgb, std::size_t row_bytes) {
  if (band.GetRasterDataType() == GDT_Byte)
    return band.RasterIO(GF_Read, 0, first, width, rows, rgb, width, rows, GDT_Byte, 3,
                         static_cast<GSpacing>(row_bytes)) == CE_None;
  std::vector<std::uint16_t> wide(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
  if (band.RasterIO(GF_Read, 0, first, width, rows, wide.data(), width, rows, GDT_UInt16, 0, 0) != CE_None)
    return false;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < width; ++x)
      rgb[static_cast<std::size_t>(y) * row_bytes + 3 * static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(
          wide[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] >> 8);
  }
  return true;
}

// Numbers of colours become the colours of a table.
void PaintByTable(const GDALColorTable& table, std::uint8_t* rgb, std::size_t pixels) {
  for (std::size_t i = 0; i < pixels; ++i) {
    GDALColorEntry colour{};
    table.GetColorEntryAsRGB(rgb[3 * i], &colour);
    rgb[3 * i] = static_cast<std::uint8_t>(colour.c1), rgb[3 * i + 1] = static_cast<std::uint8_t>(colour.c2),
            rgb[3 * i + 2] = static_cast<std::uint8_t>(colour.c3);
  }
}

// All three bands at once where they are bytes.
bool ReadColours(GDALDataset& set, int first, int rows, int width, std::uint8_t* rgb, std::size_t row_bytes) {
  int bands[] = {1, 2, 3};
  return set.RasterIO(GF_Read, 0, first, width, rows, rgb, width, rows, GDT_Byte, 3, bands, 3,
                      static_cast<GSpacing>(row_bytes), 1, nullptr) == CE_None;
}

class GdalPicture final : public PictureReader {
 public:
  explicit GdalPicture(std::string_view bytes) : file_(bytes) {}
  GdalPicture(const GdalPicture&) = delete;
  GdalPicture& operator=(const GdalPicture&) = delete;
  ~GdalPicture() override {
    const QuietGdal quiet;
    set_.reset();
  }

  base::Status Open(int max_px) {
    const QuietGdal quiet;
    constexpr const char* kDrivers[] = {"PNG", "JPEG", "BMP", "GTiff", nullptr};
    set_.reset(GDALDataset::Open(file_.name().c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers));
    if (set_ == nullptr || set_->GetRasterCount() == 0)
      return base::WrongInput("edit.not_a_picture", std::string("this is no picture; ") + kExpected);
    const int width = width_px(), height = height_px();
    if (width < 1 || height < 1 || width > max_px || height > max_px)
      return base::WrongInput(
          "edit.picture_too_large",
          fmt::format("the picture has {} by {} pixels; at most {} each way were expected", width, height, max_px));
    return {};
  }
  int width_px() const override { return set_->GetRasterXSize(); }
  int height_px() const override { return set_->GetRasterYSize(); }

  base::Status ReadAll(std::uint8_t* rgb, const std::function<bool(int)>& ready) override {
    const QuietGdal quiet;
    constexpr int kRows = 256;
    const int width = width_px(), height = height_px();
    const std::size_t row_bytes = 3 * static_cast<std::size_t>(width);
    const bool coloured = set_->GetRasterCount() >= 3, bytes = set_->GetRasterBand(1)->GetRasterDataType() == GDT_Byte;
    const GDALColorTable* table = set_->GetRasterBand(1)->GetColorTable();
    for (int first = 0; first < height; first += kRows) {
      const int rows = std::min(kRows, height - first);
      std::uint8_t* into = rgb + static_cast<std::size_t>(first) * row_bytes;
      bool good = true;
      if (coloured && bytes) good = ReadColours(*set_, first, rows, width, into, row_bytes);
      for (int channel = 0; good && channel < 3 && !(coloured && bytes); ++channel)
        good =
            ReadRows(*set_->GetRasterBand(coloured ? channel + 1 : 1), first, rows, width, into + channel, row_bytes);
      if (!good)
        return base::WrongInput("edit.not_a_picture",
                                fmt::format("the picture cannot be read beyond line {} of {}", first, height));
      if (table != nullptr && !coloured)
        PaintByTable(*table, into, static_cast<std::size_t>(rows) * static_cast<std::size_t>(width));
      if (!ready(first + rows)) return base::Failed("run.interrupted", "reading the picture was cancelled");
    }
    return {};
  }

  std::optional<std::vector<std::uint8_t>> ReadEighth(int width, int height) override {
    const QuietGdal quiet;
    constexpr int kLevel = 3;
    if (set_->GetRasterCount() != 3) return std::nullopt;
    std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int channel = 0; channel < 3; ++channel) {
      GDALRasterBand& band = *set_->GetRasterBand(channel + 1);
      if (band.GetRasterDataType() != GDT_Byte || band.GetOverviewCount() != kLevel) return std::nullopt;
      GDALRasterBand* small = band.GetOverview(kLevel - 1);
      if (small == nullptr || small->GetXSize() != width || small->GetYSize() != height ||
          !ReadRows(*small, 0, height, width, rgb.data() + channel, 3 * static_cast<std::size_t>(width)))
        return std::nullopt;
    }
    return rgb;
  }

 private:
  MemoryFile file_;
  Dataset set_;
};

}  // namespace

base::Result<std::unique_ptr<PictureReader>> OpenPicture(std::string_view bytes, int max_px) {
  auto picture = std::make_unique<GdalPicture>(bytes);
  if (auto status = picture->Open(max_px); !status) return status.error();
  return std::unique_ptr<PictureReader>(std::move(picture));
}

base::Result<std::string> EncodePng(const std::uint8_t* rgb, int width_px, int height_px) {
  const QuietGdal quiet;
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDriver* png = GetGDALDriverManager()->GetDriverByName("PNG");
  if (memory == nullptr || png == nullptr)
    return base::Failed("edit.cannot_write_picture", "this GDAL cannot write PNG files");
  const Dataset set(memory->Create("", width_px, height_px, 3, GDT_Byte, nullptr));
  const GSpacing row = 3 * static_cast<GSpacing>(width_px);
  bool good = set != nullptr;
  for (int channel = 0; good && channel < 3; ++channel) {
    good = set->GetRasterBand(channel + 1)
               ->RasterIO(GF_Write, 0, 0, width_px, height_px, const_cast<std::uint8_t*>(rgb) + channel, width_px,
                          height_px, GDT_Byte, 3, row) == CE_None;
  }
  const MemoryFile file;
  if (good)
    good = Dataset(png->CreateCopy(file.name().c_str(), set.get(), FALSE, nullptr, nullptr, nullptr)) != nullptr;
  vsi_l_offset size = 0;
  const GByte* bytes = good ? VSIGetMemFileBuffer(file.name().c_str(), &size, FALSE) : nullptr;
  if (bytes == nullptr) return base::Failed("edit.cannot_write_picture", "the picture cannot be made into a PNG");
  VSIUnlink((file.name() + ".aux.xml").c_str());
  return std::string(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

}  // namespace rodeira::terrain::geodata
