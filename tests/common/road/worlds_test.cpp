// The project's own worlds are what they say they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "common/network/marking.hpp"
#include "common/network/placing.hpp"
#include "common/road/road_chains.hpp"
#include "common/road/world.hpp"
#include "common/road/world_report.hpp"
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
  // By village: where along the main road its signs stand, for those who come one way and the other.
  std::map<std::string, std::map<std::string, double>> villages;
  int limits = 0;
  for (const RoadChain::Part& part : main.parts) {
    for (const network::Signal& signal : network.roads()[part.road].spec().signals) {
      if (signal.type == "310" || signal.type == "311") villages[signal.text][signal.type + signal.orientation] = part.from_s_m + signal.s_m;
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
  EXPECT_EQ(world->At(middle.x(), middle.y()).surface, terrain::Surface::kGrass);
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
    for (const double t : {-3.9, 0.0, 3.9}) EXPECT_EQ(world->At(road.Surface(s, t).p_W.x(), road.Surface(s, t).p_W.y()).z_m, 0.0);
  }
}

// ISO 3888-1: sections of 15, 25 and 15 m, 30 and 25 m between them; widths of 1.1, 1.2 and 1.3 of the car's (1.8 m) and 0.25 m; the
// second one 3.5 m beside the first.
TEST(Flat, HasTheLanesOfAnIsoLaneChange) {
  const auto world = Of("flat.yaml");
  const network::Network& network = *world->network();
  const std::uint32_t index = *network.FindRoad("lane_change");
  const network::Road& road = network.roads()[index];
  struct Gate {
    double from_s_m, to_s_m, width_m, middle_t_m;
  };
  const double first_t_m = -2.0;
  for (const Gate& gate : {Gate{200.0, 215.0, 1.1 * 1.8 + 0.25, first_t_m}, Gate{245.0, 270.0, 1.2 * 1.8 + 0.25, first_t_m + 3.5}, Gate{295.0, 310.0, 1.3 * 1.8 + 0.25, first_t_m}}) {
    std::set<double> painted, posts;
    for (const network::Marking& line : network::MarkingsOf(road)) {
      if (line.colour == "yellow" && line.from_s_m == gate.from_s_m && line.to_s_m == gate.to_s_m) painted.insert(network::MarkingAt(road, line, gate.from_s_m).value);
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
  for (double at = 0.0; at < chains[0].length_m; at += 1.0) {
    const auto [road, s] = chains[0].At(*world->network(), at);
    if (!road->spec().junction.empty()) continue;  // there the crossing road's height takes part
    sharpest = std::max(sharpest, std::fabs(road->axis().Evaluate(s).curvature_1pm));
    steepest = std::max(steepest, std::fabs(road->spec().elevation.Evaluate(s).slope));
  }
  EXPECT_LE(sharpest, 1.0 / 249.0);
  EXPECT_LE(steepest, 0.045);
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

INSTANTIATE_TEST_SUITE_P(All, WorldsOfTheProject, testing::Values("haste.yaml", "motorway.yaml", "flat.yaml", "n222.yaml"),
                         [](const auto& file) { return std::string(file.param).substr(0, std::string(file.param).find('.')); });

}  // namespace
}  // namespace rodeira::road
