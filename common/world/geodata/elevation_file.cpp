// SPDX-License-Identifier: Apache-2.0
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "common/core/base/nearest_file.hpp"
#include "common/world/geodata/elevation_heights.hpp"
#include "common/world/geodata/elevation_projection.hpp"
#include "common/world/geodata/elevation_warp.hpp"
#include "common/world/geodata/functions.hpp"
#include "common/world/geodata/gdal_quiet.hpp"
#include "common/world/terrain/bt.hpp"

namespace rodeira::terrain::geodata {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxGridPosts = 400'000'000;  // 1.6 GB of heights

// Drivers that are not asked. A file is read, and nothing else: these call a server, log in to a database, or read what
// the file only names, among which are addresses of servers, pieces of programs and places in memory.
constexpr std::string_view kNotAsked[] = {
    "WMS",           "WMTS",      "WCS",        "OGCAPI", "HTTP",         "PLMOSAIC", "EEDA",
    "EEDAI",         "DAAS",      "RDA",        "NGW",    "STACIT",       "STACTA",   "STAC",   // servers
    "PostGISRaster", "GeoRaster", "Rasterlite", "TileDB", "MSSQLSpatial",                       // data bases
    "VRT",           "DERIVED",   "GTI",        "GDALG",  "MEM",          "Memory",   "Zarr"};  // what a file names

// All others of GDAL's that read rasters, in its order.
std::vector<const char*> DriversAsked() {
  std::vector<const char*> names;
  GDALDriverManager* all = GetGDALDriverManager();
  for (int i = 0; i < all->GetDriverCount(); ++i) {
    GDALDriver* driver = all->GetDriver(i);
    const char* name = driver->GetDescription();
    const bool raster = driver->GetMetadataItem(GDAL_DCAP_RASTER) != nullptr;
    if (raster && std::find(std::begin(kNotAsked), std::end(kNotAsked), std::string_view(name)) == std::end(kNotAsked))
      names.push_back(name);
  }
  names.push_back(nullptr);
  return names;
}

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
    return base::WrongInput("file.not_found",
                            fs::exists(path, problem)
                                ? std::string("this is no plain file; an elevation file was expected")
                                : "there is no such elevation file" + base::NearestFile(path),
                            path.string());
  }
  auto head = read(path.string(), 2);
  if (!head) return base::WrongInput("file.cannot_open", "the elevation file cannot be opened", path.string());
  start.gzipped = head->size() == 2 && (*head)[0] == std::byte{0x1f} && (*head)[1] == std::byte{0x8b};
  start.gdal_name = (start.gzipped ? "/vsigzip/" : "") + fs::absolute(path).string();
  head = read(start.gdal_name, kBtHeaderBytes);
  if (!head) return base::WrongInput("file.cannot_read", "the elevation file cannot be unpacked", path.string());
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
      return base::WrongInput("file.cannot_read",
                              fmt::format("the elevation file cannot be read; {}", QuietGdal::Words()), path.string());
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

// The outermost heights, where the outermost edges (of posts the same, of cells half a cell farther out) are known.
ElevationGrid::Frame FrameWithin(int columns, int rows, double west, double south, double east, double north,
                                 bool posts) {
  const double half_x = posts ? 0.0 : 0.5 * (east - west) / columns,
               half_y = posts ? 0.0 : 0.5 * (north - south) / rows;
  return {columns, rows, west + half_x, south + half_y, east - half_x, north - half_y};
}

base::Result<ElevationGrid::Frame> FrameOfBt(const BtHeader& header, GDALDataset& dataset, Registration registration,
                                             const fs::path& path) {
  if (dataset.GetRasterXSize() != header.columns || dataset.GetRasterYSize() != header.rows) {
    return base::WrongInput("terrain.wrong_elevation_file",
                            "GDAL finds another number of heights than the .bt header says", path.string());
  }
  // The header's extents are the outermost posts, unless told otherwise. GDAL always takes them for the edges of cells,
  // so its frame is not used.
  const double unit = header.metres_a_unit;
  return FrameWithin(header.columns, header.rows, header.left * unit, header.bottom * unit, header.right * unit,
                     header.top * unit, registration != Registration::kCells);
}

// Other formats: a height stands for the middle of its pixel, unless told otherwise.
base::Result<ElevationGrid::Frame> FrameOfRaster(GDALDataset& dataset, Registration registration, double unit,
                                                 const fs::path& path) {
  std::array<double, 6> g{};
  if (dataset.GetGeoTransform(g.data()) != CE_None) {
    return base::WrongInput("terrain.wrong_georeference", "the raster does not say where it lies (no georeference)",
                            path.string());
  }
  const int columns = dataset.GetRasterXSize();
  const int rows = dataset.GetRasterYSize();
  if (g[2] != 0.0 || g[4] != 0.0 || !(g[1] > 0.0) || !(g[5] < 0.0)) {
    return base::WrongInput("terrain.wrong_georeference",
                            "the raster is turned or mirrored; north up was expected (gdalwarp turns it)",
                            path.string());
  }
  if (columns < 2 || rows < 2)
    return base::WrongInput("terrain.wrong_georeference", "the raster has fewer than 2 columns or rows", path.string());
  const double west = g[0] * unit, north = g[3] * unit, east = (g[0] + columns * g[1]) * unit,
               south = (g[3] + rows * g[5]) * unit;
  if (!ExtentsHold(west, south, east, north, columns, rows)) {
    return base::WrongInput(
        "terrain.wrong_georeference",
        fmt::format("the raster's edges enclose nothing: x {} to {}, y {} to {}", west, east, south, north),
        path.string());
  }
  return FrameWithin(columns, rows, west, south, east, north, registration == Registration::kPosts);
}

