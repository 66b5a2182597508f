// SPDX-License-Identifier: Apache-2.0
// How errors of files are repaired: what is said once a kind, what the network then is, and what the repaired file
// holds. Expected places are computed by hand from the files' numbers.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "common/core/base/files.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using network::LaneKey;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string Lane(int id, const std::string& links, const std::string& width, const std::string& type = "driving") {
  return fmt::format("<lane id=\"{}\" type=\"{}\">{}{}</lane>", id, type,
                     links.empty() ? "" : "<link>" + links + "</link>", width);
}
std::string Wide(double width_m) {
  return fmt::format("<width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", width_m);
}
std::string Line(double s, double x, double y, double heading, double length) {
  return fmt::format("<geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\"><line/></geometry>", s, x, y,
                     heading, length);
}

// One road of 100 m eastward, with one lane of 3.5 m on the right.
RoadText OneLane() {
  RoadText road;
  road.left = "";
  return road;
}

// What was done, once a kind.
std::vector<std::string> Done(const Import& import) {
  std::vector<std::string> done;
  for (const Finding& finding : OneEachKind(import.warnings)) {
    if (!finding.repair.done.empty()) done.push_back(finding.Text());
  }
  return done;
}

// A file that is refused without repair, and loads with one sentence of one kind; its repaired text needs no other
// repair, and strictly nothing is left where `is_clean`.
Import Repaired(const std::string& text, const std::string& sentence, bool is_clean = true) {
  const auto refused = Read(text, "sample.xodr", Tolerance::Unrepaired());
  EXPECT_TRUE(refused.ok() && !refused.value().errors.empty());
  Import import = MustImport(text);
  EXPECT_NE(import.network, nullptr);
  EXPECT_THAT(Done(import), ElementsAre(HasSubstr(sentence)));
  if (!import.repaired_text.empty()) {
    EXPECT_TRUE(MustImport(import.repaired_text).repaired_text.empty()) << "a second repair changes the file";
  }
  const auto strictly = Read(import.repaired_text.empty() ? text : import.repaired_text, "r.xodr", Tolerance::Strict());
  EXPECT_EQ(strictly.value().errors.empty(), is_clean);
  return import;
}

TEST(Repair, AFileWithoutErrorsIsReadAsItIs) {
  const Import import = MustImport(Document(RoadText().Text()));
  EXPECT_TRUE(import.repaired_text.empty());
  EXPECT_THAT(Done(import), IsEmpty());
}

TEST(Repair, RecordsOutOfOrderAreSorted) {
  RoadText road = OneLane();
  road.elevation = R"(<elevation s="60" a="3" b="0"/><elevation s="0" a="1" b="0"/><elevation s="20" a="1" b="0.05"/>)";
  const Import import = Repaired(Document(road.Text()), "road.elevation.elem_asc_order");
  EXPECT_NEAR(import.network->roads()[0].Surface(10.0, 0.0).p_W.z(), 1.0, 1e-12);
  EXPECT_NEAR(import.network->roads()[0].Surface(40.0, 0.0).p_W.z(), 2.0, 1e-12);
  EXPECT_NEAR(import.network->roads()[0].Surface(80.0, 0.0).p_W.z(), 3.0, 1e-12);
  // Only the records have changed places.
  EXPECT_THAT(
      import.repaired_text,
      HasSubstr("<elevation s=\"0\" a=\"1\" b=\"0\"/><elevation s=\"20\" a=\"1\" b=\"0.05\"/><elevation s=\"60\" "));
  EXPECT_EQ(import.repaired_text.size(), Document(road.Text()).size());
}

