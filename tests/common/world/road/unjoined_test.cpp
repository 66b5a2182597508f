// SPDX-License-Identifier: Apache-2.0
// Roads that lie on one another without a junction: named with both stations, which are computed by hand here.
#include "common/world/road/unjoined.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/core/base/files.hpp"
#include "common/world/road/network_world.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"

namespace rodeira::road {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// East from the origin for 200 m, and north across it at x = 150 from y = -50.05.
std::string Crossing(double over_m, const std::string& more = "", const std::string& link = "") {
  return fmt::format(
      "rodeira: world/2\nname: crossing\nground: {{kind: plane}}\nroads:\n"
      "  - {{id: a, axis: [line: {{length_m: 200}}], z_m: 0, section: {{template: rural}}{}}}\n"
      "  - {{id: b, start: {{x_m: 150, y_m: -50.05, heading_deg: 90}}, axis: [line: {{length_m: 100}}], z_m: {}, "
      "section: {{template: rural}}}}\n{}",
      link, over_m, more);
}

std::vector<std::string> Of(const std::string& text) {
  const auto world = World::Parse(text, "made.yaml");
  EXPECT_TRUE(world.ok()) << world.error().Text();
  std::vector<std::string> said;
  for (const OfRoad& told : DescribeOverlaps(*world.value()->network(), true)) said.push_back(told.text);
  return said;
}

// The lanes of b lie between x = 146.5 and 153.5; of the places looked at every metre s = 147 m is the first, there in
// the middle of the left lane, y = 1.75 m.
TEST(Overlaps, OfACrossingAreNamedOnceWithBothStations) {
  // Both have crowns of 2.5 %: 1.75 m beside the axis of a, 3 m beside that of b.
  EXPECT_THAT(Of(Crossing(0.3)),
              ElementsAre("road 'a' at s = 147.0 m and road 'b' at s = 51.8 m lie on one another, 0.27 m apart in "
                          "height, and neither a junction nor a link joins them there"));
  EXPECT_THAT(Of(Crossing(1.9)), ElementsAre(HasSubstr("1.87 m apart")));
  EXPECT_THAT(Of(Crossing(2.1)), IsEmpty());
}

TEST(Overlaps, OfAJunctionAreNone) {
  EXPECT_THAT(Of(Crossing(0.0, "junctions:\n  - {id: x, roads: [{road: a, s_m: 150}, {road: b, s_m: 50}]}\n")),
              IsEmpty());
  // Beside the junction at x = 50 the roads cross once more; the part of 'a' behind it has the road's stations.
  EXPECT_THAT(Of(Crossing(0.0,
                          "  - {id: c, start: {x_m: 50, y_m: -50, heading_deg: 90}, axis: [line: {length_m: 100}], "
                          "z_m: 0, section: {template: rural}}\n"
                          "junctions:\n  - {id: x, roads: [{road: a, s_m: 50}, {road: c, s_m: 50}]}\n")),
              ElementsAre(testing::MatchesRegex("road 'a' at s = 14[67]\\.[0-9] m and road 'b' at s = 51\\.8 m .*")));
}

TEST(Overlaps, OfRoadsThatGoOnAreNone) {
  EXPECT_THAT(
      Of(Crossing(
          5.0,
          "  - {id: c, start: {x_m: 200, y_m: 0}, axis: [line: {length_m: 50}], z_m: 0, section: {template: rural}}\n",
          ", successor: {road: c}")),
      IsEmpty());
}

TEST(Overlaps, OfRoadsThatOnlyTouchAreToldSo) {
  const std::string on =
      "  - {id: c, start: {x_m: 200, y_m: 0}, axis: [line: {length_m: 50}], z_m: 0, section: {template: rural}}\n";
  EXPECT_THAT(Of(Crossing(5.0, on)),
              ElementsAre(Names("road 'a' at s = 200.0 m … road 'c' at s = 0.0 m touch end to end … 0.00 m")));
  const std::string over =
      "  - {id: c, start: {x_m: 199, y_m: 0}, axis: [line: {length_m: 50}], z_m: 0, section: {template: rural}}\n";
  EXPECT_THAT(Of(Crossing(5.0, over)), ElementsAre(HasSubstr("lie on one another")));
  const std::string from_the_start =
      "  - {id: c, start: {x_m: 0, y_m: 0}, axis: [line: {length_m: 50}], z_m: 0, section: {template: rural}}\n";
  EXPECT_THAT(Of(Crossing(5.0, from_the_start)), ElementsAre(HasSubstr("lie on one another")));
}

TEST(Overlaps, AreWarningsOfWorldCheckOfBothKindsOfFiles) {
  const cli::TemporaryFolder folder;
  const auto yaml = folder.path() / "w.yaml", xodr = folder.path() / "w.xodr";
  ASSERT_TRUE(base::WriteWhole(yaml, Crossing(0.0)).ok());
  EXPECT_THAT(WorldWarnings(yaml), ElementsAre(Names("w.yaml:5: road 'a' at s = 147.0 m … road 'b' at s = 51.8 m")));
  const auto road = [](const char* id, const char* geometry) {
    return fmt::format(
        "<road id=\"{}\" length=\"100\" junction=\"-1\"><planView>{}</planView><lanes><laneSection "
        "s=\"0\"><center><lane id=\"0\" type=\"none\"/></center><right><lane id=\"-1\" type=\"driving\">"
        "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes></road>",
        id, geometry);
  };
  ASSERT_TRUE(base::WriteWhole(
                  xodr, "<OpenDRIVE><header revMajor=\"1\" revMinor=\"7\"/>" +
                            road("1", "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"100\"><line/></geometry>") +
                            road("2",
                                 "<geometry s=\"0\" x=\"49.5\" y=\"-50.05\" hdg=\"1.5707963267948966\" "
                                 "length=\"100\"><line/></geometry>") +
                            "</OpenDRIVE>")
                  .ok());
  // Its lane lies between x = 49.5 and 53; the middle of road 1's, y = -1.75 m, is the first place.
  EXPECT_THAT(CheckNetwork(xodr, false).warnings,
              Contains(Names("road '1' at s = 50.0 m … road '2' at s = 48.3 m … 0.00 m apart")));
}

}  // namespace
}  // namespace rodeira::road
