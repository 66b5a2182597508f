// SPDX-License-Identifier: Apache-2.0
// Where links that are missing are found by geometry and where not, turning loops at one road's end, and U-turns: at
// their limits. Places and gaps are computed by hand.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::string Lane(int id, const std::string& links, double width_m, const char* type = "driving") {
  return fmt::format(
      "<lane id=\"{}\" type=\"{}\"><link>{}</link><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/></lane>", id,
      type, links, width_m);
}
std::string Line(double x_m, double y_m, double heading_rad, double length_m) {
  return fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"><line/></geometry>", x_m, y_m,
                     heading_rad, length_m);
}
std::string Arc(double x_m, double y_m, double heading_rad, double length_m, double curvature_1pm) {
  return fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"><arc curvature=\"{}\"/></geometry>",
                     x_m, y_m, heading_rad, length_m, curvature_1pm);
}

std::vector<std::string> KindsOf(const Import& import) {
  std::vector<std::string> kinds;
  for (const Finding& finding : OneEachKind(import.warnings)) {
    if (finding.repair.kind != RepairKind::kNone) kinds.push_back(finding.repair.Name());
  }
  return kinds;
}

// Road A leads to a junction, from which the way W leads on eastward to x = 120. Its lane says nothing of where it
// goes.
class FoundLinks : public testing::Test {
 protected:
  std::string way_links_ = R"(<predecessor elementType="road" elementId="A" contactPoint="end"/>)"
                           R"(<successor elementType="road" elementId="B" contactPoint="start"/>)";
  // The roads that begin behind the way.
  RoadText Out(const std::string& id, double y_m, double heading_rad) const {
    RoadText out;
    out.id = id, out.left = "", out.right = Lane(-1, "", kWide_m);
    out.link = R"(<predecessor elementType="junction" elementId="5"/>)";
    out.geometry = Line(120, y_m, heading_rad, 100);
    return out;
  }
  Import With(const std::string& out) const {
    RoadText in, way;
    in.id = "A", in.left = "", in.right = Lane(-1, "", kWide_m);
    in.link = R"(<successor elementType="junction" elementId="5"/>)";
    way.id = "W", way.length = 20, way.attributes = "junction=\"5\"", way.left = "";
    way.link = way_links_, way.geometry = Line(100, 0, 0, 20);
    way.right = Lane(-1, "<predecessor id=\"-1\"/>", kWide_m);
    return MustImport(
        Document(in.Text() + way.Text() + out +
                 R"(<junction id="5"><connection id="0" incomingRoad="A" connectingRoad="W" contactPoint="start">)"
                 R"(<laneLink from="-1" to="-1"/></connection></junction>)"));
  }
  static std::size_t Beyond(const Import& import) {
    return import.network->AtEnd({*import.network->FindRoad("W"), 0, -1}).size();
  }
  static void ExpectFound(const Import& import) {
    EXPECT_THAT(KindsOf(import), Contains("lane.link_found"));
    EXPECT_EQ(Beyond(import), 1u);
    EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
    EXPECT_TRUE(MustImport(import.repaired_text).repaired_text.empty());
  }
  // Told, and nothing is done.
  static void ExpectTold(const Import& import) {
    EXPECT_THAT(KindsOf(import), Not(Contains("lane.link_found")));
    EXPECT_EQ(Beyond(import), 0u);
    std::vector<std::string> told;
    for (const Finding& finding : import.warnings) told.push_back(finding.Text());
    EXPECT_THAT(told,
                Contains(AllOf(HasSubstr("rodeira.lane.dead_end: road W, lane -1, s 20"), Not(HasSubstr("repaired")))));
  }
  static constexpr double kWide_m = 3.0;
};

TEST_F(FoundLinks, UpToADecimetreAside) {
  for (const double side : {1.0, -1.0}) {
    ExpectFound(With(Out("B", side * 0.09, 0.0).Text()));
    ExpectTold(With(Out("B", side * 0.11, 0.0).Text()));
  }
}

// With a kink about the edge that both lanes share the other edge is 3 m * 2 sin(kink / 2) off.
TEST_F(FoundLinks, UpToADecimetreByAKink) {
  const double limit_rad = 2.0 * std::asin(0.05 / kWide_m);
  for (const double side : {1.0, -1.0}) {
    ExpectFound(With(Out("B", 0.0, side * 0.97 * limit_rad).Text()));
    ExpectTold(With(Out("B", 0.0, side * 1.03 * limit_rad).Text()));
  }
}

