#include "common/terrain/elevation_file.hpp"

#include <cpl_error.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <vector>

#include "common/base/files.hpp"
#include "common/terrain/bt.hpp"

namespace rodeira::terrain {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostPosts = 400'000'000;  // 1.6 GB of heights

// GDAL prints its errors unless told not to; ours carry its words in the sentence.
class QuietGdal {
 public:
  QuietGdal() {
    static std::once_flag once;
    std::call_once(once, [] { GDALAllRegister(); });
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  static std::string Words() {
    const std::string words = CPLGetLastErrorMsg();
    return words.empty() ? "GDAL says no more" : fmt::format("GDAL says '{}'", words.substr(0, 200));
  }
};

struct FileStart {
  std::string gdal_name;
  bool gzipped = false;
  std::vector<std::byte> head;  // the first 256 bytes, unpacked
  std::uint64_t size = 0;       // unpacked
};

base::Result<FileStart> ReadStart(const fs::path& path) {
  FileStart start;
  const auto read = [&](const std::string& name, std::size_t bytes) -> std::optional<std::vector<std::byte>> {
    VSILFILE* file = VSIFOpenL(name.c_str(), "rb");
    if (file == nullptr) return std::nullopt;
    std::vector<std::byte> head(bytes);
    head.resize(VSIFReadL(head.data(), 1, bytes, file));
    VSIFSeekL(file, 0, SEEK_END);
    start.size = VSIFTellL(file);
    VSIFCloseL(file);
    return head;
  };
  std::error_code problem;
  if (!fs::is_regular_file(path, problem)) {
    return base::WrongInput(fs::exists(path, problem) ? "this is no plain file; an elevation file was expected" : "there is no such elevation file",
                            path.string());
  }
  auto head = read(path.string(), 2);
  if (!head) return base::WrongInput("the elevation file cannot be opened", path.string());
  start.gzipped = head->size() == 2 && (*head)[0] == std::byte{0x1f} && (*head)[1] == std::byte{0x8b};
  start.gdal_name = (start.gzipped ? "/vsigzip/" : "") + fs::absolute(path).string();
  head = read(start.gdal_name, kBtHeaderBytes);
  if (!head) return base::WrongInput("the elevation file cannot be unpacked", path.string());
  start.head = std::move(*head);
  return start;
}

// GDAL reads version 1.0 with the field places of the later versions. So that header is written anew, as 1.3, in front
// of the same heights, into a file in memory, which lives as long as this object.
class UpgradedBt {
 public:
  base::Status Make(const FileStart& start, const BtHeader& header, const fs::path& path) {
    GByte* bytes = nullptr;
    vsi_l_offset size = 0;
    if (VSIIngestFile(nullptr, start.gdal_name.c_str(), &bytes, &size, static_cast<GIntBig>(start.size)) == FALSE) {
      return base::WrongInput(fmt::format("the elevation file cannot be read; {}", QuietGdal::Words()), path.string());
    }
    const base::Bytes head = BtHeaderBytes(header);
    std::copy(head.begin(), head.end(), reinterpret_cast<std::byte*>(bytes));
    static std::atomic<int> count{0};
    name_ = fmt::format("/vsimem/rodeira_upgraded_{}.bt", count++);
    VSIFCloseL(VSIFileFromMemBuffer(name_.c_str(), bytes, size, TRUE));
    return {};
  }
  UpgradedBt() = default;
  UpgradedBt(const UpgradedBt&) = delete;
  UpgradedBt& operator=(const UpgradedBt&) = delete;
  ~UpgradedBt() {
    if (!name_.empty()) VSIUnlink(name_.c_str());
  }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
};

base::Result<std::string> Wkt(const OGRSpatialReference& reference) {
  if (reference.IsGeographic() != 0) return base::WrongInput("the coordinate system is in degrees; a projection in metres was expected");
  char* text = nullptr;
  const std::array<const char*, 2> options = {"FORMAT=WKT1_ESRI", nullptr};
  const OGRErr failed = reference.exportToWkt(&text, options.data());
  std::string wkt = text == nullptr ? "" : text;
  CPLFree(text);
  if (failed != OGRERR_NONE || wkt.empty()) return base::WrongInput("the coordinate system cannot be written as WKT");
  return wkt;
}

// The .prj beside the file (trusted before everything else), or what GDAL found in the file, or nothing.
base::Result<std::string> ReadProjection(const fs::path& path, bool gzipped, GDALDataset& dataset) {
  fs::path beside = gzipped ? fs::path(path).replace_extension() : path;
  beside.replace_extension(".prj");
  std::error_code problem;
  if (fs::exists(beside, problem)) {
    const auto text = base::ReadText(beside, 1u << 20);
    if (!text) return text.error();
    auto wkt = ProjectionWkt(text.value());
    if (!wkt) return base::WrongInput(wkt.error().message, beside.string());
    return wkt;
  }
  const OGRSpatialReference* reference = dataset.GetSpatialRef();
  if (reference == nullptr) return std::string();
  auto wkt = Wkt(*reference);
  if (!wkt) return base::WrongInput(wkt.error().message, path.string());
  return wkt;
}

// All heights, columns from west to east, each from south to north; voids as kVoid.
base::Result<std::vector<float>> ReadHeights(GDALDataset& dataset, double vertical_scale, const fs::path& path) {
  const int columns = dataset.GetRasterXSize();
  const int rows = dataset.GetRasterYSize();
  std::vector<float> by_row(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  GDALRasterBand* band = dataset.GetRasterBand(1);
  if (band == nullptr || band->RasterIO(GF_Read, 0, 0, columns, rows, by_row.data(), columns, rows, GDT_Float32, 0, 0, nullptr) != CE_None) {
    return base::WrongInput(fmt::format("the heights cannot be read; {}", QuietGdal::Words()), path.string());
  }
  int has_void = 0;
  const auto no_data = static_cast<float>(band->GetNoDataValue(&has_void));
  std::vector<float> heights(by_row.size());
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const float found = by_row[static_cast<std::size_t>(rows - 1 - row) * columns + column];
      const bool is_void = !std::isfinite(found) || found == ElevationGrid::kVoid || (has_void != 0 && found == no_data);
      const float scaled = vertical_scale == 1.0 ? found : static_cast<float>(static_cast<double>(found) * vertical_scale);
      heights[static_cast<std::size_t>(column) * rows + row] = is_void ? ElevationGrid::kVoid : scaled;
    }
  }
  return heights;
}

base::Result<ElevationGrid::Frame> FrameOfBt(const BtHeader& header, GDALDataset& dataset, const fs::path& path) {
  if (dataset.GetRasterXSize() != header.columns || dataset.GetRasterYSize() != header.rows) {
    return base::WrongInput("GDAL finds another number of heights than the .bt header says", path.string());
  }
  // The header's extents are the outermost posts. GDAL takes them for the edges of cells, so its frame is not used.
  const double unit = header.metres_a_unit;
  return ElevationGrid::Frame{header.columns, header.rows, header.left * unit, header.bottom * unit, header.right * unit, header.top * unit};
}

// Other formats: a height stands for the middle of its pixel.
base::Result<ElevationGrid::Frame> FrameOfRaster(GDALDataset& dataset, const fs::path& path) {
  std::array<double, 6> g{};
  if (dataset.GetGeoTransform(g.data()) != CE_None) {
    return base::WrongInput("the raster does not say where it lies (no georeference)", path.string());
  }
  const int columns = dataset.GetRasterXSize();
  const int rows = dataset.GetRasterYSize();
  if (g[2] != 0.0 || g[4] != 0.0 || !(g[1] > 0.0) || !(g[5] < 0.0)) {
    return base::WrongInput("the raster is turned or mirrored; north up was expected (gdalwarp turns it)", path.string());
  }
  if (columns < 2 || rows < 2) return base::WrongInput("the raster has fewer than 2 columns or rows", path.string());
  const double north = g[3] + 0.5 * g[5];
  const double west = g[0] + 0.5 * g[1];
  return ElevationGrid::Frame{columns, rows, west, north + (rows - 1) * g[5], west + (columns - 1) * g[1], north};
}

}  // namespace