// The header of a .bt with all its heights; nothing where the file is no .bt.
base::Result<std::optional<BtHeader>> CheckedHeader(const FileStart& start, const fs::path& path) {
  if (!LooksLikeBt(start.head)) return std::optional<BtHeader>();
  const auto header = ParseBtHeader(start.head);
  if (!header) return header.error().WithContext(path.string());
  if (start.size < header.value().file_bytes()) {
    return base::WrongInput("terrain.wrong_elevation_file",
                            fmt::format("the file is cut short: {} bytes{}, and {} x {} heights of {} bytes need {}",
                                        start.size, start.gzipped ? " when unpacked" : "", header.value().columns,
                                        header.value().rows, header.value().bytes_a_post, header.value().file_bytes()),
                            path.string());
  }
  return std::optional<BtHeader>(header.value());
}

// A raster in a map with a scale that is off: how, and what the grid then says of its origin.
struct Warping {
  MapScale scale;
  MapOrigin origin;
};

// By the map's scale in the raster's middle; nothing where it holds, or is not known.
std::optional<Warping> OffScale(GDALDataset& dataset, const std::optional<BtHeader>& header,
                                const Projection& projection) {
  std::array<double, 6> g{};
  if (projection.own_wkt.empty() || !projection.geographic_wkt.empty() ||
      (!header && dataset.GetGeoTransform(g.data()) != CE_None))
    return std::nullopt;
  const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
  MapOrigin origin{projection.own_wkt, g[0], g[3] + rows * g[5], g[0] + columns * g[1], g[3]};
  if (header) origin = {projection.own_wkt, header->left, header->bottom, header->right, header->top};
  const auto scale =
      ScaleAt(projection.own_wkt, 0.5 * (origin.west + origin.east), 0.5 * (origin.south + origin.north));
  if (!scale || !IsOffScale(*scale, projection.metres_a_unit)) return std::nullopt;
  origin.units_a_m = 0.5 * (scale->east_units_a_m + scale->north_units_a_m) * projection.metres_a_unit;
  return Warping{*scale, origin};
}

}  // namespace

std::optional<fs::path> FindMissingProjection(const fs::path& path) {
  const QuietGdal quiet;
  const auto start = ReadStart(path);
  if (!start) return std::nullopt;
  const auto header = CheckedHeader(start.value(), path);
  if (!header || !header.value() || !header.value()->external_projection) return std::nullopt;
  const fs::path beside = ProjectionBeside(path, start.value().gzipped);
  std::error_code problem;
  return fs::exists(beside, problem) ? std::nullopt : std::optional(beside);
}

base::Result<LoadedGround> ReadGround(const fs::path& path, Registration registration) {
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
  const std::vector<const char*> others = DriversAsked();
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(
      name.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, header ? bt.data() : others.data()));
  if (!dataset) {
    return base::WrongInput(
        "terrain.unknown_kind",
        fmt::format("this is no elevation file that can be read (.bt, GeoTIFF, Arc/Info ASCII, …); {}",
                    QuietGdal::Words()),
        path.string());
  }
  if (static_cast<std::uint64_t>(dataset->GetRasterXSize()) * static_cast<std::uint64_t>(dataset->GetRasterYSize()) >
      kMaxGridPosts) {
    return base::WrongInput("terrain.too_large", fmt::format("the grid has more than {} heights", kMaxGridPosts),
                            path.string());
  }
  auto projection = ReadProjection(path, start.value().gzipped, *dataset);
  if (!projection) return projection.error();
  GDALDatasetUniquePtr warped;
  if (header && header->metres_a_unit == 0.0 && projection.value().geographic_wkt.empty()) {
    // A zone that its header says beside degrees is none of its own.
    if (header->external_projection && !projection.value().wkt.empty())
      return base::WrongInput("terrain.wrong_georeference",
                              "the .bt grid is in degrees, and its coordinate system in metres", path.string());
    projection.value().geographic_wkt = SRS_WKT_WGS84_LAT_LONG;
  } else if (header && header->metres_a_unit != 0.0 && !projection.value().geographic_wkt.empty()) {
    return base::WrongInput("terrain.wrong_georeference",
                            "the .bt grid is in metres or feet, and its coordinate system in degrees", path.string());
  }
  const std::optional<Warping> off_scale = OffScale(*dataset, header, projection.value());
  std::optional<MapOrigin> origin;
  if (!projection.value().geographic_wkt.empty() || off_scale) {
    if (dataset->GetRasterCount() != 1)
      return base::WrongInput("terrain.wrong_elevation_file", BandsSentence(dataset->GetRasterCount()), path.string());
    auto metric =
        WarpedToMetres(*dataset, off_scale ? projection.value().own_wkt : projection.value().geographic_wkt,
                       off_scale ? std::optional(off_scale->scale) : std::nullopt, header,
                       registration == Registration::kPosts || (header && registration == Registration::kUsual), path);
    if (!metric) return metric.error();
    warped = std::move(metric).value();
    if (off_scale) origin = off_scale->origin;
    projection = MetricProjection(*warped->GetSpatialRef());
    if (!projection) return projection.error();
  }
  GDALDataset& read = warped ? *warped : *dataset;
  const auto frame = header && !warped ? FrameOfBt(*header, *dataset, registration, path)
                                       : FrameOfRaster(read, warped ? Registration::kUsual : registration,
                                                       projection.value().metres_a_unit, path);
  if (!frame) return frame.error();
  auto heights = ReadHeights(read, header, path);
  if (!heights) return heights.error();
  return LoadedGround{std::make_shared<const ElevationGrid>(frame.value(), std::move(heights).value(),
                                                            std::move(projection).value().wkt),
                      std::move(origin)};
}

}  // namespace rodeira::terrain::geodata
