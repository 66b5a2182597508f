// SPDX-License-Identifier: Apache-2.0
// Wrong, missing and empty links of roads that follow one another, in all ways in which a file may draw the same roads:
// along or against traffic, right-hand or left-hand, in one section or in two, with the network turned. Traffic goes
// from road A over B to C, whatever the file says wrongly; so the expected lanes are known by how the roads are drawn.
#include <gmock/gmock.h>

#include <cmath>
#include <tuple>

#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using network::End;
using network::LaneEnd;
using testing::AnyOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kTurned_rad = 0.7;  // of the whole network
constexpr double kWide_m = 3.25;

struct Drawn {
  bool left_hand, a_against, b_against, two_sections;
  bool oncoming = false;  // a lane of the other direction, without links
};

// A road along x of the turned frame, with one lane of traffic towards larger x.
struct Piece {
  std::string id;
  double x_m, length_m;
  bool against;  // its s runs against x

  // The lane of traffic towards larger x.
  int Lane(bool left_hand) const { return against == left_hand ? -1 : 1; }
  End East() const { return against ? End::kStart : End::kEnd; }
  End West() const { return against ? End::kEnd : End::kStart; }
};
const char* EndWord(End end) { return end == End::kEnd ? "end" : "start"; }
const char* LinkWord(End end) { return end == End::kEnd ? "successor" : "predecessor"; }

// What a lane says of both ends of its road, and of the joint of its two sections.
struct LaneLinks {
  std::string west, east;  // elements <predecessor> or <successor>
  bool inner = true;
};

std::string TextOf(const Piece& piece, const Drawn& drawn, const std::string& road_links, const LaneLinks& links,
                   const std::string& attributes = "junction=\"-1\"") {
  const double x = piece.against ? piece.x_m + piece.length_m : piece.x_m;
  const auto lane = [&](int id, bool first, bool last) {
    const bool eastward = id == piece.Lane(drawn.left_hand);
    if (!eastward && !drawn.oncoming) return std::string();
    std::string text;
    const std::string &at_start = piece.against ? links.east : links.west,
                      &at_end = piece.against ? links.west : links.east;
    if (eastward && first) text += at_start;
    if (links.inner && !first) text += fmt::format("<predecessor id=\"{}\"/>", id);
    if (links.inner && !last) text += fmt::format("<successor id=\"{}\"/>", id);
    if (eastward && last) text += at_end;
    return fmt::format(
        "<lane id=\"{}\" type=\"driving\"><link>{}</link><width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" "
        "d=\"0\"/></lane>",
        id, text, kWide_m);
  };
  const auto section = [&](double s_m, bool first, bool last) {
    return fmt::format(
        "<laneSection s=\"{}\"><left>{}</left><center><lane id=\"0\" type=\"none\"/></center>"
        "<right>{}</right></laneSection>\n",
        s_m, lane(1, first, last), lane(-1, first, last));
  };
  const bool two = drawn.two_sections;
  return fmt::format(
      "<road id=\"{}\" length=\"{}\" rule=\"{}\" {}>\n<link>{}</link>\n<planView><geometry s=\"0\" x=\"{}\" y=\"{}\" "
      "hdg=\"{}\" length=\"{}\"><line/></geometry></planView>\n<lanes>{}{}</lanes></road>\n",
      piece.id, piece.length_m, drawn.left_hand ? "LHT" : "RHT", attributes, road_links, x * std::cos(kTurned_rad),
      x * std::sin(kTurned_rad), kTurned_rad + (piece.against ? 3.14159265358979312 : 0.0), piece.length_m,
      section(0.0, true, !two), two ? section(0.4 * piece.length_m, false, true) : "");
}

std::string RoadLink(End at, const std::string& id, const char* contact) {
  return fmt::format("<{} elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/>", LinkWord(at), id, contact);
}
std::string LaneLink(End at, const std::string& id) { return fmt::format("<{} id=\"{}\"/>", LinkWord(at), id); }

