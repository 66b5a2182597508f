#include "common/editor/background.hpp"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include "common/base/files.hpp"
#include "common/map/map_file.hpp"
#include "common/map/picture.hpp"

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

base::Result<Dataset> Open(const std::string& name) {
  GDALAllRegister();
  constexpr const char* kDrivers[] = {"PNG", "JPEG", "BMP", "GTiff", nullptr};
  Dataset set(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, kDrivers));
  if (set == nullptr || set->GetRasterCount() == 0) return base::WrongInput(std::string("this is no picture; ") + kExpected);
  const int width = set->GetRasterXSize(), height = set->GetRasterYSize();
  if (width < 1 || height < 1 || width > kLargestPicture_px || height > kLargestPicture_px)
    return base::WrongInput(fmt::format("the picture has {} by {} pixels; at most {} each way were expected", width, height, kLargestPicture_px));
  return set;
}

// Rows of one band as bytes, every third one of the pixels written.
bool ReadRows(GDALRasterBand& band, int first, int rows, int width, std::uint8_t* rgb, std::size_t row_bytes) {
  if (band.GetRasterDataType() == GDT_Byte)
    return band.RasterIO(GF_Read, 0, first, width, rows, rgb, width, rows, GDT_Byte, 3, static_cast<GSpacing>(row_bytes)) == CE_None;
  std::vector<std::uint16_t> wide(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows));
  if (band.RasterIO(GF_Read, 0, first, width, rows, wide.data(), width, rows, GDT_UInt16, 0, 0) != CE_None) return false;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < width; ++x)
      rgb[static_cast<std::size_t>(y) * row_bytes + 3 * static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(wide[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] >> 8);
  }
  return true;
}

// Numbers of colours become the colours of a table.
void PaintByTable(const GDALColorTable& table, std::uint8_t* rgb, std::size_t pixels) {
  for (std::size_t i = 0; i < pixels; ++i) {
    GDALColorEntry colour{};
    table.GetColorEntryAsRGB(rgb[3 * i], &colour);
    rgb[3 * i] = static_cast<std::uint8_t>(colour.c1), rgb[3 * i + 1] = static_cast<std::uint8_t>(colour.c2), rgb[3 * i + 2] = static_cast<std::uint8_t>(colour.c3);
  }
}

base::Result<Pixels> ReadAll(GDALDataset& set, const Progress& progress) {
  constexpr int kRows = 256;
  Pixels pixels{set.GetRasterXSize(), set.GetRasterYSize(), {}};
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(pixels.width_px);
  pixels.rgb.resize(row_bytes * static_cast<std::size_t>(pixels.height_px));
  const bool coloured = set.GetRasterCount() >= 3;
  const GDALColorTable* table = set.GetRasterBand(1)->GetColorTable();
  for (int first = 0; first < pixels.height_px; first += kRows) {
    const int rows = std::min(kRows, pixels.height_px - first);
    std::uint8_t* into = &pixels.rgb[static_cast<std::size_t>(first) * row_bytes];
    for (int channel = 0; channel < 3; ++channel) {
      if (!ReadRows(*set.GetRasterBand(coloured ? channel + 1 : 1), first, rows, pixels.width_px, into + channel, row_bytes))
        return base::WrongInput(fmt::format("the picture cannot be read beyond line {} of {}", first, pixels.height_px));
    }
    if (table != nullptr && !coloured) PaintByTable(*table, into, static_cast<std::size_t>(rows) * static_cast<std::size_t>(pixels.width_px));
    if (progress && !progress(static_cast<double>(first + rows) / pixels.height_px)) return base::Failed("the picture was not read to its end: somebody stopped that");
  }
  return pixels;
}

base::Result<std::string> ToPng(Pixels& pixels) {
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDriver* png = GetGDALDriverManager()->GetDriverByName("PNG");
  if (memory == nullptr || png == nullptr) return base::Failed("this GDAL cannot write PNG files");
  const Dataset set(memory->Create("", pixels.width_px, pixels.height_px, 3, GDT_Byte, nullptr));
  const GSpacing row = 3 * static_cast<GSpacing>(pixels.width_px);
  bool good = set != nullptr;
  for (int channel = 0; good && channel < 3; ++channel) {
    good = set->GetRasterBand(channel + 1)->RasterIO(GF_Write, 0, 0, pixels.width_px, pixels.height_px, pixels.rgb.data() + channel, pixels.width_px, pixels.height_px, GDT_Byte, 3, row) == CE_None;
  }
  const MemoryFile file;
  if (good) good = Dataset(png->CreateCopy(file.name().c_str(), set.get(), FALSE, nullptr, nullptr, nullptr)) != nullptr;
  vsi_l_offset size = 0;
  const GByte* bytes = good ? VSIGetMemFileBuffer(file.name().c_str(), &size, FALSE) : nullptr;
  if (bytes == nullptr) return base::Failed("the picture cannot be made into a PNG");
  VSIUnlink((file.name() + ".aux.xml").c_str());
  return std::string(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

}  // namespace

base::Result<Pixels> DecodePicture(std::string_view bytes, const Progress& progress) {
  const Quiet quiet;
  const MemoryFile file(bytes);
  auto set = Open(file.name());
  if (!set) return set.error();
  return ReadAll(*set.value(), progress);
}

base::Result<std::string> ImportPicture(const std::filesystem::path& path) {
  auto bytes = base::ReadText(path, map::kMostBytes / 2);
  if (!bytes) return bytes.error();
  auto pixels = DecodePicture(bytes.value());
  if (!pixels) return base::WrongInput(pixels.error().message, path.string());
  if (map::ReadPictureInfo(bytes.value())) return bytes;
  const Quiet quiet;
  auto png = ToPng(pixels.value());
  if (!png) return base::Failed(png.error().message, path.string());
  return png;
}

Pyramid::Pyramid(Pixels pixels) {
  levels_.push_back(std::move(pixels));
  while (std::max(levels_.back().width_px, levels_.back().height_px) > kTile_px) {
    const Pixels& fine = levels_.back();
    Pixels coarse{(fine.width_px + 1) / 2, (fine.height_px + 1) / 2, {}};
    coarse.rgb.resize(3 * static_cast<std::size_t>(coarse.width_px) * static_cast<std::size_t>(coarse.height_px));
    const std::size_t fine_row = 3 * static_cast<std::size_t>(fine.width_px);
    std::uint8_t* out = coarse.rgb.data();
    for (int y = 0; y < coarse.height_px; ++y) {
      const std::uint8_t* upper = &fine.rgb[static_cast<std::size_t>(2 * y) * fine_row];
      const std::uint8_t* lower = 2 * y + 1 < fine.height_px ? upper + fine_row : upper;
      for (int x = 0; x < coarse.width_px; ++x) {
        const std::size_t left = 6 * static_cast<std::size_t>(x), right = 2 * x + 1 < fine.width_px ? left + 3 : left;
        for (std::size_t c = 0; c < 3; ++c) *out++ = static_cast<std::uint8_t>((upper[left + c] + upper[right + c] + lower[left + c] + lower[right + c] + 2) / 4);
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

std::size_t Pyramid::LevelFor(double pixel_px) const {
  std::size_t level = 0;
  while (level + 1 < levels_.size() && pixel_px * static_cast<double>(2u << level) <= 1.0) ++level;
  return level;
}

}  // namespace rodeira::editor
