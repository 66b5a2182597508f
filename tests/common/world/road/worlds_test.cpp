// SPDX-License-Identifier: Apache-2.0
// The project's own worlds are what they say they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include "common/core/base/random.hpp"
#include "common/world/network/marking.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/road/road_chains.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

using network::LaneKey;

std::shared_ptr<const World> Of(const char* name) {
  const auto world = World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / name);
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.ok() ? world.value() : nullptr;
}

TEST(Haste, HasFiveVillagesWithTheirSignsAndLimits) {
  const auto world = Of("haste.yaml");
  const network::Network& network = *world->network();
  const RoadChain main = ChainsOf(network)[0];
  // By village: where along the main road its signs stand, for traffic of either way.
  std::map<std::string, std::map<std::string, double>> villages;
  int limits = 0;
  for (const RoadChain::Part& part : main.parts) {
    for (const network::Signal& signal : network.roads()[part.road].spec().signals) {
      if (signal.type == "310" || signal.type == "311")
        villages[signal.text][signal.type + signal.orientation] = part.from_s_m + signal.s_m;
      limits += signal.type == "274";
    }
  }
  ASSERT_EQ(villages.size(), 5u);
  EXPECT_EQ(limits, 10);
  for (const auto& [name, signs] : villages) {
    ASSERT_EQ(signs.size(), 4u) << name;
    EXPECT_NEAR(signs.at("310+"), signs.at("311-"), 0.1) << name;
    EXPECT_NEAR(signs.at("311+"), signs.at("310-"), 0.1) << name;
    EXPECT_GT(signs.at("311+"), signs.at("310+") + 200.0) << name;
    const auto limit_kmh = [&](double at_m) {
      const auto [road, s] = main.At(network, at_m);
      return road->SpeedLimitAt(*road->spec().sections[0].Find(-1), s).value() * 3.6;
    };
    EXPECT_NEAR(limit_kmh(signs.at("310+") - 5.0), 90.0, 1e-9) << name;
    EXPECT_NEAR(limit_kmh(signs.at("310+") + 5.0), 50.0, 1e-9) << name;
    EXPECT_NEAR(limit_kmh(signs.at("311+") - 5.0), 50.0, 1e-9) << name;
    EXPECT_NEAR(limit_kmh(signs.at("311+") + 5.0), 90.0, 1e-9) << name;
  }
}