class LinksRepair : public testing::TestWithParam<std::tuple<bool, bool, bool, bool>> {
 protected:
  Drawn drawn_{std::get<0>(GetParam()), std::get<1>(GetParam()), std::get<2>(GetParam()), std::get<3>(GetParam())};
  const Piece a_{"A", 0.0, 80.0, drawn_.a_against}, b_{"B", 80.0, 40.0, drawn_.b_against};
  const std::string lane_a_ = std::to_string(a_.Lane(drawn_.left_hand)),
                    lane_b_ = std::to_string(b_.Lane(drawn_.left_hand));
  // As they should be.
  std::string a_road_ = RoadLink(a_.East(), "B", EndWord(b_.West())),
              b_road_ = RoadLink(b_.West(), "A", EndWord(a_.East()));
  LaneLinks a_links_{"", LaneLink(a_.East(), lane_b_)}, b_links_{LaneLink(b_.West(), lane_a_), ""};

  Import Made(const std::string& more = "") const {
    return MustImport(Document(TextOf(a_, drawn_, a_road_, a_links_) + TextOf(b_, drawn_, b_road_, b_links_) + more));
  }
  LaneEnd At(const network::Network& network, const Piece& piece, End end) const {
    const auto road = *network.FindRoad(piece.id);
    const auto last = static_cast<std::uint32_t>(network.roads()[road].spec().sections.size()) - 1;
    return {{road, end == End::kEnd ? last : 0, piece.Lane(drawn_.left_hand)}, end};
  }
  static std::vector<LaneEnd> Beyond(const network::Network& network, const LaneEnd& end) {
    const auto ends = end.end == End::kEnd ? network.AtEnd(end.lane) : network.AtStart(end.lane);
    return {ends.begin(), ends.end()};
  }
  static std::vector<std::string> Kinds(const Import& import) {
    std::vector<std::string> kinds;
    for (const Finding& finding : OneEachKind(import.warnings)) {
      if (finding.repair.kind != RepairKind::kNone) kinds.push_back(finding.repair.Name());
    }
    return kinds;
  }
  // Traffic of A goes on into B there, and nowhere else; the repaired file says so by itself.
  void ExpectWhole(const Import& import) const {
    ASSERT_NE(import.network, nullptr);
    EXPECT_THAT(Beyond(*import.network, At(*import.network, a_, a_.East())),
                ElementsAre(At(*import.network, b_, b_.West())));
    const auto lane = network::LaneKey(At(*import.network, a_, a_.East()).lane);
    EXPECT_EQ(import.network->Successors(lane).size(), 1u);
    if (import.repaired_text.empty()) return;
    const Import again = MustImport(import.repaired_text);
    EXPECT_TRUE(again.repaired_text.empty()) << "a second repair changes the file";
    EXPECT_THAT(Beyond(*again.network, At(*again.network, a_, a_.East())),
                ElementsAre(At(*again.network, b_, b_.West())));
  }
};

TEST_P(LinksRepair, GoodLinksStay) {
  const Import import = Made();
  ExpectWhole(import);
  EXPECT_TRUE(import.repaired_text.empty());
  EXPECT_THAT(Kinds(import), IsEmpty());
}

TEST_P(LinksRepair, WrongEndNamedByOneRoad) {
  a_road_ = RoadLink(a_.East(), "B", EndWord(b_.East()));
  const Import import = Made();
  ExpectWhole(import);
  EXPECT_THAT(Kinds(import), Contains("road.contact_turned"));
}

TEST_P(LinksRepair, WrongEndNamedByBothRoads) {
  a_road_ = RoadLink(a_.East(), "B", EndWord(b_.East())), b_road_ = RoadLink(b_.West(), "A", EndWord(a_.West()));
  const Import import = Made();
  ExpectWhole(import);
  EXPECT_THAT(Kinds(import), Contains("road.contact_turned"));
}

TEST_P(LinksRepair, LaneOfTheOncomingTrafficNamed) {
  drawn_.oncoming = true;
  a_links_.east = LaneLink(a_.East(), std::to_string(-b_.Lane(drawn_.left_hand)));
  const Import import = Made();
  ExpectWhole(import);
}

TEST_P(LinksRepair, LaneThatIsNotThereNamed) {
  a_links_.east = LaneLink(a_.East(), "-7"), b_links_.west = "";
  const Import import = Made();
  ExpectWhole(import);
  EXPECT_THAT(Kinds(import), ElementsAre("lane.link_dropped", "lane.link_found"));
}

TEST_P(LinksRepair, NoLaneLinks) {
  a_links_.east = "", b_links_.west = "";
  const Import import = Made();
  ExpectWhole(import);
  EXPECT_THAT(Kinds(import), ElementsAre("lane.link_found"));
  EXPECT_EQ(import.before->share(), 0.0);
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
}