TEST(Repair, MaterialsOutOfOrderAreSorted) {
  RoadText road = OneLane();
  road.right =
      Lane(-1, "", Wide(3.5) + R"(<material sOffset="70" friction="0.3"/><material sOffset="0" friction="0.8"/>)");
  const Import import = Repaired(Document(road.Text()), "road.lane.material.elem_asc_order");
  const network::Road& read = import.network->roads()[0];
  EXPECT_EQ(read.MaterialAt(read.spec().sections[0].right[0], 69.0)->friction, 0.8);
  EXPECT_EQ(read.MaterialAt(read.spec().sections[0].right[0], 71.0)->friction, 0.3);
}

// Of two profiles at one s the later one counts from there on: a step from 0 to 0.1 m at t = -2.
TEST(Repair, TwoProfilesAtOnePlaceAreAStep) {
  RoadText road = OneLane();
  road.lateral =
      R"(<shape s="0" t="-4" a="0"/><shape s="0" t="0" a="0"/><shape s="50" t="-4" a="0"/><shape s="50" t="0" a="0"/>
<shape s="50" t="-4" a="0.1"/><shape s="50" t="0" a="0.1"/>)";
  const Import import = Repaired(Document(road.Text()), "the later one counts from there on", false);
  EXPECT_NEAR(import.network->roads()[0].Surface(49.999, -2.0).p_W.z(), 0.0, 1e-9);
  EXPECT_NEAR(import.network->roads()[0].Surface(50.0, -2.0).p_W.z(), 0.1, 1e-9);
}

TEST(Repair, AProfileInFallingOrderOfTIsSorted) {
  RoadText road = OneLane();
  road.lateral = R"(<shape s="0" t="0" a="0" b="0"/><shape s="0" t="-4" a="0.4" b="-0.1"/>)";
  const Import import = Repaired(Document(road.Text()), "they are read in the order of t");
  EXPECT_NEAR(import.network->roads()[0].Surface(10.0, -3.0).p_W.z(), 0.4 - 0.1 * 1.0, 1e-9);
}

TEST(Repair, TheSameProfileTwiceIsOne) {
  RoadText road = OneLane();
  road.lateral = R"(<shape s="5" t="-3" a="0.2"/><shape s="5" t="1" a="0.2"/><shape s="5" t="-3" a="0.2"/>)"
                 R"(<shape s="5" t="1" a="0.2"/>)";
  const Import import = Repaired(Document(road.Text()), "the second, which is the same, is passed over");
  EXPECT_NEAR(import.network->roads()[0].Surface(50.0, -2.0).p_W.z(), 0.2, 1e-12);
}

TEST(Repair, ACentreLaneHasNoWidth) {
  std::string text = Document(OneLane().Text());
  text.replace(text.find("<lane id=\"0\" type=\"none\"/>"), 26,
               "<lane id=\"0\" type=\"none\"><width sOffset=\"0\" a=\"2\" b=\"0\" c=\"0\" d=\"0\"/></lane>");
  const Import import = Repaired(text, "road.lane.center_lane_no_width");
  EXPECT_NEAR(import.network->Centre({0, 0, -1}, 50.0).y(), -1.75, 1e-12);
}

TEST(Repair, AConnectorWithoutLengthIsALineOfItsRoadsLength) {
  RoadText road = OneLane();
  road.length = 0.2, road.geometry = Line(0, 7, 3, 0, 0);
  const Import import = Repaired(Document(road.Text()), "it is read as a line of the road's length");
  EXPECT_NEAR(import.network->roads()[0].axis().Evaluate(0.2).p_W.x(), 7.2, 1e-12);
}

// Two lines with 20 mrad between them: the line is the file's, and the lane's own curve has no kink.
TEST(Repair, KinksOfLinesAreDrivenAsTheyLie) {
  RoadText road = OneLane();
  road.geometry = Line(0, 0, 0, 0, 50) + Line(50, 50, 0, 0.02, 50);
  const Import import = Repaired(Document(road.Text()), "it is driven within 1 m, with a mean radius of 50 m", false);
  EXPECT_TRUE(import.repaired_text.empty());
  const Eigen::Vector2d end = import.network->roads()[0].axis().Evaluate(100.0).p_W;
  EXPECT_NEAR(end.x(), 50.0 + 50.0 * std::cos(0.02), 1e-9);
  EXPECT_NEAR(end.y(), 50.0 * std::sin(0.02), 1e-9);
}