TEST(Motorway, HasTwoCarriagewaysAndABridgeAboveThem) {
  const auto world = Of("motorway.yaml");
  const network::Network& network = *world->network();
  const network::Road& road = network.roads()[*network.FindRoad("a1")];
  EXPECT_GT(road.length_m(), 7'900.0);
  const network::LaneSection& section = road.spec().sections[0];
  for (const int side : {-1, 1}) {
    EXPECT_EQ(section.Find(side)->type, network::LaneType::kMedian);
    for (const int lane : {2 * side, 3 * side}) {
      EXPECT_EQ(section.Find(lane)->type, network::LaneType::kDriving);
      EXPECT_EQ(section.Find(lane)->direction, -side);
      EXPECT_NEAR(road.SpanAt(0, lane, 4'000.0)->width_m(), 3.75, 1e-12);
    }
    EXPECT_EQ(section.Find(4 * side)->type, network::LaneType::kShoulder);
    EXPECT_NEAR(road.SpanAt(0, 4 * side, 4'000.0)->width_m(), 3.0, 1e-12);  // an emergency lane
    EXPECT_NEAR(road.SpeedLimitAt(*section.Find(2 * side), 4'000.0).value() * 3.6, 130.0, 1e-9);
  }
  // Grass between the carriageways, rails on it.
  const Eigen::Vector3d middle = road.Surface(4'000.0, 1.0).p_W;
  EXPECT_EQ(world->At(middle.x(), middle.y()).surface, ground::Surface::kGrass);
  const Eigen::Vector3d below = road.Surface(4'800.0, 6.0).p_W;
  const auto layers = world->MakeGround()->Layers(below.x(), below.y());
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_GT(layers[0].z_m - layers[1].z_m, 4.5);  // room for a lorry
}

TEST(Flat, HasASkidPadOfSixtyMetresRadius) {
  const auto world = Of("flat.yaml");
  const network::Network& network = *world->network();
  const LaneKey lane{*network.FindRoad("skid_pad"), 0, -1};
  const network::Road& road = network.roads()[lane.road];
  for (double s = 0.0; s < road.length_m(); s += 1.0) {
    const Eigen::Vector3d p = network.Centre(lane, s);
    EXPECT_NEAR((p.head<2>() - Eigen::Vector2d(0.0, 258.0)).norm(), 60.0, 1e-9);
    EXPECT_EQ(p.z(), 0.0);
    EXPECT_NEAR(world->At(p.x(), p.y()).friction, 1.0, 1e-12);
    const Eigen::Vector3d wet = network.Centre({lane.road, 0, -2}, s);
    EXPECT_NEAR(world->At(wet.x(), wet.y()).friction, 0.5, 1e-12);
  }
  const auto next = network.Successors(lane);  // round and round
  ASSERT_EQ(next.size(), 1u);
  EXPECT_EQ(next[0].lane, lane);
}

TEST(Flat, HasAStraightOfTwoKilometres) {
  const auto world = Of("flat.yaml");
  const network::Network& network = *world->network();
  const network::Road& road = network.roads()[*network.FindRoad("straight")];
  EXPECT_EQ(road.length_m(), 2'000.0);
  for (double s = 0.0; s <= 2'000.0; s += 50.0) {
    EXPECT_EQ(road.axis().Evaluate(s).curvature_1pm, 0.0);
    for (const double t : {-3.9, 0.0, 3.9})
      EXPECT_EQ(world->At(road.Surface(s, t).p_W.x(), road.Surface(s, t).p_W.y()).z_m, 0.0);
  }
}

// ISO 3888-1: sections of 15, 25 and 15 m, 30 and 25 m between them; widths of 1.1, 1.2 and 1.3 of the car's (1.8 m)
// and 0.25 m; the second one 3.5 m beside the first.
TEST(Flat, HasTheLanesOfAnIsoLaneChange) {
  const auto world = Of("flat.yaml");
  const network::Network& network = *world->network();
  const std::uint32_t index = *network.FindRoad("lane_change");
  const network::Road& road = network.roads()[index];
  struct Gate {
    double from_s_m, to_s_m, width_m, middle_t_m;
  };
  const double first_t_m = -2.0;
  for (const Gate& gate :
       {Gate{200.0, 215.0, 1.1 * 1.8 + 0.25, first_t_m}, Gate{245.0, 270.0, 1.2 * 1.8 + 0.25, first_t_m + 3.5},
        Gate{295.0, 310.0, 1.3 * 1.8 + 0.25, first_t_m}}) {
    std::set<double> painted, posts;
    for (const network::Marking& line : network::MarkingsOf(road)) {
      if (line.colour == "yellow" && line.from_s_m == gate.from_s_m && line.to_s_m == gate.to_s_m)
        painted.insert(network::MarkingAt(road, line, gate.from_s_m).value);
    }
    for (const network::Placed& thing : network::PlaceFurniture(network).things) {
      if (thing.road == index && thing.s_m >= gate.from_s_m && thing.s_m <= gate.to_s_m) posts.insert(thing.t_m);
    }
    ASSERT_EQ(painted.size(), 2u);
    EXPECT_EQ(painted, posts);
    EXPECT_NEAR(*painted.rbegin() - *painted.begin(), gate.width_m, 1e-9) << gate.from_s_m;
    EXPECT_NEAR(0.5 * (*painted.rbegin() + *painted.begin()), gate.middle_t_m, 1e-9) << gate.from_s_m;
  }
}

TEST(Haste, IsAsLongAndCrossedAsItSays) {
  const auto world = World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/haste.yaml").value();
  const auto chains = ChainsOf(*world->network());
  EXPECT_GT(chains[0].length_m, 29'000.0);
  EXPECT_GE(world->network()->junctions().size(), 4u);
  double sharpest = 0.0, steepest = 0.0;
  int stations = 0;
  for (double at = 0.0; at < chains[0].length_m; at += 1.0) {
    const auto [road, s] = chains[0].At(*world->network(), at);
    if (!road->spec().junction.empty()) continue;  // there the crossing road's height takes part
    ++stations;
    sharpest = std::max(sharpest, std::fabs(road->axis().Evaluate(s).curvature_1pm));
    steepest = std::max(steepest, std::fabs(road->spec().elevation.Evaluate(s).slope));
  }
  EXPECT_GT(stations, 28'000);
  EXPECT_LE(sharpest, 1.0 / 249.0);
  EXPECT_LE(steepest, 0.045);
}

// The heights of a .bt file, read by its format's description (https://vterrain.org/Implementation/Formats/BT.html) and
// by nothing of ours.
struct RawHeights {
  std::int32_t columns = 0, rows = 0;
  double west_m = 0.0, east_m = 0.0, south_m = 0.0, north_m = 0.0;
  std::vector<double> z_m;  // columns from west to east, each from south to north

  double At(int column, int row) const {
    return z_m[static_cast<std::size_t>(column) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row)];
  }
};
RawHeights ReadRaw(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, 256> header{};
  in.read(header.data(), header.size());
  EXPECT_EQ(std::string(header.data(), 9), "binterr1.");
  const auto read = [&](std::size_t at, auto& value) { std::memcpy(&value, header.data() + at, sizeof value); };
  RawHeights raw;
  std::int16_t bytes = 0, real = 0;
  float scale = 0.0F;
  read(10, raw.columns), read(14, raw.rows), read(18, bytes), read(20, real), read(28, raw.west_m),
      read(36, raw.east_m), read(44, raw.south_m), read(52, raw.north_m), read(62, scale);
  EXPECT_TRUE((bytes == 2 || bytes == 4) && (real == 0 || bytes == 4));
  for (std::int64_t i = 0; i < std::int64_t{raw.columns} * raw.rows; ++i) {
    std::array<char, 4> cell{};
    in.read(cell.data(), bytes);
    double z = 0.0;
    if (real != 0)
      z = std::bit_cast<float>(cell);
    else if (bytes == 4)
      z = std::bit_cast<std::int32_t>(cell);
    else
      z = std::bit_cast<std::int16_t>(std::array{cell[0], cell[1]});
    raw.z_m.push_back(z * (scale == 0.0F ? 1.0 : static_cast<double>(scale)));
  }
  EXPECT_TRUE(in.good());
  return raw;
}

// `crater.yaml` as it stands, beside the elevation file that it names.
TEST(Crater, IsTheElevationFileBesideIt) {
  const std::filesystem::path elevations = std::filesystem::path(SourceDir()) / "../shared/data/road/bt/crater_0513.bt";
  if (!std::filesystem::exists(elevations)) GTEST_SKIP() << elevations << " is not on this machine";
  const cli::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "crater.yaml";
  std::filesystem::copy_file(std::filesystem::path(SourceDir()) / "configs/worlds/crater.yaml", file);
  std::filesystem::create_symlink(std::filesystem::canonical(elevations), folder.path() / elevations.filename());
  for (const auto& problem : WorldProblems(file)) ADD_FAILURE() << problem.Text();
  const auto loaded = World::Load(file);
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const World& world = *loaded.value();
  const RawHeights raw = ReadRaw(elevations);
  ASSERT_EQ(raw.columns, 513);
  ASSERT_EQ(raw.rows, 513);
  const double step_x = (raw.east_m - raw.west_m) / 512.0, step_y = (raw.north_m - raw.south_m) / 512.0;
  const auto suelo = world.MakeGround();
  const auto expect = [&](double column, double row, double z_m) {
    const ground::GroundPoint at = suelo->At(raw.west_m + column * step_x, raw.south_m + row * step_y);
    ASSERT_TRUE(at.inside);
    EXPECT_NEAR(at.z_m, z_m, 1e-6) << column << " " << row;
    EXPECT_EQ(at.surface, ground::Surface::kSoil);
    EXPECT_EQ(at.friction, 0.65);
  };
  int uneven = 0;
  for (int column = 3; column < 510; column += 17) {
    for (int row = 5; row < 510; row += 13) {
      const double sw = raw.At(column, row), se = raw.At(column + 1, row), nw = raw.At(column, row + 1),
                   ne = raw.At(column + 1, row + 1);
      expect(column, row, sw);
      expect(column + 0.5, row, 0.5 * (sw + se));
      expect(column, row + 0.5, 0.5 * (sw + nw));
      expect(column + 0.5, row + 0.5,
             0.5 * (se + nw));  // the cell is split from its south-east to its north-west corner
      expect(column + 0.25, row + 0.25, sw + 0.25 * (se - sw) + 0.25 * (nw - sw));
      expect(column + 0.75, row + 0.75, ne + 0.25 * (nw - ne) + 0.25 * (se - ne));
      uneven += std::fabs(sw + ne - se - nw) > 0.1;
    }
  }
  EXPECT_GT(uneven, 100) << "so that the diagonal matters";
  for (const auto& [column, row] : {std::pair(0, 0), std::pair(512, 0), std::pair(0, 512), std::pair(512, 512)})
    expect(column, row, raw.At(column, row));  // all edges belong to it
  EXPECT_FALSE(suelo->At(raw.west_m - 0.01, raw.south_m + 100.0).inside);
  EXPECT_FALSE(suelo->At(raw.east_m + 0.01, raw.south_m + 100.0).inside);
  // The car starts in its middle.
  EXPECT_NEAR(world.start().x_m, 0.5 * (raw.west_m + raw.east_m), 1e-6);
  EXPECT_NEAR(world.start().y_m, 0.5 * (raw.south_m + raw.north_m), 1e-6);
}

class WorldsOfTheProject : public testing::TestWithParam<const char*> {};

TEST_P(WorldsOfTheProject, LoadAndHaveGroundUnderTheirLanes) {
  const auto path = std::filesystem::path(SourceDir()) / "configs/worlds" / GetParam();
  for (const auto& problem : WorldProblems(path)) ADD_FAILURE() << problem.Text();
  const auto loaded = World::Load(path);
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const World& world = *loaded.value();
  for (const network::LaneKey& key : world.network()->Lanes()) {
    const network::Road& road = world.network()->roads()[key.road];
    if (!road.spec().unevenness.empty()) continue;  // it stands on the road
    for (double s = 0.5; s < road.length_m(); s += 23.0) {
      const Eigen::Vector3d p = world.network()->Centre(key, s);
      const SurfacePoint at = world.At(p.x(), p.y(), p.z());
      ASSERT_TRUE(at.inside) << road.id() << " " << s;
      EXPECT_NEAR(at.z_m, p.z(), 0.005) << road.id() << " " << key.lane << " " << s;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, WorldsOfTheProject,
                         testing::Values("haste.yaml", "motorway.yaml", "flat.yaml", "n222.yaml"),
                         [](const auto& file) {
                           return std::string(file.param).substr(0, std::string(file.param).find('.'));
                         });

// Of the project's own and of files of others: whatever the hint, there is ground on every place of a road.
TEST(Worlds, EveryPlaceOfARoadHasAHeight) {
  std::vector<std::filesystem::path> files = opendrive::RealFiles();
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SourceDir()) / "configs/worlds")) {
    if (entry.path().extension() == ".yaml" && entry.path().stem() != "crater")
      files.push_back(entry.path());  // its elevation is not in the tree
  }
  std::sort(files.begin(), files.end());
  ASSERT_GE(files.size(), 5u);
  for (const auto& file : files) {
    const auto world = World::Load(file);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    if (world.value()->network() == nullptr) continue;
    const auto roads = world.value()->network()->roads();
    for (std::uint64_t i = 0; i < 10'000 && !roads.empty(); ++i) {
      const network::Road& road =
          roads[static_cast<std::size_t>(base::RandomUniform({i, 1}, 0.0, static_cast<double>(roads.size())))];
      const double s = base::RandomUniform({i, 2}, 0.0, road.length_m());
      double right, left;
      road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
      const Eigen::Vector3d p_W = road.Surface(s, base::RandomUniform({i, 3}, right, left)).p_W;
      for (const double hint_m : {std::numeric_limits<double>::quiet_NaN(), p_W.z(), p_W.z() - 5.0, -1000.0}) {
        const SurfacePoint at = world.value()->At(p_W.x(), p_W.y(), hint_m);
        ASSERT_TRUE(at.inside && std::isfinite(at.z_m) && std::isfinite(at.slope_x) && std::isfinite(at.slope_y))
            << file.filename() << " " << road.spec().id << " s " << s << " hint " << hint_m;
      }
    }
  }
}

}  // namespace
}  // namespace rodeira::road
