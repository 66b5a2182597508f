// SPDX-License-Identifier: Apache-2.0
// Roads that leave the middle of another one, and come onto it: ASAM OpenDRIVE 1.8, 12.7, with its own example.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "common/world/lanes/zones.hpp"
#include "common/world/network/placing.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using network::End;
using network::LaneEnd;

const std::string kWidth = R"(<width sOffset="0" a="3.5" b="0" c="0" d="0"/>)";

std::string Lane(int id, const std::string& links, const std::string& more = "") {
  return fmt::format("<lane id=\"{}\" type=\"driving\"><link>{}</link>{}{}</lane>", id, links, kWidth, more);
}

// The main road lies along x; entry 2 leaves it at s = 50 and turns right onto the yard's road 99, exit 4 comes back at
// s = 80.
struct Yard {
  RoadText main, entry, exit, yard;
  std::string junction = R"(<junction id="555" type="virtual" mainRoad="1" sStart="50" sEnd="80" orientation="+">
    <connection id="0" incomingRoad="1" connectingRoad="2" contactPoint="start"><laneLink from="-1" to="-1"/>
      </connection>
    <connection id="1" incomingRoad="99" connectingRoad="4" contactPoint="start"><laneLink from="-1" to="-1"/>
      </connection></junction>)";

  Yard() {
    const double r = 15.0, quarter = r * std::acos(-1.0) / 2.0;
    main.right =
        Lane(-1, "",
             R"(<roadMark sOffset="0" type="broken" color="white" width="0.12"><type name="dashes" width="0.12">
            <line length="4" space="8" tOffset="0" sOffset="0" width="0.12"/></type></roadMark>)");
    entry.id = "2", entry.length = quarter, entry.attributes = "junction=\"555\"";
    entry.geometry =
        fmt::format("<geometry s=\"0\" x=\"50\" y=\"0\" hdg=\"0\" length=\"{}\"><arc curvature=\"{}\"/></geometry>",
                    quarter, -1.0 / r);
    entry.link =
        R"(<predecessor elementType="road" elementId="1" elementS="50" elementDir="+"/>
            <successor elementType="road" elementId="99" contactPoint="end"/>)";
    entry.left = "", entry.right = Lane(-1, R"(<predecessor id="-1"/><successor id="1"/>)");
    // From the yard's end north to the main road, turning right: it ends at (80, 0) along x.
    exit.id = "4", exit.length = quarter, exit.attributes = "junction=\"555\"";
    exit.geometry =
        fmt::format("<geometry s=\"0\" x=\"65\" y=\"-15\" hdg=\"{}\" length=\"{}\"><arc curvature=\"{}\"/></geometry>",
                    std::acos(-1.0) / 2.0, quarter, -1.0 / r);
    exit.link =
        R"(<predecessor elementType="road" elementId="99" contactPoint="end"/>
            <successor elementType="road" elementId="1" elementS="80" elementDir="+"/>)";
    exit.left = "", exit.right = Lane(-1, R"(<predecessor id="-1"/><successor id="-1"/>)");
    yard.id = "99", yard.length = 40.0;
    yard.geometry = fmt::format("<geometry s=\"0\" x=\"65\" y=\"-55\" hdg=\"{}\" length=\"40\"><line/></geometry>",
                                std::acos(-1.0) / 2.0);
    yard.link = R"(<successor elementType="junction" elementId="555"/>)";
  }
  std::string Text() const { return Document(main.Text() + entry.Text() + exit.Text() + yard.Text() + junction); }
};

std::vector<std::string> Said(const Import& import) {
  std::vector<std::string> said;
  for (const Finding& warning : import.warnings) said.push_back(warning.Text());
  return said;
}

TEST(VirtualJunction, LanesGoOnFromTheMiddleOfARoadAndOntoIt) {
  const Import import = MustImport(Yard().Text());
  ASSERT_NE(import.network, nullptr);
  EXPECT_THAT(Said(import), testing::IsEmpty());
  const network::Network& network = *import.network;
  const auto& sections = network.roads()[0].spec().sections;
  ASSERT_EQ(sections.size(), 3u);
  EXPECT_EQ(sections[1].s_m, 50.0);
  EXPECT_EQ(sections[2].s_m, 80.0);
  EXPECT_EQ(sections[0].end_s_m, 50.0);
  EXPECT_THAT(network.AtEnd({0, 0, -1}),
              testing::ElementsAre(LaneEnd{{0, 1, -1}, End::kStart}, LaneEnd{{1, 0, -1}, End::kStart}));
  EXPECT_THAT(network.AtStart({0, 2, -1}),
              testing::ElementsAre(LaneEnd{{0, 1, -1}, End::kEnd}, LaneEnd{{2, 0, -1}, End::kEnd}));
  EXPECT_THAT(network.AtStart({0, 0, 1}), testing::IsEmpty());
  EXPECT_THAT(network.AtEnd({0, 0, 1}),
              testing::ElementsAre(LaneEnd{{0, 1, 1}, End::kStart}));  // the other side goes past
}