// 0.2 m along and 0.08 m across are bridged within the last 5 m of the element before; before them the line is as it
// was, behind them too.
TEST(Repair, AGapOfADecimetreIsBridged) {
  RoadText road = OneLane();
  road.geometry = Line(0, 0, 0, 0, 50) + Line(50, 50.2, 0.08, 0, 50);
  const Import import = Repaired(Document(road.Text()), "it is bridged", false);
  const geometry::PlanAxis& axis = import.network->roads()[0].axis();
  EXPECT_NEAR(axis.Evaluate(45.0).p_W.x(), 45.0, 1e-12);
  EXPECT_NEAR(axis.Evaluate(50.0).p_W.y(), 0.08, 1e-9);
  EXPECT_NEAR((axis.Evaluate(50.0).p_W - axis.Evaluate(50.0 - 1e-6).p_W).norm(), 0.0, 1e-5);
  EXPECT_NEAR(axis.Evaluate(47.5).p_W.y(), 0.04, 1e-3);
  EXPECT_NEAR(axis.Evaluate(100.0).p_W.x(), 100.2, 1e-12);
}

TEST(Repair, ARoadEndsAtALargeGap) {
  RoadText road = OneLane();
  road.geometry = Line(0, 0, 0, 0, 60) + Line(60, 62, 0, 0, 40);
  const Import import = Repaired(Document(road.Text()), "the road ends there, at s 60");
  EXPECT_EQ(import.network->roads()[0].length_m(), 60.0);
}

TEST(Repair, ElementsDecideOnTheRoadsLength) {
  RoadText road = OneLane();
  road.length = 130.0;
  EXPECT_EQ(Repaired(Document(road.Text()), "the elements count").network->roads()[0].length_m(), 100.0);
}

TEST(Repair, GapsBelowAsamsOwnLimitAreNotWorthAWord) {
  RoadText road = OneLane();
  road.geometry = Line(0, 0, 0, 0, 50) + Line(50, 50 + 5e-7, 0, 4e-7, 50);
  EXPECT_THAT(MustImport(Document(road.Text())).warnings, IsEmpty());
}

// A width that jumps by 1.5 m goes over within 9 m: at both ends of them it is what the file says, in their middle
// halfway.
TEST(Repair, AWidthThatJumpsIsToldAndSmoothed) {
  RoadText road = OneLane();
  road.right = Lane(-1, "", Wide(3.0) + R"(<width sOffset="40" a="4.5" b="0" c="0" d="0"/>)");
  const Import import = Repaired(Document(road.Text()), "the lane's width jumps by 1.5 m");
  const auto width = [&](double s) { return import.network->Span({0, 0, -1}, s)->width_m(); };
  EXPECT_NEAR(width(40.0), 3.0, 1e-12);
  EXPECT_NEAR(width(44.5), 3.75, 1e-12);
  EXPECT_NEAR(width(49.0), 4.5, 1e-12);
  EXPECT_NEAR(width(90.0), 4.5, 1e-12);
}

TEST(Repair, ALaneOffsetThatJumpsIsToldAndSmoothed) {
  RoadText road = OneLane();
  road.offset = R"(<laneOffset s="0" a="0" b="0" c="0" d="0"/><laneOffset s="30" a="-1" b="0" c="0" d="0"/>)";
  const Import import = Repaired(Document(road.Text()), "the lane offset jumps by -1 m");
  EXPECT_NEAR(import.network->roads()[0].CentreAt(33.0).value, -0.5, 1e-12);
  EXPECT_NEAR(import.network->roads()[0].CentreAt(36.0).value, -1.0, 1e-12);
}