TEST_P(LinksRepair, NoLinksBetweenTheSections) {
  a_links_.inner = false, b_links_.inner = false;
  const Import import = Made();
  ExpectWhole(import);
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
  EXPECT_EQ(Kinds(import).size(), drawn_.two_sections ? 1u : 0u);
}

TEST_P(LinksRepair, EmptyLaneLinks) {
  for (const std::string attribute : {"", " id=\"\"", " id=\"none\""}) {
    a_links_.east = fmt::format("<{}{}/>", LinkWord(a_.East()), attribute), b_links_.west = "";
    const Import import = Made();
    ExpectWhole(import);
    EXPECT_THAT(Kinds(import), Contains("lane.link_found"));
  }
}

TEST_P(LinksRepair, OnlyTheOtherLaneSaysSo) {
  a_links_.east = "";
  ExpectWhole(Made());
}

// A road or junction that is not in the file, or that nothing names: the road ends there, and all of it is reached.
TEST_P(LinksRepair, TheNextIsNotInTheFile) {
  const char* word = LinkWord(b_.East());
  for (const std::string& link :
       {fmt::format("<{} elementType=\"road\" elementId=\"99\" contactPoint=\"start\"/>", word),
        fmt::format("<{} elementType=\"junction\" elementId=\"99\"/>", word),
        fmt::format("<{} elementType=\"road\" elementId=\"\" contactPoint=\"end\"/>", word), fmt::format("<{}/>", word),
        fmt::format("<{} elementType=\"\" elementId=\"7\"/>", word)}) {
    const std::string before = b_road_;
    b_road_ = before + link, b_links_.east = LaneLink(b_.East(), "-1");
    const Import import = Made();
    ExpectWhole(import);
    EXPECT_TRUE(Beyond(*import.network, At(*import.network, b_, b_.East())).empty()) << link;
    EXPECT_EQ(ReachOf(*import.network).share(), 1.0) << link;
    EXPECT_THAT(Kinds(import), Contains(AnyOf("road.ended", "predecessor.dropped", "successor.dropped"))) << link;
    b_road_ = before;
  }
}

INSTANTIATE_TEST_SUITE_P(AsDrawn, LinksRepair,
                         testing::Combine(testing::Bool(), testing::Bool(), testing::Bool(), testing::Bool()));

// The same with B as a connecting road between A and C.
class WaysRepair : public LinksRepair {
 protected:
  const Piece c_{"C", 120.0, 60.0, !drawn_.a_against};
  const std::string lane_c_ = std::to_string(c_.Lane(drawn_.left_hand));
  std::string c_road_ = fmt::format("<{} elementType=\"junction\" elementId=\"5\"/>", LinkWord(c_.West()));
  std::string connection_ = fmt::format(
      "<connection id=\"0\" incomingRoad=\"A\" connectingRoad=\"B\" contactPoint=\"{}\"><laneLink from=\"{}\" "
      "to=\"{}\"/></connection>",
      EndWord(b_.West()), lane_a_, lane_b_);
  std::string junction_ = "5";

  void SetUp() override {
    a_road_ = fmt::format("<{} elementType=\"junction\" elementId=\"5\"/>", LinkWord(a_.East()));
    a_links_.east = "";
    b_road_ = RoadLink(b_.West(), "A", EndWord(a_.East())) + RoadLink(b_.East(), "C", EndWord(c_.West()));
    b_links_.east = LaneLink(b_.East(), lane_c_);
  }
  Import MadeWay() const {
    return MustImport(Document(
        TextOf(a_, drawn_, a_road_, a_links_) + TextOf(b_, drawn_, b_road_, b_links_, "junction=\"5\"") +
        TextOf(c_, drawn_, c_road_, {}) + fmt::format("<junction id=\"{}\">{}</junction>\n", junction_, connection_)));
  }
  void ExpectWay(const Import& import) const {
    ExpectWhole(import);
    EXPECT_THAT(Beyond(*import.network, At(*import.network, b_, b_.East())),
                ElementsAre(At(*import.network, c_, c_.West())));
  }
};

TEST_P(WaysRepair, GoodLinksStay) {
  const Import import = MadeWay();
  ExpectWay(import);
  EXPECT_TRUE(import.repaired_text.empty());
}

TEST_P(WaysRepair, WrongEndsNamedByTheWay) {
  b_road_ = RoadLink(b_.West(), "A", EndWord(a_.West())) + RoadLink(b_.East(), "C", EndWord(c_.East()));
  ExpectWay(MadeWay());
}

