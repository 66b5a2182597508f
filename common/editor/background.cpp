// SPDX-License-Identifier: Apache-2.0
#include "common/editor/background.hpp"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

#include "common/core/base/files.hpp"
#include "common/world/traffic_map/map_file.hpp"
#include "common/world/traffic_map/picture.hpp"

namespace rodeira::editor {
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
    return fmt::format("/vsimem/rodeira-editor-{}", ++count);
  }
  std::string name_;
};

struct Quiet {
  Quiet() { CPLPushErrorHandler(CPLQuietErrorHandler); }
  ~Quiet() { CPLPopErrorHandler(); }
};

using Dataset = std::unique_ptr<GDALDataset>;

constexpr const char* kExpected = "a PNG, JPEG, BMP or TIFF file was expected";

base::Result<Dataset> OpenPicture(const std::string& name) {
  GDALAllRegister();
  constexpr const char* kDrivers[] = {"PNG", "JPEG", "BMP", "GTiff", nullptr};
  Dataset set(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers));
  if (set == nullptr || set->GetRasterCount() == 0)
    return base::WrongInput("edit.not_a_picture", std::string("this is no picture; ") + kExpected);
  const int width = set->GetRasterXSize(), height = set->GetRasterYSize();
  if (width < 1 || height < 1 || width > kLargestPicture_px || height > kLargestPicture_px)
    return base::WrongInput("edit.picture_too_large",
                            fmt::format("the picture has {} by {} pixels; at most {} each way were expected", width,
                                        height, kLargestPicture_px));
  return set;
}

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

// Row by row from the top; `ready(rows)` is told how many there are, and may say false.
base::Status ReadAll(GDALDataset& set, Pixels& pixels, const std::function<bool(int)>& ready) {
  constexpr int kRows = 256;
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(pixels.width_px);
  const bool coloured = set.GetRasterCount() >= 3, bytes = set.GetRasterBand(1)->GetRasterDataType() == GDT_Byte;
  const GDALColorTable* table = set.GetRasterBand(1)->GetColorTable();
  for (int first = 0; first < pixels.height_px; first += kRows) {
    const int rows = std::min(kRows, pixels.height_px - first);
    std::uint8_t* into = &pixels.rgb[static_cast<std::size_t>(first) * row_bytes];
    bool good = true;
    if (coloured && bytes) good = ReadColours(set, first, rows, pixels.width_px, into, row_bytes);
    for (int channel = 0; good && channel < 3 && !(coloured && bytes); ++channel)
      good = ReadRows(*set.GetRasterBand(coloured ? channel + 1 : 1), first, rows, pixels.width_px, into + channel,
                      row_bytes);
    if (!good)
      return base::WrongInput("edit.not_a_picture",
                              fmt::format("the picture cannot be read beyond line {} of {}", first, pixels.height_px));
    if (table != nullptr && !coloured)
      PaintByTable(*table, into, static_cast<std::size_t>(rows) * static_cast<std::size_t>(pixels.width_px));
    if (!ready(first + rows))
      return base::Failed("run.interrupted", "the picture was not read to its end: somebody stopped that");
  }
  return {};
}