// Two roads without a junction: their lines lie 2 m aside, their lanes meet.
std::string Aside(double y_m, double width_m = 3.0) {
  RoadText first = OneLane(), second = OneLane();
  first.link = R"(<successor elementType="road" elementId="2" contactPoint="start"/>)";
  second.id = "2", second.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>)";
  first.right = Lane(-1, "<successor id=\"-2\"/>", Wide(3.0));
  second.geometry = Line(0, 100, y_m, 0, 100);
  second.right = Lane(-1, "", Wide(2.0), "shoulder") + Lane(-2, "<predecessor id=\"-1\"/>", Wide(width_m));
  return Document(first.Text() + second.Text());
}

TEST(Repair, LanesDecideWhetherALinkIsGood) {
  const Import import = Repaired(Aside(2.0), "lanes go on where their edges meet", false);
  ASSERT_EQ(import.network->AtEnd({0, 0, -1}).size(), 1u);
  EXPECT_EQ(import.network->AtEnd({0, 0, -1})[0].lane, (LaneKey{1, 0, -2}));
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
}

// A lane that goes on 0.12 m wider is driven 0.06 m aside; one that lies wholly beside is not.
TEST(Repair, AWidthThatStepsBetweenRoadsIsDriven) {
  const Import import = MustImport(Aside(2.0, 3.12));
  EXPECT_THAT(Done(import), testing::Contains(HasSubstr("it is driven, 0.06 m aside")));
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
  const Import beside = MustImport(Aside(6.0));
  EXPECT_THAT(Done(beside), testing::Contains(HasSubstr("the lane ends there")));
  EXPECT_TRUE(beside.network->AtEnd({0, 0, -1}).empty());
}

// Road 2 runs towards road 1; the link of that names the wrong one of its ends.
TEST(Repair, ARoadIsMetAtTheEndThatLiesThere) {
  RoadText first = OneLane(), second = OneLane();
  first.link = R"(<successor elementType="road" elementId="2" contactPoint="start"/>)";
  first.right = Lane(-1, "<successor id=\"1\"/>", Wide(3.5));
  second.id = "2", second.geometry = Line(0, 200, 0, 3.14159265358979312, 100);
  second.link = R"(<successor elementType="road" elementId="1" contactPoint="end"/>)";
  second.right = "", second.left = Lane(1, "<successor id=\"-1\"/>", Wide(3.5));
  const Import import = MustImport(Document(first.Text() + second.Text()));
  EXPECT_THAT(Done(import), testing::Contains(HasSubstr("the road is met at its other end")));
  EXPECT_THAT(import.network->AtEnd({0, 0, -1}), ElementsAre(network::LaneEnd{{1, 0, 1}, network::End::kEnd}));
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
}

TEST(Repair, ALinkToALaneThatIsNotThereIsDropped) {
  RoadText road = OneLane();
  road.right = Lane(-1, "<successor id=\"-1\"/>", Wide(3.5)) + Lane(-2, "<successor id=\"-7\"/>", Wide(1), "shoulder") +
               "</right></laneSection><laneSection s=\"30\"><center><lane id=\"0\" type=\"none\"/></center><right>" +
               Lane(-1, "<predecessor id=\"-1\"/>", Wide(3.5));
  const Import import = Repaired(Document(road.Text()), "the link is dropped");
  EXPECT_EQ(import.network->AtEnd({0, 0, -1}).size(), 1u);
}

TEST(Repair, ARoadEndsWhereTheNextIsNotInTheFile) {
  RoadText road = OneLane();
  road.link = R"(<predecessor elementType="junction" elementId="12"/>)"
              R"(<successor elementType="road" elementId="9" contactPoint="end"/>)";
  const Import import = Repaired(Document(road.Text()), "road.linkage.id: road 1");
  EXPECT_FALSE(import.network->roads()[0].spec().predecessor || import.network->roads()[0].spec().successor);
  EXPECT_EQ(import.before->share(), 0.0);
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
}