TEST_P(WaysRepair, WrongEndOfTheWayNamedByItsConnection) {
  const std::string right = fmt::format("contactPoint=\"{}\"", EndWord(b_.West())),
                    wrong = fmt::format("contactPoint=\"{}\"", EndWord(b_.East()));
  connection_.replace(connection_.find(right), right.size(), wrong);
  ExpectWay(MadeWay());
}

TEST_P(WaysRepair, WrongLaneNamedByItsConnection) {
  drawn_.oncoming = true;
  const std::string right = fmt::format("to=\"{}\"", lane_b_),
                    wrong = fmt::format("to=\"{}\"", -b_.Lane(drawn_.left_hand));
  connection_.replace(connection_.find(right), right.size(), wrong);
  ExpectWay(MadeWay());
}

TEST_P(WaysRepair, TheWaysLanesHaveNoLinks) {
  b_links_.west = b_links_.east = "";
  const Import import = MadeWay();
  ExpectWay(import);
  EXPECT_THAT(Kinds(import), ElementsAre("lane.link_found"));
}

TEST_P(WaysRepair, TheWaySaysNothingOfWhereItLeads) {
  b_links_.east = "", b_road_ = RoadLink(b_.West(), "A", EndWord(a_.East()));
  const Import import = MadeWay();
  ExpectWay(import);
  EXPECT_THAT(Kinds(import), ElementsAre("lane.link_found"));
}

// Without the junction the way is a road that A goes on into.
TEST_P(WaysRepair, TheJunctionIsNotInTheFile) {
  junction_ = "6";
  const Import import = MadeWay();
  ExpectWay(import);
  EXPECT_THAT(Kinds(import), Contains("road.junction_left"));
}

TEST_P(WaysRepair, ConnectionsNameRoadsThatAreNotInTheFile) {
  connection_ += R"(<connection id="1" incomingRoad="A" connectingRoad="88" contactPoint="start"/>)"
                 R"(<connection id="2" incomingRoad="77" connectingRoad="B" contactPoint="start"/>)";
  const Import import = MadeWay();
  ExpectWay(import);
  EXPECT_THAT(Kinds(import), ElementsAre("connection.dropped"));
}

TEST_P(WaysRepair, ConnectionsNameLanesThatAreNotThere) {
  connection_ += R"(<connection id="1" incomingRoad="A" connectingRoad="B" contactPoint="start">)"
                 R"(<laneLink from="-8" to="-1"/><laneLink from="1" to="9"/></connection>)";
  const Import import = MadeWay();
  EXPECT_THAT(Kinds(import), Contains("connection.lane_link_dropped"));
  EXPECT_THAT(Beyond(*import.network, At(*import.network, b_, b_.East())),
              ElementsAre(At(*import.network, c_, c_.West())));
}

INSTANTIATE_TEST_SUITE_P(AsDrawn, WaysRepair,
                         testing::Combine(testing::Bool(), testing::Bool(), testing::Bool(), testing::Bool()));

// Two roads of one lane each, which meet with a kink that leaves a gap between the lanes' outer edges.
Import TwoLanes(const std::string& first, double x_m, double y_m, double heading_rad, double width_m) {
  RoadText a, b;
  a.geometry = first, a.left = "";
  a.link = R"(<successor elementType="road" elementId="2" contactPoint="start"/>)";
  b.id = "2", b.left = "";
  b.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>)";
  b.geometry = fmt::format("<geometry s=\"0\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"100\"><line/></geometry>", x_m, y_m,
                           heading_rad);
  for (auto& [road, link] : {std::pair(&a, "successor"), std::pair(&b, "predecessor")})
    road->right = fmt::format(
        "<lane id=\"-1\" type=\"driving\"><link><{} id=\"-1\"/></link><width sOffset=\"0\" "
        "a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/></lane>",
        link, width_m);
  return MustImport(Document(a.Text() + b.Text()));
}

