#include "common/road/hills.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/terrain/bt.hpp"
#include "tests/common/road/sample_world.hpp"

namespace rodeira::road {
namespace {

HillsSpec Spec() {
  HillsSpec spec;
  spec.seed = 11;
  spec.columns = 81, spec.rows = 61;
  spec.west_m = -150.0, spec.south_m = -200.0, spec.spacing_m = 6.0;
  spec.base_z_m = 50.0, spec.below_m = 0.5;
  spec.flat_m = 10.0, spec.full_m = 60.0;
  spec.relief = {{100.0, 30.0}, {40.0, 5.0}};
  return spec;
}

TEST(Hills, TheSameSeedGivesTheSameBytesAndAnotherOneOthers) {
  HillsSpec spec = Spec();
  const auto roads = Sample()->roads();
  const base::Bytes first = terrain::BtBytes(MakeHills(spec, roads));
  EXPECT_EQ(terrain::BtBytes(MakeHills(spec, roads)), first);
  spec.seed = 12;
  EXPECT_NE(terrain::BtBytes(MakeHills(spec, roads)), first);
}

TEST(Hills, WithoutRoadsTheyRiseAboutTheBase) {
  const auto grid = MakeHills(Spec(), std::span<const Road>());
  double low = 1e9, high = -1e9;
  for (const float height : grid.heights_m()) low = std::min(low, double{height}), high = std::max(high, double{height});
  EXPECT_TRUE(low > 15.0 && low < 45.0) << low;
  EXPECT_TRUE(high < 85.0 && high > 55.0) << high;
}

TEST(Hills, LieLevelWithTheRoadNearIt) {
  const Road& road = Sample()->roads()[0];
  const auto grid = MakeHills(Spec(), Sample()->roads());
  int near = 0, far = 0;
  for (int column = 0; column < grid.frame().columns; ++column) {
    for (int row = 0; row < grid.frame().rows; ++row) {
      const double x = grid.frame().west_m + column * 6.0, y = grid.frame().south_m + row * 6.0;
      const geometry::Foot foot = road.plan().Project(x, y);
      const double above = static_cast<double>(grid.Post(column, row)) - road.profile().Evaluate(foot.s_m).z_m;
      if (foot.distance_m < 7.0 && foot.beyond_m == 0.0) {
        EXPECT_NEAR(above, -0.5, 0.6) << x << " " << y;  // grades of 7 % along 10 m of softness
        ++near;
      } else if (foot.distance_m > 60.0 && std::fabs(above) > 3.0) {
        ++far;
      }
    }
  }
  EXPECT_GT(near, 50);
  EXPECT_GT(far, 500);
}

TEST(Hills, LayersAreNoCopiesOfOneAnother) {
  HillsSpec one = Spec(), two = Spec();
  one.relief = {{100.0, 20.0}};
  two.relief = {{100.0, 10.0}, {100.0, 10.0}};
  const auto a = MakeHills(one, std::span<const Road>()), b = MakeHills(two, std::span<const Road>());
  double difference = 0.0;
  for (std::size_t i = 0; i < a.heights_m().size(); ++i) difference = std::max(difference, std::fabs(double{a.heights_m()[i]} - double{b.heights_m()[i]}));
  EXPECT_GT(difference, 5.0);
}

}  // namespace
}  // namespace rodeira::road