// One lane of 7 m goes on as two of 3.5 m: no gap, as ASAM's checker has it.
TEST(Repair, ALaneThatSplitsIntoTwoHasNoGap) {
  RoadText road = OneLane();
  road.right = Lane(-1, "<successor id=\"-1\"/><successor id=\"-2\"/>", Wide(7)) +
               "</right></laneSection><laneSection s=\"50\"><center><lane id=\"0\" type=\"none\"/></center><right>" +
               Lane(-1, "<predecessor id=\"-1\"/>", Wide(3.5)) + Lane(-2, "<predecessor id=\"-1\"/>", Wide(3.5));
  const auto strictly = Read(Document(road.Text()), "s.xodr", Tolerance::Strict());
  EXPECT_THAT(strictly.value().errors, IsEmpty());
  EXPECT_THAT(MustImport(Document(road.Text())).warnings, IsEmpty());
  EXPECT_EQ(MustRead(Document(road.Text()))->AtEnd({0, 0, -1}).size(), 2u);
}

// Roads 1 and 2 with a connecting road between them; its lane says nothing of where it goes on.
std::string Junction(const std::string& links, double y_m, double heading) {
  RoadText in = OneLane(), out = OneLane(), way = OneLane();
  in.link = R"(<successor elementType="junction" elementId="5"/>)";
  out.id = "2", out.link = R"(<predecessor elementType="junction" elementId="5"/>)";
  out.geometry = Line(0, 120, 0, 0, 100);
  way.id = "3", way.length = 20, way.attributes = "junction=\"5\"";
  way.link = R"(<predecessor elementType="road" elementId="1" contactPoint="end"/>)"
             R"(<successor elementType="road" elementId="2" contactPoint="start"/>)";
  way.geometry = Line(0, 100, y_m, heading, 20);
  way.right = Lane(-1, links, Wide(3.5));
  return Document(in.Text() + out.Text() + way.Text() +
                  R"(<junction id="5"><connection id="0" incomingRoad="1" connectingRoad="3" contactPoint="start">)"
                  R"(<laneLink from="-1" to="-1"/></connection></junction>)");
}

TEST(Repair, AMissingLinkInAJunctionIsFoundByGeometry) {
  const Import import = MustImport(Junction("", 0.0, 0.0));
  EXPECT_THAT(Done(import), ElementsAre(AllOf(HasSubstr("rodeira.lane.dead_end: road 3, lane -1, s 20"),
                                              HasSubstr("it goes on as lane -1 of road 2, which lies there"))));
  ASSERT_EQ(import.network->AtEnd({2, 0, -1}).size(), 1u);
  EXPECT_EQ(import.network->AtEnd({2, 0, -1})[0].lane, (LaneKey{1, 0, -1}));
  EXPECT_EQ(import.before->share(), 0.0);
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
  EXPECT_TRUE(Read(import.repaired_text, "r.xodr", Tolerance::Strict()).value().errors.empty());
}

// Read strictly it is told as well, and nothing is done about it.
TEST(Repair, AMissingLinkInAJunctionIsToldByStrict) {
  const Import import = MustImport(Junction("", 0.0, 0.0), Tolerance::Strict());
  std::vector<std::string> told;
  for (const Finding& finding : import.warnings) told.push_back(finding.rule);
  EXPECT_THAT(told, testing::Contains(kDeadEndRule));
  EXPECT_TRUE(import.network->AtEnd({2, 0, -1}).empty());
}

// Where it leads beside every lane the lane is told, and keeps ending there.
TEST(Repair, ALaneThatEndsInAJunctionIsTold) {
  const Import import = MustImport(Junction("", 0.0, 0.1));
  std::vector<std::string> told;
  for (const Finding& finding : import.warnings) told.push_back(finding.Text());
  EXPECT_THAT(told, testing::Contains(HasSubstr("rodeira.lane.dead_end: road 3, lane -1, s 20")));
  EXPECT_TRUE(import.network->AtEnd({2, 0, -1}).empty());
}