base::Result<std::string> ProjectionWkt(std::string_view definition) {
  const QuietGdal quiet;
  OGRSpatialReference reference;
  const std::string text(definition);
  const bool fine = reference.SetFromUserInput(text.c_str(), OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS) == OGRERR_NONE;
  if (!fine) {
    return base::WrongInput(fmt::format("'{}' is no coordinate system that PROJ knows; an EPSG code or WKT was expected",
                                        text.substr(0, std::min<std::size_t>(60, text.find('\n')))));
  }
  return Wkt(reference);
}

namespace {

// The header of a .bt whose heights are all there; nothing where the file is no .bt.
base::Result<std::optional<BtHeader>> CheckedHeader(const FileStart& start, const fs::path& path) {
  if (!LooksLikeBt(start.head)) return std::optional<BtHeader>();
  const auto header = ParseBtHeader(start.head);
  if (!header) return base::WrongInput(header.error().message, path.string());
  if (start.size < header.value().file_bytes()) {
    return base::WrongInput(fmt::format("the file is cut short: {} bytes{}, and {} x {} heights of {} bytes need {}", start.size,
                                        start.gzipped ? " when unpacked" : "", header.value().columns, header.value().rows,
                                        header.value().bytes_a_post, header.value().file_bytes()),
                            path.string());
  }
  return std::optional<BtHeader>(header.value());
}

}  // namespace

