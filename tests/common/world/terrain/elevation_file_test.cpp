// SPDX-License-Identifier: Apache-2.0
// Elevation files: the crater's published values, our writer read by GDAL, and every way in which a file can be broken.
#include "common/world/terrain/elevation_file.hpp"

#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/terrain/bt.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::terrain {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const fs::path kCrater = fs::path(SourceDir()) / "../shared/data/road/bt/crater_0513.bt";

class ElevationFile : public ::testing::Test {
 protected:
  fs::path Write(const std::string& name, const base::Bytes& bytes) const {
    EXPECT_TRUE(base::WriteWhole(folder_ / name, std::span<const std::byte>(bytes)).ok());
    return folder_ / name;
  }
  static std::string Refusal(const fs::path& path) {
    const auto loaded = LoadElevation(path);
    EXPECT_FALSE(loaded.ok());
    if (loaded.ok()) return {};
    EXPECT_EQ(loaded.error().exit_status(), 2);
    return loaded.error().Text();
  }
  const cli::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path();
};

// A .bt put together field by field from the format's description, with heights 10, 11, 12 … in the file's order.
struct HandMade {
  std::string version = "1.3";
  std::int32_t columns = 3, rows = 2;
  std::int16_t bytes_a_post = 4, floating = 1, units = 1, external = 0;
  double left = 1000.0, right = 1020.0, bottom = 500.0, top = 505.0;
  float scale = 1.0F;

  base::Bytes Make() const {
    base::ByteWriter out;
    const std::string magic = "binterr" + version;
    out.PutRaw(std::as_bytes(std::span(magic)));
    out.Put(columns), out.Put(rows);
    if (version == "1.0") {
      out.Put(std::int32_t{bytes_a_post}), out.Put(units), out.Put(std::int16_t{29});
      for (const double edge : {left, right, bottom, top}) out.Put(static_cast<float>(edge));
      out.Put(floating);
    } else {
      out.Put(bytes_a_post), out.Put(floating), out.Put(units), out.Put(std::int16_t{29}), out.Put(std::int16_t{-2});
      for (const double edge : {left, right, bottom, top}) out.Put(edge);
      out.Put(external), out.Put(scale);
    }
    out.bytes().resize(kBtHeaderBytes);
    for (std::int32_t i = 0; i < columns * rows; ++i) {
      if (bytes_a_post == 2)
        out.Put(static_cast<std::int16_t>(10 + i));
      else if (floating != 0)
        out.Put(static_cast<float>(10 + i));
      else
        out.Put(10 + i);
    }
    return out.bytes();
  }
};

TEST_F(ElevationFile, TheCraterIsWhereItsOracleSays) {
  if (!fs::exists(kCrater)) GTEST_SKIP() << kCrater << " is not on this machine";
  const auto loaded = LoadElevation(kCrater);
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const ElevationGrid& grid = *loaded.value();
  EXPECT_EQ(grid.frame().columns, 513);
  EXPECT_EQ(grid.frame().rows, 513);
  const GridSample sample = grid.At(566300.0, 4754000.0);
  ASSERT_TRUE(sample.inside);
  EXPECT_NEAR(sample.z_m, 2123.4310516, 1e-6);
  EXPECT_NEAR((sample.normal_W() - Eigen::Vector3d(-0.191350, -0.176795, 0.965468)).norm(), 0.0, 1e-6);
  const auto& frame = grid.frame();
  EXPECT_EQ(grid.At(frame.west_m, frame.south_m).z_m, 1647.0);
  EXPECT_EQ(grid.At(frame.east_m, frame.south_m).z_m, 1894.0);
  EXPECT_EQ(grid.At(frame.west_m, frame.north_m).z_m, 1625.0);
  EXPECT_EQ(grid.At(frame.east_m, frame.north_m).z_m, 2054.0);
}

TEST_F(ElevationFile, TheGzippedCraterIsTheSame) {
  const fs::path packed = kCrater.string() + ".gz";
  if (!fs::exists(packed)) GTEST_SKIP() << packed << " is not on this machine";
  const auto plain = LoadElevation(kCrater);
  const auto unpacked = LoadElevation(packed);
  ASSERT_TRUE(plain.ok() && unpacked.ok());
  EXPECT_TRUE(std::ranges::equal(plain.value()->heights_m(), unpacked.value()->heights_m()));
}

TEST_F(ElevationFile, ACutShortCraterIsRefused) {
  if (!fs::exists(kCrater)) GTEST_SKIP() << kCrater << " is not on this machine";
  auto bytes = base::ReadBytes(kCrater);
  ASSERT_TRUE(bytes.ok());
  bytes.value().resize(bytes.value().size() - 1);
  EXPECT_THAT(
      Refusal(Write("short.bt", bytes.value())),
      HasSubstr("short.bt: the file is cut short: 1052931 bytes, and 513 x 513 heights of 4 bytes need 1052932"));
}

