// SPDX-License-Identifier: Apache-2.0
// Maps and the earth: against worked examples that are published, places that follow from a projection's definition,
// and back.
#include "common/world/terrain/geographic.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/core/base/files.hpp"
#include "common/world/terrain/geodata.hpp"
#include "tests/tree.hpp"

namespace rodeira::terrain {
namespace {

// IOGP, Geomatics Guidance Note 7 part 2: worked examples. The ellipsoids alone are given, so that no change of datum
// comes in.
TEST(Geographic, AgreesWithWorkedExamples) {
  // Transverse Mercator (OSGB 1936 / British National Grid): 50°30'N, 0°30'E is E 577 274.99 m, N 69 740.50 m.
  const auto britain = Geographic::Make(
      "+proj=tmerc +lat_0=49 +lon_0=-2 +k=0.9996012717 +x_0=400000 +y_0=-100000 +a=6377563.396 +rf=299.32496 +units=m");
  ASSERT_TRUE(britain.ok()) << britain.error().Text();
  const auto down = britain.value().ToEarth(577274.99, 69740.50);
  ASSERT_TRUE(down.has_value());
  EXPECT_NEAR(down->longitude_deg, 0.5, 2e-7);  // the example's centimetre
  EXPECT_NEAR(down->latitude_deg, 50.5, 2e-7);
  const auto map = britain.value().ToMap({0.5, 50.5});
  ASSERT_TRUE(map.has_value());
  EXPECT_NEAR(map->x(), 577274.99, 0.01);
  EXPECT_NEAR(map->y(), 69740.50, 0.01);
  // Lambert conic conformal with two parallels (NAD27 / Texas South Central): 28°30'N, 96°W is E 2 963 503.91, N 254
  // 759.80 US survey feet.
  const auto texas = Geographic::Make(
      "+proj=lcc +lat_1=28.38333333333333 +lat_2=30.28333333333333 +lat_0=27.83333333333333 +lon_0=-99 "
      "+x_0=609601.2192024384 +y_0=0 "
      "+a=6378206.4 +rf=294.97870 +units=m");
  ASSERT_TRUE(texas.ok()) << texas.error().Text();
  constexpr double kFoot_m = 1200.0 / 3937.0;
  const auto gulf = texas.value().ToMap({-96.0, 28.5});
  ASSERT_TRUE(gulf.has_value());
  EXPECT_NEAR(gulf->x() / kFoot_m, 2963503.91, 0.01);
  EXPECT_NEAR(gulf->y() / kFoot_m, 254759.80, 0.01);
}

// UTM: 500 000 m is the zone's middle meridian; along it a metre of the map is 1 / 0.9996 of the earth's, and the arc
// of the meridian from 0 to 1 degree follows from the ellipsoid by its series (110 574.389 m).
TEST(Geographic, UtmHasItsMeridian) {
  const auto utm = Geographic::Make("+proj=utm +zone=29 +datum=WGS84 +units=m +no_defs");
  ASSERT_TRUE(utm.ok()) << utm.error().Text();
  for (const double y : {0.0, 1'000'000.0, 4'553'000.0})
    EXPECT_NEAR(utm.value().ToEarth(500'000.0, y)->longitude_deg, -9.0, 1e-12);
  constexpr double kA_m = 6378137.0, kF = 1.0 / 298.257223563, kN = kF / (2.0 - kF),
                   kDegree = 3.14159265358979323846 / 180.0;
  const double arc =
      kA_m / (1.0 + kN) *
      ((1.0 + kN * kN / 4.0) * kDegree - 1.5 * (kN - kN * kN * kN / 8.0) * std::sin(2.0 * kDegree) +
       15.0 / 16.0 * kN * kN * std::sin(4.0 * kDegree) - 35.0 / 48.0 * kN * kN * kN * std::sin(6.0 * kDegree));
  EXPECT_NEAR(utm.value().ToEarth(500'000.0, 0.9996 * arc)->latitude_deg, 1.0, 1e-9);
  EXPECT_NEAR(utm.value().ToMap({-9.0, 1.0})->y(), 0.9996 * arc, 1e-3);
}

TEST(Geographic, TheWayBackIsTheSamePlace) {
  for (const char* definition :
       {"+proj=utm +zone=29 +ellps=GRS80 +units=m", "EPSG:25829", "+proj=tmerc +lat_0=49 +lon_0=8 +datum=WGS84"}) {
    const auto map = Geographic::Make(definition);
    ASSERT_TRUE(map.ok()) << map.error().Text();
    for (const double x : {300'000.0, 512'345.678, 700'000.0}) {
      const auto place = map.value().ToEarth(x, 4'553'210.5);
      ASSERT_TRUE(place.has_value()) << definition;
      const auto back = map.value().ToMap(*place);
      ASSERT_TRUE(back.has_value());
      EXPECT_NEAR(back->x(), x, 1e-6) << definition;
      EXPECT_NEAR(back->y(), 4'553'210.5, 1e-6) << definition;
    }
  }
}

TEST(Geographic, WhatIsNoProjectionIsASentence) {
  EXPECT_NE(Geographic::Make("+lat_0=49 +lon_0=8").error().Text().find("is no coordinate system that PROJ knows"),
            std::string::npos);
  EXPECT_NE(Geographic::Make("").error().Text().find("is no coordinate system"), std::string::npos);
  const auto degrees = Geographic::Make("EPSG:4326");
  ASSERT_FALSE(degrees.ok());
  EXPECT_NE(degrees.error().Text().find("'EPSG:4326' is no projection"), std::string::npos) << degrees.error().Text();
  const auto utm = Geographic::Make("+proj=utm +zone=29 +datum=WGS84");
  EXPECT_FALSE(utm.value().ToEarth(std::nan(""), 0.0).has_value());
}

TEST(Geodata, AMissingOrForeignSharedObjectIsASentence) {
  const auto missing = LoadGeodata(GeodataPlaces("/nowhere"));
  if (!std::filesystem::exists("/usr/libexec/rodeira/rodeira-geodata.so")) {
    ASSERT_FALSE(missing.ok());
    EXPECT_EQ(missing.error().id.text(), "terrain.no_geodata");
    EXPECT_THAT(missing.error().Text(), testing::HasSubstr("looked for /nowhere/rodeira-geodata.so"));
  }
  const auto text = LoadGeodata({std::filesystem::path(SourceDir()) / "README.md"});
  ASSERT_FALSE(text.ok());
  EXPECT_EQ(text.error().id.text(), "file.not_loadable");
}

TEST(Geodata, ACutSharedObjectIsASentence) {
  const std::string whole = base::ReadText(BinaryDir() + "/bin/rodeira-geodata.so", 1u << 30).value();
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("rodeira-geodata-{}", ::getpid());
  std::filesystem::create_directories(folder);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{50}, std::size_t{100}, std::size_t{5000}, whole.size() / 4, whole.size() / 2}) {
    const auto file = folder / fmt::format("{}.so", size);
    std::ofstream(file, std::ios::binary) << whole.substr(0, size);
    const auto cut = LoadGeodata({file});
    ASSERT_FALSE(cut.ok()) << size;
    EXPECT_EQ(cut.error().id.text(), "file.not_loadable") << size;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rodeira::terrain