// The road's surface, width and dashes are those of the road that is not cut.
TEST(VirtualJunction, TheMainRoadIsAsItWas) {
  const Yard yard;
  const auto cut = MustRead(yard.Text()), whole = MustRead(Document(yard.main.Text()));
  const network::Road &a = cut->roads()[0], &b = whole->roads()[0];
  for (double s = 0.0; s <= 100.0; s += 0.7) {
    const auto in_cut = a.SpanAt(a.SectionIndex(s), -1, s), in_whole = b.SpanAt(0, -1, s);
    ASSERT_TRUE(in_cut && in_whole);
    EXPECT_EQ(in_cut->outer_t_m, in_whole->outer_t_m) << s;
    EXPECT_EQ((a.Surface(s, -2.0).p_W - b.Surface(s, -2.0).p_W).norm(), 0.0) << s;
  }
  const auto stroke_at = [](const network::Road& road, double s) {
    const network::RoadMark* mark = road.MarkAt(*road.SectionAt(s).Find(-1), s);
    return mark == nullptr ? std::string("none") : fmt::format("{} {} {}", mark->type, mark->s_m, mark->lines.size());
  };
  for (double s = 0.5; s < 100.0; s += 1.0) EXPECT_EQ(stroke_at(a, s), stroke_at(b, s)) << s;
}

// The main road has priority, unless the junction says otherwise.
TEST(VirtualJunction, TheMainRoadGoesFirst) {
  for (const bool turned : {false, true}) {
    Yard yard;
    if (turned) yard.junction.insert(yard.junction.find("</junction>"), R"(<priority high="4" low="1"/>)");
    const auto network = MustRead(yard.Text());
    const lanes::Graph graph(*network);
    const lanes::Zones zones(graph, {});
    const auto exit = graph.Find({2, 0, -1}), past = graph.Find({0, 1, -1}), behind = graph.Find({0, 2, -1});
    ASSERT_TRUE(exit && past && behind);
    ASSERT_EQ(graph[*exit].next.size(), 1u);
    EXPECT_EQ(graph[*exit].next[0].to, *behind);
    int merges = 0;
    for (const lanes::Zone& zone : zones.zones()) {
      if (zone.kind != lanes::ZoneKind::kMerge) continue;
      ++merges;
      const std::size_t main = zone.track[0] == *past ? 0 : 1;
      ASSERT_EQ(zone.track[main], *past);
      ASSERT_EQ(zone.track[1 - main], *exit);
      EXPECT_EQ(zone.first == static_cast<int>(main), !turned);
      EXPECT_TRUE(zone.signed_);
    }
    EXPECT_EQ(merges, 1);
  }
}