// A connecting road that begins 0.9 rad across its road: no car can drive that.
TEST(Repair, AWayThatNoCarCanDriveIsDropped) {
  const Import import = MustImport(Junction("<predecessor id=\"-1\"/><successor id=\"-1\"/>", 0.0, 0.9));
  EXPECT_THAT(Done(import), ElementsAre(HasSubstr("the way over road 3 is dropped")));
  EXPECT_FALSE(import.network->FindRoad("3"));
  EXPECT_EQ(ReachOf(*import.network).share(), 1.0);
}

// A way that turns back by 2.2 rad, with 0.46 rad across its road at either end, as SUMO draws its U-turns: the lane's
// edge is 2 * 3.5 * sin(0.23) = 1.6 m off.
TEST(Repair, AUTurnThatIsKinkedIsDropped) {
  std::string text = Junction("<predecessor id=\"-1\"/><successor id=\"-1\"/>", 0.0, 0.46);
  const std::string line = "<line/>", way = "<arc curvature=\"0.11\"/>";
  text.replace(text.rfind(line), line.size(), way);
  const Import import = MustImport(text);
  EXPECT_THAT(Done(import), ElementsAre(HasSubstr("a gap of 1.596 m")));
  EXPECT_FALSE(import.network->FindRoad("3"));
}

TEST(Repair, LanesOfMissingIdsHaveNoWidth) {
  RoadText road = OneLane();
  road.right = Lane(-1, "", Wide(3.5)) + Lane(-4, "", Wide(1.5), "shoulder");
  const Import import = Repaired(Document(road.Text()), "a lane without width takes each id that is left out");
  EXPECT_NEAR(import.network->Span({0, 0, -4}, 5.0)->outer_t_m, -5.0, 1e-12);
}

TEST(Repair, AFileIsRefusedWhereNothingIsLeftAndSaysWhy) {
  RoadText road = OneLane();
  road.geometry = R"(<geometry s="0" x="1e12" y="0" hdg="0" length="100"><line/></geometry>)";
  const auto import = Read(Document(road.Text()), "f.xodr");
  ASSERT_EQ(import.value().network, nullptr);
  EXPECT_THAT(import.value().errors.front().Text(), HasSubstr("road.geometry.position: road 1, s 0"));
  RoadText good = OneLane();
  good.id = "2";
  const Import kept = MustImport(Document(road.Text() + good.Text()));
  EXPECT_THAT(Done(kept), ElementsAre(HasSubstr("the road is left out")));
  EXPECT_EQ(kept.network->roads().size(), 1u);
}

TEST(Repair, AHeaderWithoutAVersionIsPassedOver) {
  std::string text = Document(OneLane().Text());
  text.replace(text.find(" revMajor=\"1\""), 13, "");
  const Import import = MustImport(text);
  ASSERT_NE(import.network, nullptr);
  EXPECT_THAT(Done(import), ElementsAre(HasSubstr("it is passed over"), HasSubstr("it is read as if it were 1.8")));
}

// Lines are those of the file as it was, however much was put in or taken out before them.
TEST(Repair, LinesAreThoseOfTheFile) {
  RoadText road = OneLane(), second = OneLane();
  road.right = Lane(-1, "", Wide(3.5)) + Lane(-3, "", "\n\n\n" + Wide(1.5), "shoulder");
  second.id = "2", second.link = R"(<successor elementType="road" elementId="9" contactPoint="end"/>)";
  const std::string text = Document(road.Text() + second.Text());
  const Import import = MustImport(text);
  ASSERT_EQ(Done(import).size(), 2u);
  const auto line_of = [&](const char* what) {
    return static_cast<std::size_t>(
               std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(what)), '\n')) +
           1;
  };
  EXPECT_EQ(OneEachKind(import.warnings)[1].line, line_of("<road id=\"2\""));
}

