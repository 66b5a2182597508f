// SPDX-License-Identifier: Apache-2.0
// Lights of OpenDRIVE files as different editors write them: which lanes they hold for, and the times that Rodeira
// makes up. The ways that cross are known from how the crossing is drawn.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "common/traffic/results/study.hpp"
#include "common/world/lanes/lights.hpp"
#include "tests/common/world/opendrive/lit_crossing.hpp"
#include "tests/long_form.hpp"

namespace rodeira::traffic {
namespace {

using opendrive::LitCrossing;

std::size_t Warnings(const opendrive::Import& import, const std::string& rule) {
  return static_cast<std::size_t>(std::count_if(import.warnings.begin(), import.warnings.end(),
                                                [&](const opendrive::Finding& w) { return w.rule == rule; }));
}

// Of four arms, numbered in their order around the crossing, neighbours cross one another's ways; opposite ones do not
// (one that turns left yields).
bool AreNeighbours(int a, int b) { return (a - b) % 2 != 0; }

bool Goes(network::LightColour colour) {
  return colour == network::LightColour::kGreen || colour == network::LightColour::kAmber;
}

// By arm: what its lane shows at a time; nothing where no light holds.
std::optional<network::LightColour> Shown(const lanes::Graph& graph, const LitCrossing& crossing, int arm,
                                          double time_s) {
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const network::LaneKey& key = graph[track].lane;
    if (graph.network().roads()[key.road].id() != LitCrossing::ArmId(arm) || key.lane != crossing.InLane(arm)) continue;
    const auto lights = lanes::LightsOf(graph, track);
    if (lights.empty()) return std::nullopt;
    EXPECT_EQ(lights.size(), static_cast<std::size_t>(crossing.heads));
    return network::ColourAt(*graph.network().controllers()[lights[0].controller].times, std::llround(time_s * 1e9));
  }
  ADD_FAILURE() << "arm " << arm << " has no lane towards the crossing";
  return std::nullopt;
}

std::size_t LitLanes(const lanes::Graph& graph) {
  std::size_t lit = 0;
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) lit += LightsOf(graph, track).empty() ? 0 : 1;
  return lit;
}

LitCrossing Drawn(std::mt19937_64& draws) {
  const auto below = [&](int count) { return std::uniform_int_distribution(0, count - 1)(draws); };
  LitCrossing crossing;
  crossing.orientation = static_cast<LitCrossing::Orientation>(below(3));
  // Without a lane a light that says the side that it faces, or none, cannot be told from others.
  crossing.validity = crossing.orientation != LitCrossing::Orientation::kOfTraffic || below(2) == 0;
  crossing.validity_turned = below(2) == 0;
  crossing.heads = 1 + below(2);
  crossing.referenced = below(2) == 0;
  for (std::size_t arm = 0; arm < 4; ++arm) crossing.outward[arm] = below(2) == 0;
  const std::vector<std::vector<std::vector<int>>> groups{
      {{0, 2}, {1, 3}}, {{1, 3}, {0, 2}}, {{0}, {1}, {2}, {3}}, {{3}, {0, 2}, {1}}};
  crossing.groups = groups[static_cast<std::size_t>(below(4))];
  return crossing;
}

std::string Told(const StudyResult& r) {
  std::string told;
  for (const std::string& incident : r.incidents) told += "\n" + incident;
  return told;
}

TEST(FileLights, HoldForTheirLanesInTurnsThatDoNotConflict) {
  std::mt19937_64 draws(5);
  std::int64_t trips = 0;
  for (int i = 0; i < BriefOrLong(24, 200); ++i) {
    const LitCrossing crossing = Drawn(draws);
    const opendrive::Import import = opendrive::MustImport(crossing.Text());
    const lanes::Graph graph(*import.network);
    const bool faced = crossing.orientation == LitCrossing::Orientation::kFaced;
    EXPECT_EQ(Warnings(import, "rodeira.orientation"), faced ? 1u : 0u) << crossing.Text();
    EXPECT_EQ(Warnings(import, "rodeira.times"), 0u) << crossing.Text();
    ASSERT_EQ(LitLanes(graph), 4u) << crossing.Text();
    std::set<int> green;
    for (double time_s = 0.25; time_s < 300.0; time_s += 0.5) {
      for (int a = 0; a < 4; ++a) {
        const auto shown = Shown(graph, crossing, a, time_s);
        ASSERT_TRUE(shown) << "arm " << a;
        if (*shown == network::LightColour::kGreen) green.insert(a);
        for (int b = 0; b < a; ++b) {
          const bool both = Goes(*shown) && Goes(*Shown(graph, crossing, b, time_s));
          ASSERT_FALSE(both && AreNeighbours(a, b)) << "arms " << a << " and " << b << " at " << time_s << " s";
        }
      }
    }
    EXPECT_EQ(green.size(), 4u) << "an arm is never green";
    if (i % 4 != 0) continue;
    StudySettings settings;
    settings.traffic.vehicles = 30, settings.traffic.seed = static_cast<std::uint64_t>(i);
    settings.duration_s = 120.0, settings.step_s = 0.05;
    const auto driven = RunStudy(settings, import.network);
    ASSERT_TRUE(driven.ok()) << driven.error().Text();
    EXPECT_EQ(driven.value().reds, 0) << Told(driven.value());
    EXPECT_EQ(driven.value().collisions, 0) << Told(driven.value());
    EXPECT_EQ(driven.value().off_lane, 0) << Told(driven.value());
    trips += driven.value().arrivals;
  }
  EXPECT_GT(trips, 100);
}