// Against s: what leaves and comes meets the other ends of the sections.
TEST(VirtualJunction, AgainstTheMainRoadsS) {
  RoadText main, entry;
  entry.id = "2", entry.length = 20.0, entry.attributes = "junction=\"5\"";
  entry.geometry =
      fmt::format("<geometry s=\"0\" x=\"40\" y=\"0\" hdg=\"{}\" length=\"20\"><line/></geometry>", std::acos(-1.0));
  entry.link = R"(<predecessor elementType="road" elementId="1" elementS="40" elementDir="-"/>)";
  entry.left = "", entry.right = Lane(-1, R"(<predecessor id="1"/>)");
  const Import import =
      MustImport(Document(main.Text() + entry.Text() +
                          R"(<junction id="5" type="virtual" mainRoad="1" sStart="40" sEnd="40" orientation="-">
          <connection id="0" incomingRoad="1" connectingRoad="2" contactPoint="start"><laneLink from="1" to="-1"/>
          </connection></junction>)"));
  EXPECT_THAT(Said(import), testing::IsEmpty());
  EXPECT_THAT(import.network->AtStart({1, 0, -1}), testing::ElementsAre(LaneEnd{{0, 1, 1}, End::kStart}));
}

TEST(VirtualJunction, AStationThatTheRoadHasNotIsRefused) {
  Yard yard;
  yard.entry.link = R"(<predecessor elementType="road" elementId="1" elementS="150" elementDir="+"/>)";
  const auto import = Read(yard.Text(), "sample.xodr", Tolerance::Unrepaired());
  ASSERT_TRUE(import.ok());
  ASSERT_FALSE(import.value().errors.empty());
  EXPECT_EQ(
      import.value().errors[0].Text(),
      "road.linkage.element_s: road 2, s 0: the road's start goes on at s = 150 m of road 1, which is 100 m long");
}

// An end that is named by its station is an end.
TEST(VirtualJunction, AStationAtTheEndIsTheEnd) {
  RoadText main, next;
  next.id = "2", next.geometry = R"(<geometry s="0" x="100" y="0" hdg="0" length="100"><line/></geometry>)";
  main.link = R"(<successor elementType="road" elementId="2" contactPoint="start"/>)",
  main.right = Lane(-1, R"(<successor id="-1"/>)");
  next.link = R"(<predecessor elementType="road" elementId="1" elementS="100" elementDir="+"/>)",
  next.right = Lane(-1, R"(<predecessor id="-1"/>)");
  const auto network = MustRead(Document(main.Text() + next.Text()));
  ASSERT_EQ(network->roads()[0].spec().sections.size(), 1u);
  EXPECT_THAT(network->AtEnd({0, 0, -1}), testing::ElementsAre(LaneEnd{{1, 0, -1}, End::kStart}));
}

// A path on foot is a crossing from kerb to kerb, and no ground of its own: ASAM's figure of a path in a virtual
// junction.
struct Path {
  RoadText main, path;
  std::string crossing =
      R"(<crossPath id="7" crossingRoad="2" roadAtStart="1" roadAtEnd="1"><startLaneLink s="54" from="-2" to="-1"/>
          <endLaneLink s="54" from="2" to="-1"/></crossPath>)";

  Path() {
    const std::string walk = R"(<width sOffset="0" a="2" b="0" c="0" d="0"/>)";
    main.left =
        "<lane id=\"1\" type=\"driving\">" + kWidth + "</lane><lane id=\"2\" type=\"sidewalk\">" + walk + "</lane>";
    main.right =
        "<lane id=\"-1\" type=\"driving\">" + kWidth + "</lane><lane id=\"-2\" type=\"sidewalk\">" + walk + "</lane>";
    path.id = "2", path.length = 10.0, path.attributes = "junction=\"555\"";
    path.geometry = fmt::format("<geometry s=\"0\" x=\"55.5\" y=\"-5\" hdg=\"{}\" length=\"10\"><line/></geometry>",
                                std::acos(-1.0) / 2.0);
    path.elevation = R"(<elevation s="0" a="30" b="0" c="0" d="0"/>)";  // to be passed over
    path.left = "", path.right = R"(<lane id="-1" type="walking"><width sOffset="0" a="3" b="0" c="0" d="0"/></lane>)";
  }
  std::string Text() const {
    return Document(
        main.Text() + path.Text() +
        "<junction id=\"555\" type=\"virtual\" mainRoad=\"1\" sStart=\"52\" sEnd=\"58\" orientation=\"none\">" +
        crossing + "</junction>");
  }
};

TEST(CrossPath, IsACrossingFromKerbToKerb) {
  const Import import = MustImport(Path().Text());
  ASSERT_NE(import.network, nullptr);
  EXPECT_THAT(Said(import), testing::IsEmpty());
  ASSERT_EQ(import.network->roads().size(), 1u);
  const auto& objects = import.network->roads()[0].spec().objects;
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].type, "crosswalk");
  EXPECT_EQ(objects[0].id, "555/7");
  EXPECT_NEAR(objects[0].s_m, 55.5, 1e-9);
  ASSERT_EQ(objects[0].outlines.size(), 1u);
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
  const double turn = objects[0].hdg_rad;
  for (const network::Corner& corner : objects[0].outlines[0].corners) {
    const double x = objects[0].s_m + std::cos(turn) * corner.first_m - std::sin(turn) * corner.second_m,
                 y = objects[0].t_m + std::sin(turn) * corner.first_m + std::cos(turn) * corner.second_m;
    low_x = std::min(low_x, x), high_x = std::max(high_x, x), low_y = std::min(low_y, y), high_y = std::max(high_y, y);
  }
  EXPECT_NEAR(low_x, 55.5, 1e-9);
  EXPECT_NEAR(high_x, 58.5, 1e-9);
  EXPECT_NEAR(low_y, -3.5, 0.11);  // as far as the carriageway goes, by steps of a decimetre
  EXPECT_NEAR(high_y, 3.5, 0.11);
}