// The names are those of the manual's list, one each.
TEST(Repair, EachKindHasANameInTheManual) {
  const std::string manual = base::ReadText(SourceDir() + "/docs/reference/road-repairs.md").value();
  std::set<std::string_view> names;
  std::set<RepairKind> kinds;
  for (const RepairKindName& each : RepairKindNames()) {
    EXPECT_TRUE(names.insert(each.name).second && kinds.insert(each.kind).second) << each.name;
    EXPECT_THAT(manual, HasSubstr(fmt::format("`{}`", each.name)));
    EXPECT_EQ(NameOf(each.kind), each.name);
  }
  for (int kind = 1; kind <= static_cast<int>(RepairKind::kWidthZero); ++kind)
    EXPECT_TRUE(kinds.contains(static_cast<RepairKind>(kind))) << kind;
}

// Two repairs of one rule that begin with the same words are two kinds; one repair with other numbers is one.
TEST(Repair, KindsAreToldApartByTheirNames) {
  RoadText road = OneLane(), second = OneLane();
  road.more = R"(<signals><signal id="1" s="x" t="0"/><signal id="2" s="y" t="0"/></signals>)"
              R"(<objects><object id="3" s="z" t="0"/></objects>)";
  second.id = "2", second.geometry = Line(0, 0, 30, 0, 40) + Line(40, 40, 30, 0.01, 60);
  road.geometry = Line(0, 0, 0, 0, 50) + Line(50, 50, 0, 0.02, 50);
  const Import import = MustImport(Document(road.Text() + second.Text()));
  std::vector<std::string> kinds;
  for (const Finding& finding : OneEachKind(import.warnings)) kinds.push_back(finding.repair.Name());
  std::sort(kinds.begin(), kinds.end());
  EXPECT_THAT(kinds, ElementsAre("geometry.kink_rounded", "object.dropped", "signal.dropped"));
}

TEST(Repair, WarningsOfOneKindAreOne) {
  std::string roads;
  for (int i = 0; i < 40; ++i) {
    RoadText road = OneLane();
    road.id = std::to_string(i);
    road.geometry = Line(0, 0, 10.0 * i, 0, 50) + Line(50, 50, 10.0 * i, 0.002 + 0.001 * i, 50);
    roads += road.Text();
  }
  const Import import = MustImport(Document(roads));
  EXPECT_EQ(import.warnings.size(), 40u);
  EXPECT_THAT(Done(import), ElementsAre(AllOf(HasSubstr("road 0, s 50"), HasSubstr("(40 of this kind)"))));
}

// One controller for the lights of ways that cross has no times that would be right: its lights stay dark.
TEST(Repair, LightsOfOneControllerForCrossingWaysStayDark) {
  const auto with = [](double heading) {
    RoadText a = OneLane(), b = OneLane();
    b.id = "2", b.geometry = Line(0, 50, -90, heading, 100);
    a.more = R"(<signals><signal id="1" s="90" t="-4" zOffset="3" type="1000001" orientation="+" dynamic="yes"/>)"
             "</signals>";
    b.more = R"(<signals><signal id="2" s="90" t="-4" zOffset="3" type="1000001" orientation="+" dynamic="yes"/>)"
             "</signals>";
    return MustImport(
        Document(a.Text() + b.Text() +
                 R"(<controller id="c"><control signalId="1"/><control signalId="2"/></controller><junction id="5">)"
                 R"(<controller id="c"/></junction>)"));
  };
  const Import crossing = with(1.5707963267948966), opposite = with(3.1);
  EXPECT_FALSE(crossing.network->controllers()[0].times);
  EXPECT_THAT(Done(crossing), ElementsAre(HasSubstr("its lights stay dark")));
  EXPECT_TRUE(opposite.network->controllers()[0].times);
  EXPECT_THAT(Done(opposite), IsEmpty());
}

}  // namespace
}  // namespace rodeira::opendrive