TEST_F(ElevationFile, EveryVersionAndKindOfHeightIsRead) {
  for (const char* version : {"1.0", "1.1", "1.2", "1.3"}) {
    for (const auto& [bytes, floating] : {std::pair<std::int16_t, std::int16_t>{2, 0}, {4, 0}, {4, 1}}) {
      HandMade made;
      made.version = version, made.bytes_a_post = bytes, made.floating = floating;
      const auto loaded = LoadElevation(Write("x.bt", made.Make()));
      ASSERT_TRUE(loaded.ok()) << version << ": " << loaded.error().Text();
      const ElevationGrid& grid = *loaded.value();
      EXPECT_DOUBLE_EQ(grid.spacing_x_m(), 10.0);  // posts: 20 m and 3 columns
      EXPECT_DOUBLE_EQ(grid.spacing_y_m(), 5.0);
      EXPECT_EQ(grid.At(1000.0, 500.0).z_m, 10.0) << version;  // south-west
      EXPECT_EQ(grid.At(1000.0, 505.0).z_m, 11.0) << version;  // one north
      EXPECT_EQ(grid.At(1020.0, 505.0).z_m, 15.0) << version;  // north-east
    }
  }
}

TEST_F(ElevationFile, FeetAndTheVerticalScaleBecomeMetres) {
  HandMade made;
  made.units = 2, made.scale = 0.5F, made.bytes_a_post = 2, made.floating = 0;
  const auto loaded = LoadElevation(Write("feet.bt", made.Make()));
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  EXPECT_NEAR(loaded.value()->frame().east_m, 1020.0 * 0.3048, 1e-9);
  EXPECT_EQ(loaded.value()->Post(2, 1), 7.5F);
  made.scale = 0.0F;  // means 1
  EXPECT_EQ(LoadElevation(Write("one.bt", made.Make())).value()->Post(2, 1), 15.0F);
}

TEST_F(ElevationFile, WhatWeWriteGdalReads) {
  const int columns = 5, rows = 4;
  std::vector<float> heights;
  for (std::uint64_t i = 0; i < columns * rows; ++i)
    heights.push_back(static_cast<float>(base::RandomUniform({i}, -100.0, 900.0)));
  const auto wkt = ProjectionWkt("EPSG:3763");
  ASSERT_TRUE(wkt.ok()) << wkt.error().Text();
  const ElevationGrid grid({columns, rows, 40'000.0, 150'000.0, 40'040.0, 150'030.0}, heights, wkt.value());
  ASSERT_TRUE(WriteBt(folder_ / "ours.bt", grid).ok());
  GDALAllRegister();
  const GDALDatasetUniquePtr theirs(GDALDataset::Open((folder_ / "ours.bt").c_str()));
  ASSERT_TRUE(theirs);
  EXPECT_STREQ(theirs->GetDriver()->GetDescription(), "BT");
  std::vector<float> rasters(heights.size());
  ASSERT_EQ(theirs->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, columns, rows, rasters.data(), columns, rows, GDT_Float32,
                                               0, 0, nullptr),
            CE_None);
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row)
      EXPECT_EQ(rasters[(rows - 1 - row) * columns + column], grid.Post(column, row));
  }
  ASSERT_NE(theirs->GetSpatialRef(), nullptr);
  OGRSpatialReference portugal;
  ASSERT_EQ(portugal.importFromEPSG(3763), OGRERR_NONE);
  for (const char* parameter :
       {SRS_PP_CENTRAL_MERIDIAN, SRS_PP_LATITUDE_OF_ORIGIN, SRS_PP_SCALE_FACTOR, SRS_PP_FALSE_EASTING}) {
    EXPECT_NEAR(theirs->GetSpatialRef()->GetNormProjParm(parameter), portugal.GetNormProjParm(parameter), 1e-9)
        << parameter;
  }
  // And so do we, the same grid to the last bit.
  const auto ours = LoadElevation(folder_ / "ours.bt");
  ASSERT_TRUE(ours.ok()) << ours.error().Text();
  EXPECT_EQ(BtBytes(*ours.value()), BtBytes(grid));
  EXPECT_EQ(ours.value()->projection_wkt(), wkt.value());
}

TEST_F(ElevationFile, AnotherRasterStandsInTheMiddlesOfItsPixels) {
  ASSERT_TRUE(base::WriteWhole(folder_ / "small.asc",
                               std::string_view("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 100\ncellsize 10\n"
                                                "NODATA_value -9999\n4 5 6\n1 2 -9999\n"))
                  .ok());
  const auto loaded = LoadElevation(folder_ / "small.asc");
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  EXPECT_EQ(loaded.value()->At(5.0, 105.0).z_m, 1.0);
  EXPECT_EQ(loaded.value()->At(5.0, 115.0).z_m, 4.0);
  EXPECT_FALSE(loaded.value()->At(0.0, 105.0).inside);
  EXPECT_FALSE(loaded.value()->At(24.0, 106.0).inside);  // a void
}

