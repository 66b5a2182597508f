// SPDX-License-Identifier: Apache-2.0
// The oracle is GDAL's own text of the same definition.
#include "common/world/terrain/plain_projection.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "common/world/terrain/geodata.hpp"

namespace rodeira::terrain {
namespace {

void IsGdalsText(const std::string& definition) {
  const auto plain = PlainProjectionWkt(definition);
  ASSERT_TRUE(plain.has_value()) << definition;
  const auto of_gdal = SharedGeodata().value()->ProjectionWkt(definition);
  ASSERT_TRUE(of_gdal.ok()) << definition;
  EXPECT_EQ(*plain, of_gdal.value()) << definition;
}

TEST(PlainProjection, TheWorldsOfTheProjectNeedNoLibrary) {
  IsGdalsText("+proj=tmerc +lat_0=41.16 +lon_0=-7.66 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m");
  IsGdalsText("+proj=tmerc +lat_0=41.3 +lon_0=-8.1 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m");
  IsGdalsText("+proj=utm +zone=29 +ellps=GRS80 +units=m");
  IsGdalsText("+ellps=WGS84 +units=m +zone=1 +proj=utm");
}

TEST(PlainProjection, DrawnDefinitionsHaveTheTextThatGdalWrites) {
  for (std::uint32_t i = 0; i < 100; ++i) {
    const auto drawn = [&](std::uint32_t purpose, double most) {
      const auto digits = static_cast<int>(base::RandomUniform({11, i, purpose, 1}, 0.0, 6.0));
      return fmt::format("{:.{}f}", base::RandomUniform({11, i, purpose}, 0.01 * most, most), digits);
    };
    const bool west = i % 2 == 0, south = i % 3 == 0;
    IsGdalsText(fmt::format("+proj=tmerc +lat_0={}{} +lon_0={}{} +k={} +x_0={} +y_0=-{} +ellps={} +units=m",
                            south ? "-" : "", drawn(1, 89.0), west ? "-" : "", drawn(2, 179.0),
                            fmt::format("{:.6f}", base::RandomUniform({11, i, 3}, 0.9, 1.1)), drawn(4, 50'000.0),
                            drawn(5, 90'000.0), i % 5 == 0 ? "WGS84" : "GRS80"));
  }
}

TEST(PlainProjection, AllElseIsLeftToTheLibrary) {
  for (const char* definition :
       {"", "EPSG:3763", "+proj=utm +zone=61 +ellps=GRS80 +units=m", "+proj=utm +zone=0 +ellps=GRS80 +units=m",
        "+proj=utm +zone=29.5 +ellps=GRS80 +units=m", "+proj=utm +zone=29 +south +ellps=GRS80 +units=m",
        "+proj=utm +zone=29 +ellps=GRS80", "+proj=utm +zone=29 +zone=30 +ellps=GRS80 +units=m",
        "+proj=utm +zone=29 +ellps=intl +units=m", "+proj=utm +zone=29 +ellps=GRS80 +units=ft",
        "+proj=tmerc +lat_0=91 +lon_0=0 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m",
        "+proj=tmerc +lat_0=1e1 +lon_0=0 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m",
        "+proj=tmerc +lat_0=-0 +lon_0=0 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m",
        "+proj=tmerc +lat_0=4 +lon_0=0 +k=0 +x_0=0 +y_0=0 +ellps=GRS80 +units=m",
        "+proj=tmerc +lat_0=4 +lon_0=0 +k=1 +x_0=0.00001 +y_0=0 +ellps=GRS80 +units=m",
        "+proj=tmerc +lat_0=4 +lon_0= +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m",
        "+proj=tmerc +lat_0=4 +lon_0=0 +k=1 +x_0=0 +y_0=0 +ellps=GRS80 +units=m +no_defs"})
    EXPECT_FALSE(PlainProjectionWkt(definition).has_value()) << definition;
}

}  // namespace
}  // namespace rodeira::terrain
