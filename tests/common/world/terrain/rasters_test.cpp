// SPDX-License-Identifier: Apache-2.0
// Elevation files that GDAL's own drivers wrote, in every format that both can: the same heights at the same places.
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/base/bytes.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/terrain/elevation_file.hpp"
#include "common/world/terrain/geographic.hpp"
#include "common/world/terrain/ground_move.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"

namespace rodeira::terrain {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr int kColumns = 7, kRows = 5;
constexpr double kWest = 500'000.0, kNorth = 4'700'000.0, kCell = 10.0;

// Whole centimetres, so that formats of text say them exactly.
float Height(int column, int row_from_north) {
  return static_cast<float>(
             std::round(base::RandomUniform({std::uint64_t(column), std::uint64_t(row_from_north)}, 0.0, 90'000.0))) /
         100.0F;
}

class Rasters : public ::testing::Test {
 protected:
  void SetUp() override {
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
  }
  void TearDown() override { CPLPopErrorHandler(); }

  // A raster in memory, written by a driver; false where the driver cannot.
  bool Write(const char* driver_name, const fs::path& path, const std::function<void(GDALDataset&)>& change = {},
             int bands = 1) const {
    GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(driver_name);
    if (driver == nullptr) return false;
    const GDALDatasetUniquePtr made(memory->Create("", kColumns, kRows, bands, GDT_Float32, nullptr));
    std::array<double, 6> transform = {kWest, kCell, 0.0, kNorth, 0.0, -kCell};
    made->SetGeoTransform(transform.data());
    OGRSpatialReference utm;
    utm.SetProjCS("somewhere");
    utm.SetWellKnownGeogCS("WGS84");
    utm.SetUTM(29, TRUE);
    made->SetSpatialRef(&utm);
    std::vector<float> heights;
    for (int row = 0; row < kRows; ++row) {
      for (int column = 0; column < kColumns; ++column) heights.push_back(Height(column, row));
    }
    for (int band = 1; band <= bands; ++band) {
      if (made->GetRasterBand(band)->RasterIO(GF_Write, 0, 0, kColumns, kRows, heights.data(), kColumns, kRows,
                                              GDT_Float32, 0, 0, nullptr) != CE_None)
        return false;
    }
    if (change) change(*made);
    const GDALDatasetUniquePtr copy(driver->CreateCopy(path.c_str(), made.get(), FALSE, nullptr, nullptr, nullptr));
    return copy != nullptr;
  }
  std::string Refusal(const fs::path& path) const {
    const auto loaded = LoadElevation(path);
    EXPECT_FALSE(loaded.ok());
    return loaded.ok() ? "" : loaded.error().Text();
  }

  const cli::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

TEST_F(Rasters, EveryFormatGivesTheSameHeightsAtTheSamePlaces) {
  const std::pair<const char*, const char*> formats[] = {
      {"GTiff", "tif"}, {"AAIGrid", "asc"}, {"EHdr", "flt"},  {"ENVI", "img"}, {"HFA", "img"},     {"SAGA", "sdat"},
      {"GSAG", "grd"},  {"GSBG", "grd"},    {"GS7BG", "grd"}, {"RST", "rst"},  {"RRASTER", "grd"}, {"XYZ", "xyz"}};
  int read = 0;
  for (const auto& [driver, extension] : formats) {
    const fs::path path = folder_ / driver / (std::string("heights.") + extension);
    fs::create_directories(path.parent_path());
    if (!Write(driver, path)) continue;  // GDAL was built without it
    const auto loaded = LoadElevation(path);
    ASSERT_TRUE(loaded.ok()) << driver << ": " << loaded.error().Text();
    ++read;
    const ElevationGrid& grid = *loaded.value();
    ASSERT_EQ(grid.frame().columns, kColumns) << driver;
    ASSERT_EQ(grid.frame().rows, kRows) << driver;
    EXPECT_NEAR(grid.frame().west_m, kWest + 5.0, 1e-6) << driver;
    EXPECT_NEAR(grid.frame().north_m, kNorth - 5.0, 1e-6) << driver;
    EXPECT_NEAR(grid.spacing_x_m(), kCell, 1e-9) << driver;
    EXPECT_NEAR(grid.spacing_y_m(), kCell, 1e-9) << driver;
    for (int column = 0; column < kColumns; ++column) {
      for (int row = 0; row < kRows; ++row)
        EXPECT_NEAR(grid.Post(column, kRows - 1 - row), Height(column, row), 1e-4F) << driver;
    }
  }
  EXPECT_GE(read, 8) << "this GDAL knows few formats";
}

TEST_F(Rasters, RegistrationIsWhatIsSaid) {
  ASSERT_TRUE(Write("GTiff", folder_ / "a.tif"));
  const auto posts = LoadElevation(folder_ / "a.tif", Registration::kPosts);
  ASSERT_TRUE(posts.ok());
  EXPECT_EQ(posts.value()->frame().west_m, kWest);
  EXPECT_NEAR(posts.value()->spacing_x_m(), 70.0 / 6.0, 1e-12);
  const auto cells = LoadElevation(folder_ / "a.tif", Registration::kCells);
  EXPECT_EQ(cells.value()->frame().west_m, kWest + 5.0);
  // A .bt by GDAL says the edges of its cells, though a .bt's extents are posts: the caller says so.
  ASSERT_TRUE(Write("BT", folder_ / "a.bt"));
  EXPECT_EQ(LoadElevation(folder_ / "a.bt").value()->frame().west_m, kWest);
  const auto bt = LoadElevation(folder_ / "a.bt", Registration::kCells);
  ASSERT_TRUE(bt.ok());
  EXPECT_EQ(bt.value()->frame().west_m, kWest + 5.0);
  EXPECT_EQ(bt.value()->frame().north_m, kNorth - 5.0);
  EXPECT_EQ(bt.value()->Post(2, 3), Height(2, 1));
}

TEST_F(Rasters, FeetBecomeMetresInPlanInHeightAndInTheProjection) {
  const bool written = Write("GTiff", folder_ / "feet.tif", [](GDALDataset& made) {
    OGRSpatialReference california;
    ASSERT_EQ(california.importFromEPSG(2225), OGRERR_NONE);  // US survey feet
    made.SetSpatialRef(&california);
    made.GetRasterBand(1)->SetUnitType("ft");
    made.GetRasterBand(1)->SetScale(0.5);
    made.GetRasterBand(1)->SetOffset(100.0);
  });
  ASSERT_TRUE(written);
  const auto loaded = LoadElevation(folder_ / "feet.tif");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const ElevationGrid& grid = *loaded.value();
  const double foot = 1200.0 / 3937.0;
  EXPECT_NEAR(grid.frame().west_m, (kWest + 5.0) * foot, 1e-6);
  EXPECT_NEAR(grid.frame().north_m, (kNorth - 5.0) * foot, 1e-6);
  EXPECT_NEAR(grid.Post(0, kRows - 1), (100.0 + 0.5 * static_cast<double>(Height(0, 0))) * 0.3048, 1e-4);
  OGRSpatialReference metric;
  ASSERT_EQ(metric.importFromWkt(grid.projection_wkt().c_str()), OGRERR_NONE);
  EXPECT_EQ(metric.GetLinearUnits(), 1.0);
  // The same place on Earth by both: a false easting of 6561666.667 ft is one of 2000000 m.
  EXPECT_NEAR(metric.GetNormProjParm(SRS_PP_FALSE_EASTING), 2'000'000.0, 1e-3);
}

// Heights that are linear in the map's metres, said at places in degrees: PROJ is asked for these places apart from
// GDAL's warper. What bilinear interpolation leaves out over a cell of 90 m is less than a millimetre. 42.5 degrees
// north and 8 west lie in zone 29.
double Linear(const Eigen::Vector2d& p) { return 100.0 + 0.02 * (p.x() - 582'000.0) - 0.01 * (p.y() - 4'705'000.0); }

void ExpectLinear(const ElevationGrid& grid, const Eigen::Vector2d& low_deg, const Eigen::Vector2d& high_deg) {
  const auto map = Geographic::Make("EPSG:32629");
  ASSERT_TRUE(map.ok());
  EXPECT_NE(grid.projection_wkt().find("UTM_Zone_29N"), std::string::npos) << grid.projection_wkt();
  int count = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const auto place = map.value().ToMap({base::RandomUniform({i, 1}, low_deg.x(), high_deg.x()),
                                          base::RandomUniform({i, 2}, low_deg.y(), high_deg.y())});
    ASSERT_TRUE(place.has_value());
    const auto at = grid.At(place->x(), place->y());
    if (!at.inside) continue;
    ++count;
    EXPECT_NEAR(at.z_m, Linear(*place), 2e-3) << place->transpose();
  }
  EXPECT_GT(count, 490);
  EXPECT_FALSE(grid.At(grid.frame().west_m + 1e-3, grid.frame().north_m - 1e-3).inside)
      << "the corner of the turned square is no ground";
}

TEST_F(Rasters, DegreesComeIntoTheirUtmZone) {
  constexpr int kMany = 60;
  constexpr double kWest_deg = -8.05, kNorth_deg = 42.55, kCell_deg = 0.001;
  const auto map = Geographic::Make("EPSG:32629");
  ASSERT_TRUE(map.ok());
  OGRSpatialReference degrees;
  degrees.SetWellKnownGeogCS("WGS84");
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  const GDALDatasetUniquePtr made(memory->Create("", kMany, kMany, 1, GDT_Float32, nullptr));
  std::array<double, 6> transform = {kWest_deg, kCell_deg, 0.0, kNorth_deg, 0.0, -kCell_deg};
  made->SetGeoTransform(transform.data());
  made->SetSpatialRef(&degrees);
  // In half metres over 50 m, which a scale and an offset say.
  made->GetRasterBand(1)->SetScale(0.5);
  made->GetRasterBand(1)->SetOffset(50.0);
  std::vector<float> heights;
  for (int row = 0; row < kMany; ++row) {
    for (int column = 0; column < kMany; ++column) {
      const auto place =
          map.value().ToMap({kWest_deg + (column + 0.5) * kCell_deg, kNorth_deg - (row + 0.5) * kCell_deg});
      ASSERT_TRUE(place.has_value());
      heights.push_back(static_cast<float>((Linear(*place) - 50.0) / 0.5));
    }
  }
  ASSERT_EQ(made->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, kMany, kMany, heights.data(), kMany, kMany, GDT_Float32, 0,
                                             0, nullptr),
            CE_None);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  {
    const GDALDatasetUniquePtr copy(
        driver->CreateCopy((folder_ / "d.tif").c_str(), made.get(), FALSE, nullptr, nullptr, nullptr));
  }
  const auto loaded = LoadElevation(folder_ / "d.tif");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const double last = (kMany - 2.0) * kCell_deg;
  ExpectLinear(*loaded.value(), {kWest_deg + 2.0 * kCell_deg, kNorth_deg - last},
               {kWest_deg + last, kNorth_deg - 2.0 * kCell_deg});
  // A .prj beside a file that says nothing itself.
  made->SetSpatialRef(nullptr);
  {
    const GDALDatasetUniquePtr copy(
        driver->CreateCopy((folder_ / "p.tif").c_str(), made.get(), FALSE, nullptr, nullptr, nullptr));
  }
  ASSERT_TRUE(base::WriteWhole(
                  folder_ / "p.prj",
                  std::string_view("GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137,298."
                                   "257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"Degree\",0.017453292519943295]]"))
                  .ok());
  const auto beside = LoadElevation(folder_ / "p.tif");
  ASSERT_TRUE(beside.ok()) << beside.error().Text();
  ExpectLinear(*beside.value(), {kWest_deg + 2.0 * kCell_deg, kNorth_deg - last},
               {kWest_deg + last, kNorth_deg - 2.0 * kCell_deg});
}

// A square of 60 x 60 heights that are linear in zone 29, in another map; the places come from PROJ alone.
GDALDatasetUniquePtr LinearIn(const char* definition, const Eigen::Vector2d& middle_deg, double cell) {
  constexpr int kMany = 60;
  const auto own = Geographic::Make(definition), zone = Geographic::Make("EPSG:32629");
  const Eigen::Vector2d middle = *own.value().ToMap({middle_deg.x(), middle_deg.y()});
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDatasetUniquePtr made(memory->Create("", kMany, kMany, 1, GDT_Float32, nullptr));
  std::array<double, 6> transform = {middle.x() - 30.0 * cell, cell, 0.0, middle.y() + 30.0 * cell, 0.0, -cell};
  made->SetGeoTransform(transform.data());
  OGRSpatialReference reference;
  EXPECT_EQ(reference.SetFromUserInput(definition), OGRERR_NONE);
  made->SetSpatialRef(&reference);
  std::vector<float> heights;
  for (int row = 0; row < kMany; ++row) {
    for (int column = 0; column < kMany; ++column) {
      const auto place = own.value().ToEarth(transform[0] + (column + 0.5) * cell, transform[3] - (row + 0.5) * cell);
      heights.push_back(static_cast<float>(Linear(*zone.value().ToMap(*place))));
    }
  }
  EXPECT_EQ(made->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, kMany, kMany, heights.data(), kMany, kMany, GDT_Float32, 0,
                                             0, nullptr),
            CE_None);
  return made;
}

LoadedGround Saved(const GDALDatasetUniquePtr& made, const fs::path& path) {
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDatasetUniquePtr(driver->CreateCopy(path.c_str(), made.get(), FALSE, nullptr, nullptr, nullptr)).reset();
  const auto loaded = LoadGround(path);
  EXPECT_TRUE(loaded.ok()) << loaded.error().Text();
  return loaded.ok() ? loaded.value() : LoadedGround{};
}

// Web Mercator shows a metre at 42.5 degrees north as 1 / cos(42.5 degrees) = 1.3563 m, on WGS 84's ellipsoid by up to
// 0.4 % more or less; the map of EPSG:3395 shows it likewise.
TEST_F(Rasters, MapsWhoseScaleIsOffComeIntoTheirUtmZone) {
  for (const auto& [definition, unit] :
       {std::pair("EPSG:3857", 1.0), std::pair("EPSG:3395", 1.0),
        std::pair("+proj=merc +datum=WGS84 +units=us-ft +type=crs", 1200.0 / 3937.0)}) {
    const Eigen::Vector2d middle(-8.02, 42.52);
    const auto [grid, origin] = Saved(LinearIn(definition, middle, 100.0 / unit), folder_ / "mercator.tif");
    ASSERT_NE(grid, nullptr);
    ExpectLinear(*grid, middle - Eigen::Vector2d(0.02, 0.015), middle + Eigen::Vector2d(0.02, 0.015));
    ASSERT_TRUE(origin.has_value()) << definition;
    EXPECT_NEAR(origin->units_a_m, 1.3567, 0.004) << definition;
    EXPECT_NEAR(grid->spacing_x_m(), 100.0 / 1.3567, 0.3) << definition;
    // A place among the heights moves with them, with its heading; another one is a place of the world already.
    const auto own = Geographic::Make(definition), zone = Geographic::Make("EPSG:32629");
    const GroundMove move = MoveWith(*origin, grid->projection_wkt());
    ASSERT_TRUE(static_cast<bool>(move));
    Eigen::Vector2d p = *own.value().ToMap({-8.01, 42.51});
    double heading_rad = 0.5;
    const Eigen::Vector2d step = Eigen::Vector2d(std::cos(0.5), std::sin(0.5)) / unit;
    const Eigen::Vector2d before = *zone.value().ToMap({-8.01, 42.51}),
                          ahead = *zone.value().ToMap(*own.value().ToEarth(p.x() + step.x(), p.y() + step.y()));
    move(p, heading_rad);
    EXPECT_NEAR((p - before).norm(), 0.0, 1e-4) << definition;
    EXPECT_NEAR(heading_rad, std::atan2((ahead - before).y(), (ahead - before).x()), 1e-5) << definition;
    move(p, heading_rad);
    EXPECT_NEAR((p - before).norm(), 0.0, 1e-4) << definition;
  }
}

// The scale of UTM is 0.9996 in a zone's middle and 1.0010 at its border; EPSG:3763's is 1.0000 in its middle.
TEST_F(Rasters, MapsWhoseScaleHoldsStayWhatTheyAre) {
  for (const char* definition : {"EPSG:32629", "EPSG:32630", "EPSG:3763"}) {
    const auto [grid, origin] = Saved(LinearIn(definition, {-6.1, 42.5}, 30.0), folder_ / "utm.tif");
    ASSERT_NE(grid, nullptr);
    EXPECT_FALSE(origin.has_value()) << definition;
    EXPECT_NEAR(grid->spacing_x_m(), 30.0, 1e-6) << definition;
  }
}

// A .bt in degrees (unit 0): its outermost heights stand on its edges; the zone that it says too, another one, means
// nothing.
TEST_F(Rasters, ABtInDegreesComesIntoItsUtmZone) {
  constexpr int kMany = 50;
  constexpr double kWest_deg = -8.05, kSouth_deg = 42.48, kSpan_deg = 0.049;
  const auto map = Geographic::Make("EPSG:32629");
  base::ByteWriter out;
  out.PutRaw(std::as_bytes(std::span("binterr1.3", 10)));
  out.Put(std::int32_t{kMany}), out.Put(std::int32_t{kMany}), out.Put(std::int16_t{4}), out.Put(std::int16_t{1}),
      out.Put(std::int16_t{0}), out.Put(std::int16_t{31}), out.Put(std::int16_t{6326});
  for (const double edge : {kWest_deg, kWest_deg + kSpan_deg, kSouth_deg, kSouth_deg + kSpan_deg}) out.Put(edge);
  out.Put(std::int16_t{0}), out.Put(2.0F);  // two metres a unit of height
  out.bytes().resize(256);
  for (int column = 0; column < kMany; ++column) {
    for (int row = 0; row < kMany; ++row) {
      const auto place =
          map.value().ToMap({kWest_deg + kSpan_deg * column / (kMany - 1), kSouth_deg + kSpan_deg * row / (kMany - 1)});
      out.Put(static_cast<float>(0.5 * Linear(*place)));
    }
  }
  ASSERT_TRUE(base::WriteWhole(folder_ / "d.bt", std::span<const std::byte>(out.bytes())).ok());
  const auto loaded = LoadElevation(folder_ / "d.bt");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  ExpectLinear(*loaded.value(), {kWest_deg + 0.002, kSouth_deg + 0.002},
               {kWest_deg + kSpan_deg - 0.002, kSouth_deg + kSpan_deg - 0.002});
}

// Unforeseen formats are read too; what only names other files, or servers, is not.
TEST_F(Rasters, WhateverGdalReadsFromAFileIsRead) {
  ASSERT_TRUE(Write("PCIDSK", folder_ / "a.pix"));
  const auto loaded = LoadElevation(folder_ / "a.pix");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  EXPECT_NEAR(loaded.value()->Post(2, kRows - 1 - 1), Height(2, 1), 1e-4F);
  ASSERT_TRUE(Write("GTiff", folder_ / "a.tif"));
  ASSERT_TRUE(Write("VRT", folder_ / "a.vrt"));
  EXPECT_THAT(Refusal(folder_ / "a.vrt"), HasSubstr("a.vrt: this is no elevation file that can be read"));
  ASSERT_TRUE(base::WriteWhole(
                  folder_ / "a.xml",
                  std::string_view(
                      "<GDAL_WMS><Service "
                      "name=\"TMS\"><ServerUrl>http://127.0.0.1:9/${z}/${x}/${y}.png</ServerUrl></Service></GDAL_WMS>"))
                  .ok());
  EXPECT_THAT(Refusal(folder_ / "a.xml"), HasSubstr("a.xml: this is no elevation file that can be read"));
}

TEST_F(Rasters, WhatIsNoGridOfHeightsIsRefused) {
  ASSERT_TRUE(Write("GTiff", folder_ / "bands.tif", {}, 3));
  EXPECT_THAT(Refusal(folder_ / "bands.tif"), HasSubstr("the raster has 3 bands; one, the heights, was expected"));
  ASSERT_TRUE(Write("GTiff", folder_ / "degrees.tif", [](GDALDataset& made) {
    OGRSpatialReference degrees;
    degrees.SetWellKnownGeogCS("WGS84");
    made.SetSpatialRef(&degrees);
  }));
  EXPECT_THAT(Refusal(folder_ / "degrees.tif"),
              Names("degrees.tif: … in degrees … longitude 500035 … latitude 4699975"));
  ASSERT_TRUE(
      Write("GTiff", folder_ / "hours.tif", [](GDALDataset& made) { made.GetRasterBand(1)->SetUnitType("hours"); }));
  EXPECT_THAT(Refusal(folder_ / "hours.tif"), HasSubstr("the heights are in 'hours'; metres or feet were expected"));
  ASSERT_TRUE(Write("GTiff", folder_ / "turned.tif", [](GDALDataset& made) {
    std::array<double, 6> turned = {kWest, kCell, 1.0, kNorth, 1.0, -kCell};
    made.SetGeoTransform(turned.data());
  }));
  EXPECT_THAT(Refusal(folder_ / "turned.tif"), HasSubstr("the raster is turned or mirrored"));
}

TEST_F(Rasters, VoidsStayVoidsInEveryFormat) {
  for (const auto& [driver, name] :
       {std::pair("GTiff", "v.tif"), std::pair("AAIGrid", "v.asc"), std::pair("HFA", "v.img")}) {
    ASSERT_TRUE(Write(driver, folder_ / name, [](GDALDataset& made) {
      made.GetRasterBand(1)->SetNoDataValue(-9999.0);
      float void_height = -9999.0F;
      ASSERT_EQ(made.GetRasterBand(1)->RasterIO(GF_Write, 3, 2, 1, 1, &void_height, 1, 1, GDT_Float32, 0, 0, nullptr),
                CE_None);
    }));
    const auto loaded = LoadElevation(folder_ / name);
    ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
    EXPECT_EQ(loaded.value()->Post(3, 2), ElevationGrid::kVoid) << driver;
    EXPECT_EQ(loaded.value()->Post(3, 3), Height(3, 1)) << driver;
    EXPECT_FALSE(loaded.value()->At(kWest + 35.0, kNorth - 25.0).inside) << driver;
  }
}

TEST_F(Rasters, AnInternalUtmZoneOfABtIsItsProjection) {
  ASSERT_TRUE(Write("BT", folder_ / "zone.bt"));
  fs::remove(folder_ / "zone.prj");
  const auto loaded = LoadElevation(folder_ / "zone.bt");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  EXPECT_THAT(loaded.value()->projection_wkt(), HasSubstr("Transverse_Mercator"));
  OGRSpatialReference utm;
  ASSERT_EQ(utm.importFromWkt(loaded.value()->projection_wkt().c_str()), OGRERR_NONE);
  EXPECT_NEAR(utm.GetNormProjParm(SRS_PP_CENTRAL_MERIDIAN), -9.0, 1e-9);  // zone 29
}

}  // namespace
}  // namespace rodeira::terrain