// The lane that lies there leads back into the junction.
TEST_F(FoundLinks, NotAgainstTraffic) {
  RoadText against = Out("B", 0.0, 0.0);
  against.attributes = "junction=\"-1\" rule=\"LHT\"";
  ExpectTold(With(against.Text()));
}

TEST_F(FoundLinks, OfTwoCandidatesNone) {
  way_links_ = R"(<predecessor elementType="road" elementId="A" contactPoint="end"/>)";
  ExpectFound(With(Out("B", 0.0, 0.0).Text()));
  ExpectTold(With(Out("B", 0.0, 0.0).Text() + Out("C", 0.05, 0.0).Text()));
}

// A road of two lanes, 4 m apart, with a loop of radius r at its end that begins at the one and ends at the other: a
// half circle of its own lane's inner edge.
Import Loop(double kink_rad, bool in_junction) {
  constexpr double kMedian_m = 4.0, kWide_m = 3.0;
  const double radius_m = 0.5 * kMedian_m / std::cos(kink_rad), turn_rad = M_PI + 2.0 * kink_rad;
  RoadText road, loop;
  const char* last = in_junction ? "" : "<successor id=\"-1\"/>";
  road.left = Lane(2, last, kWide_m) + Lane(1, "", 0.5 * kMedian_m, "median");
  road.right = Lane(-1, "", 0.5 * kMedian_m, "median") + Lane(-2, last, kWide_m);
  road.link = in_junction ? R"(<successor elementType="junction" elementId="5"/>)"
                          : R"(<successor elementType="road" elementId="2" contactPoint="start"/>)";
  loop.id = "2", loop.length = radius_m * turn_rad, loop.left = "";
  loop.attributes = in_junction ? "junction=\"5\"" : "junction=\"-1\"";
  loop.geometry = Arc(100, -0.5 * kMedian_m, -kink_rad, loop.length, 1.0 / radius_m);
  loop.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>)"
              R"(<successor elementType="road" elementId="1" contactPoint="end"/>)";
  loop.right = Lane(-1, "<predecessor id=\"-2\"/><successor id=\"2\"/>", kWide_m);
  std::string text = road.Text() + loop.Text();
  if (in_junction)
    text += R"(<junction id="5"><connection id="0" incomingRoad="1" connectingRoad="2" contactPoint="start">)"
            R"(<laneLink from="-2" to="-1"/></connection></junction>)";
  return MustImport(Document(text));
}

TEST(LoopAtARoadsEnd, IsDrivenByItsLanes) {
  const Import import = Loop(0.0, false);
  EXPECT_THAT(KindsOf(import), Contains("road.links_by_lanes"));
  using network::End;
  EXPECT_THAT(import.network->AtEnd({0, 0, -2}), ElementsAre(network::LaneEnd{{1, 0, -1}, End::kStart}));
  EXPECT_THAT(import.network->AtEnd({1, 0, -1}), ElementsAre(network::LaneEnd{{0, 0, 2}, End::kEnd}));
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
}

// A car drives a U-turn with a kink of up to 0.35 rad at either end. Beyond that the way is dropped, and the road ends.
TEST(UTurn, IsKeptUpToAKinkThatACarDrives) {
  for (const double kink_rad : {0.1, 0.34}) {
    const Import kept = Loop(kink_rad, true);
    EXPECT_THAT(KindsOf(kept), ElementsAre("lane.gap_driven")) << kink_rad;
    EXPECT_TRUE(kept.network->FindRoad("2"));
    EXPECT_EQ(kept.network->AtEnd({0, 0, -2}).size(), 1u);
    EXPECT_TRUE(kept.repaired_text.empty());
  }
  const Import dropped = Loop(0.36, true);
  EXPECT_THAT(KindsOf(dropped), Contains("connection.road_dropped"));
  EXPECT_FALSE(dropped.network->FindRoad("2"));
  EXPECT_TRUE(dropped.network->AtEnd({0, 0, -2}).empty());
}

}  // namespace
}  // namespace rodeira::opendrive