TEST_F(ElevationFile, BrokenFilesAreRefusedWithASentence) {
  EXPECT_THAT(Refusal(folder_ / "none.bt"), Names("none.bt: … no such"));
  EXPECT_THAT(Refusal(folder_), HasSubstr("this is no plain file"));
  EXPECT_THAT(Refusal(Write("empty.bt", {})), HasSubstr("this is no elevation file that can be read"));
  EXPECT_THAT(Refusal(Write("text.bt", base::Bytes(500, std::byte{'x'}))),
              HasSubstr("this is no elevation file that can be read"));
  auto head = HandMade().Make();
  head.resize(100);
  EXPECT_THAT(Refusal(Write("head.bt", head)),
              HasSubstr("the file is cut short: 100 bytes, and a .bt header alone is 256"));
  auto half = HandMade().Make();
  half.resize(half.size() - 3);
  EXPECT_THAT(Refusal(Write("half.bt", half)), Names("half.bt: … 277 bytes … 3 x 2 heights … 280"));
}

TEST_F(ElevationFile, HeadersThatCannotBeAreRefused) {
  const auto refusal = [&](auto&& change) {
    HandMade made;
    change(made);
    return Refusal(Write("broken.bt", made.Make()));
  };
  EXPECT_THAT(refusal([](HandMade& made) { made.version = "1.7"; }), HasSubstr("begins with 'binterr1.7'"));
  EXPECT_THAT(refusal([](HandMade& made) { made.columns = 1; }), HasSubstr("1 columns and 2 rows"));
  EXPECT_THAT(refusal([](HandMade& made) { made.columns = -5; }), HasSubstr("-5 columns"));
  EXPECT_THAT(refusal([](HandMade& made) { made.units = 0; }),
              HasSubstr("the middle of the grid, in degrees, lies at longitude 1010 and latitude 502.5; a place on the "
                        "earth was expected"));
  EXPECT_THAT(refusal([](HandMade& made) {
                made.units = 0, made.left = -10, made.right = 10, made.bottom = 40, made.top = 41;
              }),
              HasSubstr("spans 30 degrees of longitude; at most 12 was expected"));
  EXPECT_THAT(refusal([](HandMade& made) {
                made.units = 0, made.left = -1, made.right = 1, made.bottom = 40, made.top = 40.01;
              }),
              HasSubstr("on the ground: too long and thin for a map in metres"));
  EXPECT_THAT(refusal([](HandMade& made) { made.units = 9; }), HasSubstr("horizontal unit"));
  EXPECT_THAT(refusal([](HandMade& made) { made.bytes_a_post = 2; }), HasSubstr("float heights of 2 bytes"));
  EXPECT_THAT(refusal([](HandMade& made) { made.right = made.left; }), HasSubstr("extents enclose nothing"));
  EXPECT_THAT(refusal([](HandMade& made) { made.top = std::nan(""); }), HasSubstr("extents enclose nothing"));
  EXPECT_THAT(refusal([](HandMade& made) { made.left = 0.0, made.right = 1e-310; }),
              HasSubstr("extents enclose nothing"));
  EXPECT_THAT(refusal([](HandMade& made) { made.scale = -1.0F; }), HasSubstr("vertical scale"));
}

TEST_F(ElevationFile, ProjectionsAreReadFromThePrjAndBrokenOnesRefused) {
  HandMade made;
  made.external = 1;
  const fs::path path = Write("here.bt", made.Make());
  ASSERT_TRUE(base::WriteWhole(folder_ / "here.prj", std::string_view("PROJCS[broken")).ok());
  EXPECT_THAT(Refusal(path), HasSubstr("here.prj: 'PROJCS[broken' is no coordinate system"));
  const auto wkt = ProjectionWkt("EPSG:25829");
  ASSERT_TRUE(wkt.ok());
  ASSERT_TRUE(base::WriteWhole(folder_ / "here.prj", wkt.value()).ok());
  EXPECT_EQ(LoadElevation(path).value()->projection_wkt(), wkt.value());
  ASSERT_TRUE(base::WriteWhole(
                  folder_ / "here.prj",
                  std::string_view("GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137,"
                                   "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"Degree\",0.017453292519943295]]"))
                  .ok());
  EXPECT_THAT(Refusal(path), HasSubstr("the .bt grid is in metres or feet, and its coordinate system in degrees"));
  EXPECT_FALSE(ProjectionWkt("EPSG:nonsense").ok());
}

}  // namespace
}  // namespace rodeira::terrain
