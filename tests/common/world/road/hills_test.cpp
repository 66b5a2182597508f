// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/hills.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/core/base/temporary_folder.hpp"
#include "common/world/road/hills_cache.hpp"
#include "common/world/terrain/bt.hpp"
#include "tests/common/world/road/sample_world.hpp"

namespace rodeira::road {
namespace {

HillsSpec Spec() {
  HillsSpec spec;
  spec.seed = 11;
  spec.columns = 81, spec.rows = 61;
  spec.west_m = -150.0, spec.south_m = -200.0, spec.spacing_m = 6.0;
  spec.base_z_m = 50.0, spec.below_m = 0.5;
  spec.flat_m = 10.0, spec.full_m = 60.0, spec.reach_m = 180.0;
  spec.relief = {{100.0, 30.0}, {40.0, 5.0}};
  return spec;
}

TEST(Hills, TheSameSeedGivesTheSameBytesAndAnotherOneOthers) {
  HillsSpec spec = Spec();
  const std::span<const Road> roads = SampleRoad().Alone();
  const base::Bytes first = terrain::BtBytes(MakeHills(spec, roads));
  EXPECT_EQ(terrain::BtBytes(MakeHills(spec, roads)), first);
  spec.seed = 12;
  EXPECT_NE(terrain::BtBytes(MakeHills(spec, roads)), first);
}

TEST(Hills, WithoutRoadsTheyRiseAboutTheBase) {
  const auto grid = MakeHills(Spec(), std::span<const Road>());
  double low = 1e9, high = -1e9;
  for (const float height : grid.heights_m())
    low = std::min(low, double{height}), high = std::max(high, double{height});
  EXPECT_TRUE(low > 15.0 && low < 45.0) << low;
  EXPECT_TRUE(high < 85.0 && high > 55.0) << high;
}

TEST(Hills, LieLevelWithTheRoadNearIt) {
  const Version1Road& road = SampleRoad();
  const auto grid = MakeHills(Spec(), SampleRoad().Alone());
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

std::vector<AxisPoint> Straight(double y_m, double z_m) {
  std::vector<AxisPoint> points;
  for (double x = -140.0; x <= 300.0; x += 20.0) points.push_back({{x, y_m, z_m}, 20.0});
  return points;
}

// The formula that is written in hills.hpp, by another program: in long doubles, and from all points.
TEST(Hills, WithoutReliefAreWhatTheFormulaSays) {
  HillsSpec spec = Spec();
  spec.relief.clear();
  std::vector<AxisPoint> axis = Straight(-60.0, 62.0), other = Straight(90.0, 31.0);
  axis.insert(axis.end(), other.begin(), other.end());
  const auto grid = MakeHills(spec, axis);
  for (int column = 0; column < spec.columns; ++column) {
    for (int row = 0; row < spec.rows; ++row) {
      const long double x = spec.west_m + column * spec.spacing_m, y = spec.south_m + row * spec.spacing_m;
      long double weights = 4.0L / std::pow(180.0L, 3), heights = weights * 50.0L;
      for (const AxisPoint& point : axis) {
        const long double d = std::hypot(x - point.p_W.x(), y - point.p_W.y());
        if (d >= 180.0L) continue;
        const long double weight = 20.0L * std::pow(1.0L - d * d / (180.0L * 180.0L), 3) / std::pow(d * d + 100.0L, 2);
        weights += weight, heights += weight * (point.p_W.z() - 0.5L);
      }
      ASSERT_NEAR(grid.Post(column, row), static_cast<double>(heights / weights), 1e-5) << x << " " << y;
    }
  }
}

TEST(Hills, FarFromAPointThatMovesNotABitChanges) {
  HillsSpec spec = Spec();
  spec.reach_m = 90.0;
  std::vector<AxisPoint> axis = Straight(-60.0, 62.0);
  const auto before = MakeHills(spec, axis);
  const Eigen::Vector2d old_W = axis[5].p_W.head<2>();
  axis[5].p_W += Eigen::Vector3d(3.0, 7.0, 4.0);
  axis.insert(axis.begin(), AxisPoint{{10'000.0, 0.0, 900.0}, 40.0});  // nor does it where a road is far from all of it
  const auto after = MakeHills(spec, axis);
  int changed = 0, kept = 0;
  for (int column = 0; column < spec.columns; ++column) {
    for (int row = 0; row < spec.rows; ++row) {
      const Eigen::Vector2d p(spec.west_m + column * spec.spacing_m, spec.south_m + row * spec.spacing_m);
      const double near_m = std::min((p - old_W).norm(), (p - axis[6].p_W.head<2>()).norm());
      const bool same = before.Post(column, row) == after.Post(column, row);
      if (near_m >= spec.reach_m) {
        EXPECT_TRUE(same) << p.transpose();
        ++kept;
      } else {
        changed += !same;
      }
    }
  }
  EXPECT_GT(changed, 300);
  EXPECT_GT(kept, 3000);
}

// Neither where a road's reach ends nor anywhere else is a kink: over 1 m the slope changes by no more than where the
// terrain bends to the road, and at the reach's end hardly at all.
TEST(Hills, PassIntoTheBaseWithoutAKink) {
  HillsSpec spec = Spec();
  spec.relief.clear();
  spec.columns = 2, spec.rows = 401, spec.spacing_m = 1.0, spec.west_m = 80.0, spec.south_m = 0.0;
  const auto grid = MakeHills(spec, Straight(0.0, 80.0));
  double most = 0.0, most_at_end = 0.0;
  int at_end = 0;
  for (int row = 1; row + 1 < spec.rows; ++row) {
    const double bend =
        std::fabs(double{grid.Post(0, row - 1)} - 2.0 * double{grid.Post(0, row)} + double{grid.Post(0, row + 1)});
    most = std::max(most, bend);
    if (row > 174 && row < 186) ++at_end, most_at_end = std::max(most_at_end, bend);
  }
  EXPECT_NEAR(grid.Post(0, 0), 79.5, 0.01);
  EXPECT_NEAR(grid.Post(0, 200), 50.0, 1e-5);
  EXPECT_LT(most, 0.02);  // 30 m down over some 120: the slope is 1 in 3 at most
  EXPECT_GT(most, 0.001);
  EXPECT_EQ(at_end, 11);
  EXPECT_LT(most_at_end, 0.05 * most);
}

TEST(Hills, WithoutABaseItIsTheRoadsMeanToTenMetres) {
  HillsSpec spec = Spec();
  spec.relief.clear();
  spec.base_z_m.reset();
  spec.reach_m = 60.0;
  std::vector<AxisPoint> axis = Straight(-150.0, 62.0);
  EXPECT_EQ(BaseOf(axis), 60.0);
  EXPECT_EQ(BaseOf({}), 0.0);
  axis.front().p_W.z() = 85.0;  // a road that is changed a little
  EXPECT_EQ(BaseOf(axis), 60.0);
  EXPECT_FLOAT_EQ(MakeHills(spec, axis).Post(0, 60), 59.5F);
}

// Where a plan element changes, the points on those before it stay, to the bit.
TEST(Hills, PointsFollowFromTheElementTheyLieOn) {
  const auto points = [](const std::string& last) {
    const auto world = World::Parse(
        "rodeira: world/2\nname: w\nground: {kind: plane, surface: grass}\nroads:\n  - id: a\n    start: {x_m: 3, y_m: "
        "4, heading_deg: 20}\n"
        "    axis: [line: {length_m: 333}, arc: {length_m: 120, radius_m: 90}, line: {length_m: " +
            last + "}]\n    z_m: 7\n    section: {template: rural}\n",
        "w.yaml");
    EXPECT_TRUE(world.ok()) << world.error().Text();
    return AxisPoints(*world.value()->network());
  };
  const auto shorter = points("100"), longer = points("145");
  double length_m = 0.0;
  std::size_t same = 0;
  for (const AxisPoint& point : longer) length_m += point.length_m;
  while (same < shorter.size() && shorter[same].p_W == longer[same].p_W &&
         shorter[same].length_m == longer[same].length_m)
    ++same;
  EXPECT_NEAR(length_m, 333.0 + 120.0 + 145.0, 1e-9);
  EXPECT_EQ(same, 10u + 4u);  // in nine pieces and in three
}

// A road of 1000 m, 25 m over the base, on a bridge over its middle 400 m, and one 20 m below it in a tunnel there:
// farther than their reach from where they stand on the ground the terrain is the base's, so that a valley lies under
// the bridge and a hill over the tunnel; where the structures begin it meets the road without a step.
TEST(Hills, FollowARoadOnABridgeOrInATunnelOnlyWhereTheyAreToldTo) {
  for (const auto& [kind, z_m] : {std::pair("bridges", 25.0), std::pair("tunnels", -20.0)}) {
    const auto text = [&](const std::string& structures, const std::string& follow) {
      return "rodeira: world/2\nname: w\nterrain:\n  surface: grass\n  generate: {seed: 7, columns: 121, rows: 101, "
             "spacing_m: 10, west_m: -600, south_m: -500, base_z_m: 0, flat_m: 5, full_m: 20, reach_m: 60, relief: [], "
             "follow_structures: " +
             follow +
             "}\n"
             "roads:\n  - id: a\n    start: {x_m: -500, y_m: 0, heading_deg: 0}\n    axis: [line: {length_m: 1000}]\n  "
             "  z_m: " +
             std::to_string(z_m) + "\n    section: {template: rural}\n" + structures;
    };
    const auto world = World::Parse(
        text(std::string("    ") + kind + ": [{from_s_m: 300, to_s_m: 600}, {from_s_m: 550, to_s_m: 700}]\n", "false"),
        "w.yaml");
    ASSERT_TRUE(world.ok()) << world.error().Text();
    double length_m = 0.0;
    for (const AxisPoint& point : AxisPoints(*world.value()->network(), false)) {
      length_m += point.length_m;
      EXPECT_TRUE(point.p_W.x() <= -200.0 + 1e-9 || point.p_W.x() >= 200.0 - 1e-9) << point.p_W.x();
    }
    EXPECT_NEAR(length_m, 600.0, 1e-9);
    for (const double x : {-130.0, 0.0, 130.0})
      EXPECT_EQ(world.value()->TerrainAt(x, 0.0).z_m, 0.0) << kind << " " << x;
    for (const double x : {-400.0, -250.0, 250.0, 400.0})
      EXPECT_NEAR(world.value()->TerrainAt(x, 0.0).z_m, z_m, 1.5) << kind << " " << x;
    for (const double end :
         {-1.0, 1.0}) {  // into the valley under the bridge, up over the tunnel's mouth from its roof
      const auto ground_at = [&](double x) { return world.value()->MakeGround()->Layers(end * x, 1.0); };
      double last = ground_at(210.0).front().z_m;
      EXPECT_NEAR(last, z_m, 0.2);
      for (double x = 209.95; x > 150.0; x -= 0.05) {
        const auto layers = ground_at(x);
        const double z = kind[0] == 'b' ? layers.back().z_m : layers.front().z_m;
        const bool portal = kind[0] == 't' && last < z_m + 0.2 && z > z_m + 4.0;
        EXPECT_TRUE(portal ? std::fabs(x - 200.0) < 0.06 : std::fabs(z - last) < 0.15)
            << kind << " " << end * x << ": " << last << " to " << z;
        last = z;
      }
      EXPECT_NEAR(last, 0.0, 3.0);
    }
    const auto followed = World::Parse(text(std::string("    ") + kind + ": [{from_s_m: 300, to_s_m: 700}]\n", "true"),
                                       "w.yaml"),
               without = World::Parse(text("", "false"), "w.yaml");
    EXPECT_NEAR(followed.value()->TerrainAt(0.0, 0.0).z_m, z_m, 1.5) << "as it says";
    EXPECT_EQ(terrain::BtBytes(*without.value()->grid()), terrain::BtBytes(*followed.value()->grid()))
        << "nothing to leave out";
  }
}

TEST(Hills, LayersAreNoCopiesOfOneAnother) {
  HillsSpec one = Spec(), two = Spec();
  one.relief = {{100.0, 20.0}};
  two.relief = {{100.0, 10.0}, {100.0, 10.0}};
  const auto a = MakeHills(one, std::span<const Road>()), b = MakeHills(two, std::span<const Road>());
  double difference = 0.0;
  for (std::size_t i = 0; i < a.heights_m().size(); ++i)
    difference = std::max(difference, std::fabs(double{a.heights_m()[i]} - double{b.heights_m()[i]}));
  EXPECT_GT(difference, 5.0);
}

// With one cache for all: what is found is of the very same arguments.
TEST(Hills, FromACacheAreThoseThatAreMadeWhateverOneArgumentIs) {
  const auto folder = base::TemporaryFolder::Make("hills-cache").value();
  base::FileCache cache(folder.path() / "cache");
  std::vector<AxisPoint> axis = AxisPoints(SampleRoad().Alone());
  const auto check = [&](const HillsSpec& spec) {
    const auto made = terrain::BtBytes(MakeHills(spec, axis));
    for (int time = 0; time < 2; ++time) EXPECT_EQ(terrain::BtBytes(MakeHillsOnce(spec, axis, &cache)), made);
    EXPECT_EQ(terrain::BtBytes(MakeHillsOnce(spec, axis, nullptr)), made);
    return base::Hash(made);
  };
  std::set<base::Digest> all{check(Spec())};
  const auto change = [&](const auto& set) {
    HillsSpec spec = Spec();
    set(spec);
    all.insert(check(spec));
  };
  change([](HillsSpec& s) { s.seed = 12; });
  change([](HillsSpec& s) { s.columns = 80; });
  change([](HillsSpec& s) { s.columns = 61, s.rows = 81; });
  change([](HillsSpec& s) { s.west_m += 1.0; });
  change([](HillsSpec& s) { s.south_m += 1.0; });
  change([](HillsSpec& s) { s.spacing_m = 6.5; });
  change([](HillsSpec& s) { s.base_z_m = 51.0; });
  change([](HillsSpec& s) { s.base_z_m.reset(); });
  change([](HillsSpec& s) { s.below_m = 0.6; });
  change([](HillsSpec& s) { s.flat_m = 11.0; });
  change([](HillsSpec& s) { s.full_m = 61.0; });
  change([](HillsSpec& s) { s.reach_m = 181.0; });
  change([](HillsSpec& s) { s.relief[0].wavelength_m = 101.0; });
  change([](HillsSpec& s) { s.relief[1].amplitude_m = 6.0; });
  change([](HillsSpec& s) { s.relief.pop_back(); });
  axis[3].p_W.z() += 0.5;
  all.insert(check(Spec()));
  axis[3].length_m *= 2.0;
  all.insert(check(Spec()));
  EXPECT_EQ(all.size(), 18u);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "cache"))
    std::filesystem::resize_file(entry.path(), std::filesystem::file_size(entry.path()) - 1);
  check(Spec());
}

}  // namespace
}  // namespace rodeira::road