TEST(CrossPath, ACrossingThatIsToldAsAnObjectIsNotTwo) {
  Path path;
  path.main.more =
      R"(<objects><object id="z" type="crosswalk" s="57" t="0" zOffset="0" length="3" width="7"/></objects>)";
  const auto network = MustRead(path.Text());
  ASSERT_EQ(network->roads().size(), 1u);
  EXPECT_EQ(network->roads()[0].spec().objects.size(), 1u);
}

TEST(CrossPath, APathThatIsNotWalkedOnStaysARoadAndIsSaid) {
  Path path;
  path.path.right = R"(<lane id="-1" type="biking"><width sOffset="0" a="3" b="0" c="0" d="0"/></lane>)";
  const Import import = MustImport(path.Text());
  EXPECT_EQ(import.network->roads().size(), 2u);
  EXPECT_THAT(Said(import),
              testing::ElementsAre("junctions.cross_path.only_connect_correct_type: the cross path '7' of junction 555 "
                                   "is the road '2', which has no lane for pedestrians: none walks there"));
}

// A junction's objects lie beside its own line: (x, y) = (60, -10) + rotation of (s, t) by 90°.
TEST(JunctionObjects, StandWhereTheJunctionsLineSays) {
  Yard yard;
  const std::string things = fmt::format(
      R"(<planView><geometry s="0" x="60" y="-10" hdg="{}" length="10"><line/></geometry></planView><objects>
    <object id="pole" type="pole" s="4" t="-1.5" zOffset="0.25" hdg="0.5" height="3" radius="0.1"/>
    <object id="island" type="trafficIsland" s="2" t="1" zOffset="0" hdg="0"><outline closed="true">
      <cornerRoad s="2" t="1" dz="0" height="0.2"/><cornerRoad s="3" t="1" dz="0" height="0.2"/>
      <cornerRoad s="3" t="2" dz="0" height="0.2"/></outline></object>
    <object id="row" type="pole" s="0" t="0" zOffset="0">
      <repeat s="0" length="4" distance="2" tStart="0" tEnd="1" zOffsetStart="0" zOffsetEnd="0" heightStart="1"
      heightEnd="2"/></object></objects>)",
      std::acos(-1.0) / 2.0);
  yard.junction.insert(yard.junction.find("</junction>"), things);
  const Import import = MustImport(yard.Text());
  EXPECT_THAT(Said(import), testing::IsEmpty());
  std::map<std::string, std::vector<Eigen::Vector3d>> at;
  for (const network::Placed& placed : network::PlaceFurniture(*import.network).things) {
    if (placed.object == nullptr) continue;
    at[placed.object->id].push_back({placed.foot_W.x(), placed.foot_W.y(), placed.heading_rad});
    if (placed.object->id != "island") continue;
    ASSERT_EQ(placed.object->outlines[0].corners.size(), 3u);
    const network::Corner& last = placed.object->outlines[0].corners[2];
    EXPECT_TRUE(last.local);
    const double c = std::cos(placed.heading_rad), s = std::sin(placed.heading_rad);
    EXPECT_NEAR(placed.foot_W.x() + c * last.first_m - s * last.second_m, 58.0, 1e-6);
    EXPECT_NEAR(placed.foot_W.y() + s * last.first_m + c * last.second_m, -7.0, 1e-6);
  }
  ASSERT_EQ(at["pole"].size(), 1u);
  EXPECT_NEAR(at["pole"][0].x(), 61.5, 1e-6);
  EXPECT_NEAR(at["pole"][0].y(), -6.0, 1e-6);
  EXPECT_NEAR(std::remainder(at["pole"][0].z() - std::acos(-1.0) / 2.0 - 0.5, 2.0 * std::acos(-1.0)), 0.0, 1e-6);
  ASSERT_EQ(at["row"].size(), 3u);
  EXPECT_NEAR(at["row"][2].x(), 59.0, 1e-6);
  EXPECT_NEAR(at["row"][2].y(), -6.0, 1e-6);
}

}  // namespace
}  // namespace rodeira::opendrive
