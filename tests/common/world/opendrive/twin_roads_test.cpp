// SPDX-License-Identifier: Apache-2.0
// Several roads with one id. The oracle is the same file with ids of their own: the repaired file is that, byte by
// byte.
#include <gmock/gmock.h>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string Link(const char* word, const std::string& id, const char* contact) {
  return fmt::format("<{} elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/>", word, id, contact);
}

// A road of 100 m eastward from (x, y), with a lane on the right that goes on in both directions.
std::string Road(const std::string& id, double x_m, double y_m, const std::string& links,
                 const std::string& junction = "-1") {
  RoadText road;
  road.id = id, road.link = links, road.left = "", road.attributes = "junction=\"" + junction + "\"";
  road.geometry =
      fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"0\" length=\"100\"><line/></geometry>", x_m, y_m);
  const auto lane = [&](const char* word) {
    return links.find(word) == std::string::npos ? "" : fmt::format("<{} id=\"-1\"/>", word);
  };
  road.right = fmt::format(
      "<lane id=\"-1\" type=\"driving\"><link>{}{}</link><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" "
      "d=\"0\"/></lane>",
      lane("predecessor"), lane("successor"));
  return road.Text();
}

// Three roads one behind the other at some y; `middle` is the id of the one in the middle.
std::string Chain(double y_m, const std::string& first, const std::string& middle, const std::string& last) {
  return Road(first, 0, y_m, Link("successor", middle, "start")) +
         Road(middle, 100, y_m, Link("predecessor", first, "end") + Link("successor", last, "start")) +
         Road(last, 200, y_m, Link("predecessor", middle, "end"));
}

std::vector<std::string> Kinds(const Import& import) {
  std::vector<std::string> kinds;
  for (const Finding& finding : OneEachKind(import.warnings)) {
    if (finding.repair.kind != RepairKind::kNone) kinds.push_back(finding.repair.Name());
  }
  return kinds;
}

void ExpectRenamed(const std::string& with_twins, const std::string& good) {
  ASSERT_TRUE(MustImport(good).repaired_text.empty());
  const Import import = MustImport(with_twins);
  ASSERT_NE(import.network, nullptr);
  EXPECT_THAT(Kinds(import), ElementsAre("road.renamed"));
  EXPECT_EQ(import.repaired_text, good);
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
  EXPECT_FALSE(Read(with_twins, "sample.xodr", Tolerance::Strict()).value().errors.empty());
}

TEST(TwinRoads, GetIdsOfTheirOwnWithTheLinksThatMeetThem) {
  ExpectRenamed(Document(Chain(0, "1", "5", "2") + Chain(50, "3", "5", "4")),
                Document(Chain(0, "1", "5", "2") + Chain(50, "3", "6", "4")));
  ExpectRenamed(
      Document(Chain(0, "a", "west", "b") + Chain(50, "c", "west", "d") + Chain(100, "west_2", "west", "f")),
      Document(Chain(0, "a", "west", "b") + Chain(50, "c", "west_3", "d") + Chain(100, "west_2", "west_4", "f")));
}

// One behind the other, as a road that was cut in two: each goes on into the other.
TEST(TwinRoads, OneBehindTheOtherAreKept) {
  const auto two = [](const std::string& second) {
    return Document(Road("7", 0, 0, Link("successor", second, "start")) +
                    Road(second, 100, 0, Link("predecessor", "7", "end")));
  };
  ExpectRenamed(two("7"), two("8"));
}

// Two junctions of one way each: roads into them and ways through them have ids twice.
TEST(TwinRoads, OfJunctionsAreMetByTheirConnections) {
  const auto file = [](const std::string& in, const std::string& way, bool turned) {
    const auto junction = [](const std::string& id, const std::string& from, const std::string& over) {
      return fmt::format(
          "<junction id=\"{}\" name=\"\"><connection id=\"0\" incomingRoad=\"{}\" connectingRoad=\"{}\" "
          "contactPoint=\"start\"><laneLink from=\"-1\" to=\"-1\"/></connection></junction>\n",
          id, from, over);
    };
    const auto roads = [](double y_m, const std::string& from, const std::string& over, const std::string& to,
                          const std::string& id) {
      const std::string at = fmt::format("elementType=\"junction\" elementId=\"{}\"/>", id);
      return Road(from, 0, y_m, "<successor " + at) +
             Road(over, 100, y_m, Link("predecessor", from, "end") + Link("successor", to, "start"), id) +
             Road(to, 200, y_m, "<predecessor " + at);
    };
    const std::string one = junction("80", "1", "2"), two = junction("90", in, way);
    return Document(roads(0, "1", "2", "3", "80") + roads(500, in, way, "4", "90") + (turned ? two + one : one + two));
  };
  for (const bool turned : {false, true}) ExpectRenamed(file("1", "2", turned), file("5", "6", turned));
}

// The same road twice, and two that begin at one place: no link tells which one is meant.
TEST(TwinRoads, ThatNoLinkTellsApartAreLeftOut) {
  const std::string chain = Chain(0, "1", "5", "2");
  const std::string again = Road("5", 100, 0, Link("predecessor", "1", "end") + Link("successor", "2", "start"));
  const Import same = MustImport(Document(chain + again));
  EXPECT_THAT(Kinds(same), ElementsAre("road.left_out"));
  EXPECT_EQ(same.network->roads().size(), 3u);
  RoadText aside;
  aside.id = "5", aside.geometry = "<geometry s=\"0\" x=\"100\" y=\"0\" hdg=\"1.5\" length=\"100\"><line/></geometry>";
  EXPECT_THAT(Kinds(MustImport(Document(chain + aside.Text()))), ElementsAre("road.left_out"));
}

}  // namespace
}  // namespace rodeira::opendrive