// A picture that its file gives at an eighth of its size without being read whole; nothing where there is none.
std::optional<Pyramid> ReadSmall(GDALDataset& set) {
  constexpr std::size_t kLevel = 3;
  const int width = Pyramid::SizeAt(set.GetRasterXSize(), kLevel),
            height = Pyramid::SizeAt(set.GetRasterYSize(), kLevel);
  if (set.GetRasterCount() != 3) return std::nullopt;
  Pixels pixels{width, height,
                std::vector<std::uint8_t>(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  for (int channel = 0; channel < 3; ++channel) {
    GDALRasterBand& band = *set.GetRasterBand(channel + 1);
    if (band.GetRasterDataType() != GDT_Byte || band.GetOverviewCount() != static_cast<int>(kLevel))
      return std::nullopt;
    GDALRasterBand* small = band.GetOverview(static_cast<int>(kLevel) - 1);
    if (small == nullptr || small->GetXSize() != width || small->GetYSize() != height ||
        !ReadRows(*small, 0, height, width, pixels.rgb.data() + channel, 3 * static_cast<std::size_t>(width)))
      return std::nullopt;
  }
  return Pyramid(set.GetRasterXSize(), set.GetRasterYSize(), kLevel, std::move(pixels));
}

base::Result<std::string> ToPng(Pixels& pixels) {
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDriver* png = GetGDALDriverManager()->GetDriverByName("PNG");
  if (memory == nullptr || png == nullptr)
    return base::Failed("edit.cannot_write_picture", "this GDAL cannot write PNG files");
  const Dataset set(memory->Create("", pixels.width_px, pixels.height_px, 3, GDT_Byte, nullptr));
  const GSpacing row = 3 * static_cast<GSpacing>(pixels.width_px);
  bool good = set != nullptr;
  for (int channel = 0; good && channel < 3; ++channel) {
    good = set->GetRasterBand(channel + 1)
               ->RasterIO(GF_Write, 0, 0, pixels.width_px, pixels.height_px, pixels.rgb.data() + channel,
                          pixels.width_px, pixels.height_px, GDT_Byte, 3, row) == CE_None;
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

}  // namespace

base::Result<Pixels> DecodePicture(std::string_view bytes, const Progress& progress) {
  const Quiet quiet;
  const MemoryFile file(bytes);
  auto set = OpenPicture(file.name());
  if (!set) return set.error();
  Pixels pixels{set.value()->GetRasterXSize(), set.value()->GetRasterYSize(), {}};
  pixels.rgb.resize(3 * static_cast<std::size_t>(pixels.width_px) * static_cast<std::size_t>(pixels.height_px));
  const auto ready = [&](int rows) { return !progress || progress(static_cast<double>(rows) / pixels.height_px); };
  if (auto status = ReadAll(*set.value(), pixels, ready); !status) return status.error();
  return pixels;
}

base::Result<std::shared_ptr<const Pyramid>> ReadPyramid(std::string_view bytes, const Progress& progress,
                                                         const Sooner& preview) {
  const Quiet quiet;
  const MemoryFile file(bytes);
  auto set = OpenPicture(file.name());
  if (!set) return set.error();
  if (auto small = preview ? ReadSmall(*set.value()) : std::nullopt)
    preview(std::make_shared<const Pyramid>(std::move(*small)));
  PyramidBuilder builder(set.value()->GetRasterXSize(), set.value()->GetRasterYSize());
  const int height = builder.finest().height_px;
  std::atomic<int> filled{0};
  std::atomic<bool> ended{false};
  std::thread grower([&] {
    for (int grown = 0; grown < height;) {
      filled.wait(grown);
      if (ended) return;
      grown = filled;
      builder.Grow(grown);
    }
  });
  const auto ready = [&](int rows) {
    filled = rows;
    filled.notify_one();
    return !progress || progress(static_cast<double>(rows) / height);
  };
  const base::Status status = ReadAll(*set.value(), builder.finest(), ready);
  if (!status) {
    ended = true;
    filled = -1;
    filled.notify_one();
  }
  grower.join();
  if (!status) return status.error();
  return std::make_shared<const Pyramid>(std::move(builder).Finish());
}

base::Result<std::string> ImportPicture(const std::filesystem::path& path) {
  auto bytes = base::ReadText(path, traffic_map::kMaxBytes / 2);
  if (!bytes) return bytes.error();
  auto pixels = DecodePicture(bytes.value());
  if (!pixels) return pixels.error().WithContext(path.string());
  if (traffic_map::ReadPictureInfo(bytes.value())) return bytes;
  const Quiet quiet;
  auto png = ToPng(pixels.value());
  if (!png) return base::Failed(png.error().id, png.error().message, path.string());
  return png;
}

}  // namespace rodeira::editor