base::Result<std::shared_ptr<const ElevationGrid>> LoadElevation(const fs::path& path) {
  const QuietGdal quiet;
  const auto start = ReadStart(path);
  if (!start) return start.error();
  const auto checked = CheckedHeader(start.value(), path);
  if (!checked) return checked.error();
  const std::optional<BtHeader>& header = checked.value();
  UpgradedBt upgraded;
  if (header && header->version_tenths == 10) {
    if (const auto made = upgraded.Make(start.value(), *header, path); !made) return made.error();
  }
  const std::string& name = upgraded.name().empty() ? start.value().gdal_name : upgraded.name();
  const std::array<const char*, 2> bt = {"BT", nullptr};
  const std::array<const char*, 6> others = {"GTiff", "AAIGrid", "EHdr", "ENVI", "HFA", nullptr};
  const GDALDatasetUniquePtr dataset(
      GDALDataset::Open(name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, header ? bt.data() : others.data()));
  if (!dataset) {
    return base::WrongInput(fmt::format("this is no elevation file that can be read (.bt, GeoTIFF, Arc/Info ASCII, …); {}", QuietGdal::Words()),
                            path.string());
  }
  if (static_cast<std::uint64_t>(dataset->GetRasterXSize()) * static_cast<std::uint64_t>(dataset->GetRasterYSize()) > kMostPosts) {
    return base::WrongInput(fmt::format("the grid has more than {} heights", kMostPosts), path.string());
  }
  const auto frame = header ? FrameOfBt(*header, *dataset, path) : FrameOfRaster(*dataset, path);
  if (!frame) return frame.error();
  auto projection = ReadProjection(path, start.value().gzipped, *dataset);
  if (!projection) return projection.error();
  auto heights = ReadHeights(*dataset, header ? header->vertical_scale : 1.0, path);
  if (!heights) return heights.error();
  return std::make_shared<const ElevationGrid>(frame.value(), std::move(heights).value(), std::move(projection).value());
}

}  // namespace rodeira::terrain
