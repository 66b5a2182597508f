// SPDX-License-Identifier: Apache-2.0
// Roads of a world file that pass over one another without a bridge, and tunnels without a hill: told by `world check`
// with stations, which are computed by hand here.
#include "common/world/road/passes.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/base/files.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// What is said of a world file with this text.
std::vector<std::string> Said(const std::string& text) {
  const cli::TemporaryFolder folder;
  const auto file = folder.path() / "w.yaml";
  EXPECT_TRUE(base::WriteWhole(file, text).ok());
  for (const base::Error& problem : WorldProblems(file)) ADD_FAILURE() << problem.Text();
  return WorldWarnings(file);
}

// East along y = 0 for 300 m at z = 0, and north across it at x = 150 at a height.
std::string Crossing(double over_m, const std::string& low, const std::string& high) {
  return fmt::format(
      "rodeira: world/2\nname: crossing\nground: {{kind: plane}}\nroads:\n"
      "  - {{id: low, axis: [line: {{length_m: 300}}], z_m: 0, section: {{template: rural}}{}}}\n"
      "  - {{id: high, start: {{x_m: 150, y_m: -100, heading_deg: 90}}, axis: [line: {{length_m: 200}}], z_m: {}, "
      "section: {{template: rural}}{}}}\n",
      low, over_m, high);
}

// Of the places looked at every metre of `high`, with lanes 3.5 m to either side, those at s = 97 m are the first
// over a lane of `low`, which begins at y = -3.5 m.
TEST(Passes, ARoadOverAnotherWithoutABridgeIsToldWithBothStations) {
  EXPECT_THAT(Said(Crossing(6.0, "", "")),
              ElementsAre(AllOf(HasSubstr("w.yaml:6: road 'high' at s = 97.0 m lies 6.0 m over road 'low' at s = 1"),
                                HasSubstr("neither has the upper one `bridges`"))));
}

TEST(Passes, UnderABridgeOrInATunnelIsNone) {
  EXPECT_THAT(Said(Crossing(6.0, "", ", bridges: [{from_s_m: 80, to_s_m: 120}]")), IsEmpty());
  // A bridge that ends before the other road does is not enough.
  EXPECT_THAT(Said(Crossing(6.0, "", ", bridges: [{from_s_m: 80, to_s_m: 99.5}]")),
              ElementsAre(HasSubstr("road 'high' at s = 100.0 m lies 6.0 m over")));
  // The plane that the upper one stands on is what the lower one needs to be under: see below.
  const std::string tunnel = fmt::format(
      "rodeira: world/2\nname: crossing\nground: {{kind: plane, z_m: 6}}\nroads:\n  - {{id: low, axis: [line: "
      "{{length_m: 300}}], z_m: 0, section: {{template: rural}}, tunnels: [{{from_s_m: 100, to_s_m: 200}}]}}\n"
      "  - {{id: high, start: {{x_m: 150, y_m: -100, heading_deg: 90}}, axis: [line: {{length_m: 200}}], z_m: 6, "
      "section: {{template: rural}}}}\n");
  EXPECT_THAT(Said(tunnel), IsEmpty());
}

// The crown of 2.5 % lies 1.75 * 0.025 = 0.04 m over the lanes' middles, and 3.4 * 0.025 = 0.085 m over their edges:
// the middles are the nearest to the terrain.
TEST(Passes, ATunnelWithoutAHillIsToldWithItsStations) {
  const auto world = [](double z_m) {
    return fmt::format(
        "rodeira: world/2\nname: t\nground: {{kind: plane, z_m: {}}}\nroads:\n  - {{id: a, axis: [line: {{length_m: "
        "300}}], z_m: 0, section: {{template: rural}}, tunnels: [{{from_s_m: 100, to_s_m: 200}}]}}\n",
        z_m);
  };
  EXPECT_THAT(Said(world(0.0)),
              ElementsAre(AllOf(HasSubstr("w.yaml:5: the tunnel of road 'a' from s = 100.0 to 200.0 m has the terrain "
                                          "only 0.04 m over its road at s = 100.0 m"),
                                HasSubstr("a hill of some metres"))));
  EXPECT_THAT(Said(world(-0.2)), IsEmpty());  // in the open
  EXPECT_THAT(Said(world(0.3)), ElementsAre(HasSubstr("has the terrain only 0.34 m over its road")));
  EXPECT_THAT(Said(world(3.0)), IsEmpty());
}

// A loop of three quarters of a circle of 100 m radius, which comes back over itself: east along y = 0 from x = -200 to
// 100, round to the left, and south along x = 0. The lower stretch has its lanes at y = -3.5 to 3.5, so that the upper
// one, 8 m above it, which passes y = 100 at s = 300 + 471.24 m, is over it from s = 867.74 m on; of the places looked
// at every 0.9993 m s = 868.4 m is the first behind that.
TEST(Passes, ARoadOverItselfIsToldToo) {
  const std::string text =
      "rodeira: world/2\nname: loop\nground: {kind: plane}\nroads:\n  - id: loop\n    start: {x_m: -200, y_m: 0, "
      "heading_deg: 0}\n"
      "    axis: [line: {length_m: 300}, arc: {turn_deg: 270, radius_m: 100}, line: {length_m: 300}]\n"
      "    vertical: [{s_m: 0, z_m: 0}, {s_m: 300, z_m: 0, parabola_m: 60}, {s_m: 740, z_m: 8, parabola_m: 60}, {s_m: "
      "1071, z_m: 8}]\n    section: {template: rural}\n";
  EXPECT_THAT(Said(text),
              Contains(Names("w.yaml:5: road 'loop' at s = 868.4 m lies 8.0 m over itself at s = 20 … `bridges`")));
  EXPECT_THAT(Said(text + "    bridges: [{from_s_m: 840, to_s_m: 900}]\n"), Not(Contains(HasSubstr("over itself"))));
}

// The project's own worlds pass over one another by bridges, and have hills over their tunnels.
TEST(Passes, TheProjectsWorldsHaveNone) {
  for (const char* world : {"haste", "motorway", "n222", "example/world"}) {
    const auto file = std::filesystem::path(SourceDir()) / "configs/worlds" / (std::string(world) + ".yaml");
    for (const std::string& said : WorldWarnings(file))
      EXPECT_THAT(said, Not(testing::AnyOf(HasSubstr("neither has the upper one"), HasSubstr("the tunnel of road"))))
          << said;
  }
}

}  // namespace
}  // namespace rodeira::road