// Lights that cannot be given times that keep ways apart stay dark, with a sentence, and the file is driven on.
TEST(FileLights, StayDarkWhereTheirOwnWaysCross) {
  for (const auto orientation :
       {LitCrossing::Orientation::kOfTraffic, LitCrossing::Orientation::kFaced, LitCrossing::Orientation::kNone}) {
    for (const bool referenced : {false, true}) {
      for (const auto& [groups, dark, lit] :
           std::vector<std::tuple<std::vector<std::vector<int>>, std::size_t, std::size_t>>{
               {{{0, 1, 2, 3}}, 1, 0}, {{{0, 1}, {2, 3}}, 2, 0}, {{{0, 1}, {2}, {3}}, 1, 2}, {{}, 0, 0}}) {
        LitCrossing crossing;
        crossing.orientation = orientation, crossing.referenced = referenced, crossing.groups = groups;
        const opendrive::Import import = opendrive::MustImport(crossing.Text());
        EXPECT_EQ(Warnings(import, "rodeira.times"), dark);
        EXPECT_EQ(lanes::DarkControllers(*import.network).size(), dark);
        EXPECT_EQ(LitLanes(lanes::Graph(*import.network)), lit);
        StudySettings settings;
        settings.traffic.vehicles = 20, settings.duration_s = 60.0, settings.step_s = 0.05;
        const auto driven = RunStudy(settings, import.network);
        ASSERT_TRUE(driven.ok()) << driven.error().Text();
        EXPECT_EQ(driven.value().reds, 0) << Told(driven.value());
        EXPECT_EQ(driven.value().collisions, 0) << Told(driven.value());
      }
    }
  }
}

// A controller with times of the file's is not crossed by one with times that are made up.
TEST(FileLights, TimesOfTheFileAreKept) {
  LitCrossing crossing;
  crossing.times = "60 5 25 3 1";
  const opendrive::Import import = opendrive::MustImport(crossing.Text());
  EXPECT_EQ(Warnings(import, "rodeira.times"), 1u);
  const lanes::Graph graph(*import.network);
  EXPECT_EQ(LitLanes(graph), 2u);
  EXPECT_EQ(Shown(graph, crossing, 0, 10.0), network::LightColour::kGreen);
  EXPECT_EQ(Shown(graph, crossing, 0, 40.0), network::LightColour::kRed);
  EXPECT_FALSE(Shown(graph, crossing, 1, 10.0));
}

TEST(FileLights, ALightThatIsNeverGreenIsRefused) {
  LitCrossing crossing;
  crossing.times = "60 5 0 3 1";
  StudySettings settings;
  settings.traffic.vehicles = 5;
  const auto driven = RunStudy(settings, opendrive::MustRead(crossing.Text()));
  ASSERT_FALSE(driven.ok());
  EXPECT_EQ(driven.error().Text(),
            "network '': the light 'group 0' (signal light0.0, road '1', lane -1) is never green; a time of green was "
            "expected");
}

// A light's orientation that fits one of the lanes that it names is kept, whatever the others are.
TEST(FileLights, AnOrientationThatFitsIsKept) {
  opendrive::RoadText road;
  const std::string light =
      "<signal id=\"{}\" name=\"light\" s=\"50\" t=\"0\" zOffset=\"3\" orientation=\"{}\" dynamic=\"yes\" "
      "country=\"OpenDRIVE\" type=\"1000001\" subtype=\"-1\" height=\"0.9\" width=\"0.3\"><validity fromLane=\"{}\" "
      "toLane=\"{}\"/></signal>";
  road.more = "<signals>" + fmt::format(fmt::runtime(light), "a", "+", -1, 1) +
              fmt::format(fmt::runtime(light), "b", "-", 1, 1) + fmt::format(fmt::runtime(light), "c", "-", -1, -1) +
              "</signals>\n";
  const opendrive::Import import =
      opendrive::MustImport(opendrive::Document(
          road.Text() + "<controller id=\"1\"><control signalId=\"a\" type=\"0\"/><control signalId=\"b\" type=\"0\"/>"
                        "<control signalId=\"c\" type=\"0\"/></controller>\n"));
  ASSERT_EQ(Warnings(import, "rodeira.orientation"), 1u);
  const auto& signals = import.network->roads()[0].spec().signals;
  EXPECT_EQ(signals[0].orientation, "+");
  EXPECT_EQ(signals[1].orientation, "-");
  EXPECT_EQ(signals[2].orientation, "+");
}

}  // namespace
}  // namespace rodeira::traffic