// The last decimetre bends with a radius of 2 m, so that the middle of a lane that reaches 4.5 m to the right runs
// backward there. The next road goes on with a kink of 0.03 rad: a car drives over that.
TEST(LanesThatMeet, AreDrivenWhereTheirEdgeFolds) {
  const double turned = 0.05, x = 99.9 + 2.0 * std::sin(turned), y = -2.0 * (1.0 - std::cos(turned));
  const Import import = TwoLanes(
      "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"99.9\"><line/></geometry><geometry s=\"99.9\" x=\"99.9\" "
      "y=\"0\" hdg=\"0\" length=\"0.1\"><arc curvature=\"-0.5\"/></geometry>",
      x, y, -turned - 0.03, 4.5);
  EXPECT_EQ(import.network->AtEnd({0, 0, -1}).size(), 1u);
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
}

// Lanes of 9 m that meet at their inner edge with a kink of 0.35 rad: their middles lie 4.5 m * sin(0.35) = 1.54 m
// apart along the way, which is a wedge and no gap. A gap of 1.54 m between lanes in line is one.
TEST(LanesThatMeet, AreDrivenOverAWedge) {
  const std::string line = "<geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"100\"><line/></geometry>";
  const Import wedge = TwoLanes(line, 100.0, 0.0, 0.35, 9.0), gap = TwoLanes(line, 101.54, 0.0, 0.0, 9.0);
  EXPECT_EQ(wedge.network->AtEnd({0, 0, -1}).size(), 1u);
  EXPECT_TRUE(gap.network->AtEnd({0, 0, -1}).empty());
}

// A lane that is led into and ends 3 m wide in its road's middle, with no lane of traffic behind it: told, and kept.
TEST(LanesThatEnd, AreToldInARoadsMiddle) {
  RoadText road;
  road.left = "";
  road.right =
      "<lane id=\"-1\" type=\"driving\"><link><successor id=\"-1\"/></link><width sOffset=\"0\" a=\"3\" b=\"0\" "
      "c=\"0\" "
      "d=\"0\"/></lane><lane id=\"-2\" type=\"driving\"><link><successor id=\"-2\"/></link><width sOffset=\"0\" "
      "a=\"3\" "
      "b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection><laneSection s=\"40\"><center><lane id=\"0\" "
      "type=\"none\"/></center><right><lane id=\"-1\" type=\"driving\"><link><predecessor id=\"-1\"/></link><width "
      "sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane><lane id=\"-2\" type=\"driving\"><link><predecessor "
      "id=\"-2\"/></link><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection>"
      "<laneSection s=\"70\"><center><lane id=\"0\" type=\"none\"/></center><right><lane id=\"-1\" type=\"driving\">"
      "<width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane><lane id=\"-2\" type=\"shoulder\"><width "
      "sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane>";
  const Import import = MustImport(Document(road.Text()));
  std::vector<std::string> told;
  for (const Finding& finding : import.warnings) told.push_back(finding.Text());
  EXPECT_THAT(told, testing::UnorderedElementsAre(
                        HasSubstr("rodeira.lane.dead_end: road 1, lane -1, s 70: traffic is led onto the lane, and it "
                                  "goes on nowhere; repaired: it goes on as lane -1 of road 1"),
                        testing::EndsWith("rodeira.lane.dead_end: road 1, lane -2, s 70: traffic is led onto the lane, "
                                          "and it goes on nowhere")));
  EXPECT_TRUE(import.network->AtEnd({0, 1, -2}).empty());
}

// Up to a metre of nothing between linked roads is driven, and no more.
TEST(LinkedRoads, AreDrivenAcrossAMetreOfNothing) {
  const Drawn drawn{false, false, false, false};
  for (const double gap_m : {0.31, 0.95, -0.95, 1.05, -1.05}) {
    const Piece a{"A", 0.0, 80.0, false}, b{"B", 80.0 + gap_m, 40.0, false};
    const Import import =
        MustImport(Document(TextOf(a, drawn, RoadLink(End::kEnd, "B", "start"), {"", LaneLink(End::kEnd, "-1")}) +
                            TextOf(b, drawn, RoadLink(End::kStart, "A", "end"), {LaneLink(End::kStart, "-1"), ""})));
    std::vector<std::string> kinds;
    for (const Finding& finding : OneEachKind(import.warnings)) kinds.push_back(finding.repair.Name());
    const bool is_driven = std::fabs(gap_m) < 1.0;
    EXPECT_THAT(kinds, Contains(is_driven ? "lane.gap_driven" : "lane.ended")) << gap_m;
    EXPECT_EQ(import.network->AtEnd({0, 0, -1}).size(), is_driven ? 1u : 0u) << gap_m;
  }
}

}  // namespace
}  // namespace rodeira::opendrive
