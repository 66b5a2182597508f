// SPDX-License-Identifier: Apache-2.0
// What is read of signals, objects, marks and access of an OpenDRIVE file, and what is wrong with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "tests/common/world/opendrive/sample.hpp"
#include "tests/names.hpp"

namespace rodeira::opendrive {
namespace {

using testing::HasSubstr;

TEST(OpenDrive, SignalsObjectsAndTheRestAreKept) {
  RoadText road;
  road.more =
      R"(<objects><object id="o" type="tree" s="10" t="8" zOffset="0.5" radius="1.5" height="6">
          <repeat s="10" length="40" distance="10" tStart="8" tEnd="9" heightStart="5" heightEnd="6"/>
      <outlines><outline closed="true"><cornerLocal u="1" v="2" z="3" height="4"/></outline></outlines>
        <validity fromLane="1" toLane="-1"/></object>
      <tunnel id="t" s="20" length="30" type="standard"/><bridge id="b" s="60" length="10" type="steel"/></objects>
      <signals><signal id="294" s="90" t="-5" type="274" subtype="50" country="DE" value="50" unit="km/h"
        orientation="+" dynamic="no" hOffset="0.1"><validity fromLane="-1" toLane="-1"/></signal>
      <signalReference s="1" t="2" id="294" orientation="-"/></signals>
      <surface><CRG file="a.crg" sStart="10" sEnd="20" orientation="opposite" mode="genuine" zScale="2"/></surface>)";
  std::string text =
      Document(road.Text() + R"(<controller id="c" name="lights"><control signalId="294" type="0"/></controller>)");
  text.replace(text.find("revMinor=\"8\"/>"), 14,
               "revMinor=\"8\"><geoReference><![CDATA[\n +proj=utm +zone=29 \n]]></geoReference></header>");
  const Import import = MustImport(text);
  EXPECT_EQ(import.version, "1.8");
  EXPECT_EQ(import.network->geo_reference(), "+proj=utm +zone=29");
  const network::RoadSpec& spec = import.network->roads()[0].spec();
  ASSERT_EQ(spec.objects.size(), 1u);
  EXPECT_EQ(spec.objects[0].radius_m, 1.5);
  EXPECT_EQ(spec.objects[0].repeats[0].distance_m, 10.0);
  EXPECT_EQ(spec.objects[0].repeats[0].t_end_m, 9.0);
  EXPECT_EQ(spec.objects[0].outlines[0].corners[0].second_m, 2.0);
  EXPECT_EQ(spec.objects[0].validity[0].from_lane, -1);
  ASSERT_EQ(spec.structures.size(), 2u);
  EXPECT_FALSE(spec.structures[0].bridge);
  EXPECT_TRUE(spec.structures[1].bridge);
  ASSERT_EQ(spec.signals.size(), 1u);
  EXPECT_EQ(spec.signals[0].value, 50.0);
  EXPECT_EQ(spec.signals[0].country, "DE");
  EXPECT_EQ(spec.signal_references[0].orientation, "-");
  EXPECT_EQ(spec.crg[0].z_scale, 2.0);
  EXPECT_EQ(import.network->controllers()[0].controls[0].signal_id, "294");
  EXPECT_THAT(Describe(import),
              testing::AllOf(HasSubstr("roads: 1, 100.000 m"),
                             HasSubstr("lanes: 2 in 1 sections, of which 2 drivable, 200.000 m"),
                             HasSubstr("signals: 1\nobjects: 1\n"), HasSubstr("geoReference: +proj=utm +zone=29\n"),
                             HasSubstr("warnings: 0\n")));
}

TEST(OpenDrive, ReferencesDependenciesAndPermissionsAreKept) {
  RoadText road;
  road.right =
      R"(<lane id="-1" type="driving" direction="reversed"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          <access sOffset="20" rule="deny" restriction="trucks"/>
      <access sOffset="60" rule="allow"><restriction type="bus"/><restriction type="taxi"/></access></lane>
      <lane id="-2" type="driving" direction="both"><width sOffset="0" a="3" b="0" c="0" d="0"/></lane>)";
  road.more = R"(<objects><objectReference s="30" t="-6" id="wall" orientation="+"/></objects>
      <signals><signal id="main" s="90" t="-5" type="1000001"/><signal id="arrow" s="90" t="-5" type="1000011">
        <dependency id="main" type="x"/><dependency id="other"/></signal></signals>)";
  const auto network = MustRead(Document(road.Text()));
  const network::RoadSpec& spec = network->roads()[0].spec();
  ASSERT_EQ(spec.object_references.size(), 1u);
  EXPECT_TRUE(spec.object_references[0].id == "wall" && spec.object_references[0].s_m == 30.0 &&
              spec.object_references[0].t_m == -6.0 && spec.object_references[0].orientation == "+");
  ASSERT_EQ(spec.signals.size(), 2u);
  EXPECT_TRUE(spec.signals[0].depends_on.empty());
  EXPECT_THAT(spec.signals[1].depends_on, testing::ElementsAre("main", "other"));
  const network::Lane &lane = *spec.sections[0].Find(-1), &both = *spec.sections[0].Find(-2);
  EXPECT_EQ(lane.direction, -1);
  EXPECT_EQ(both.direction, 0);
  ASSERT_EQ(lane.access.size(), 2u);
  EXPECT_EQ(lane.access[0].rule, "deny");
  EXPECT_EQ(lane.access[0].s_m, 20.0);
  EXPECT_THAT(lane.access[0].restrictions, testing::ElementsAre("trucks"));
  EXPECT_THAT(lane.access[1].restrictions, testing::ElementsAre("bus", "taxi"));
}

// One <access> names one kind (up to 1.7): those at one place are one rule.
TEST(OpenDrive, RulesOfAccessAtOnePlaceAreOne) {
  RoadText road;
  const auto lane = [&](const std::string& access) {
    road.right = "<lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>" + access +
                 "</lane>";
    const Import import = MustImport(Document(road.Text()));
    std::vector<std::string> said;
    for (const Finding& warning : import.warnings) said.push_back(warning.Text());
    return std::pair(*import.network->Find({0, 0, -1}), said);
  };
  const auto [buses, nothing] = lane(
      R"(<access sOffset="10" rule="allow" restriction="bus"/><access sOffset="10" rule="allow" restriction="taxi"/>)");
  ASSERT_EQ(buses.access.size(), 1u);
  EXPECT_THAT(buses.access[0].restrictions, testing::ElementsAre("bus", "taxi"));
  EXPECT_THAT(nothing, testing::IsEmpty());
  EXPECT_FALSE(network::OpenToCars(buses));
  EXPECT_FALSE(network::OpenToCars(lane(
                                       R"(<access sOffset="0" rule="deny" restriction="truck"/>
              <access sOffset="0" rule="deny" restriction="passengerCar"/>)")
                                       .first));
  for (const char* open : {"", R"(<access sOffset="0" rule="deny" restriction="truck"/>)",
                           R"(<access sOffset="0" rule="allow" restriction="passengerCar"/>
           <access sOffset="0" rule="allow" restriction="bus"/>)",
                           R"(<access sOffset="0" restriction="simulator"/>)"}) {
    EXPECT_TRUE(network::OpenToCars(lane(open).first)) << open;
  }
  EXPECT_THAT(
      lane(
          R"(<access sOffset="10" rule="allow" restriction="bus"/>
              <access sOffset="10" rule="deny" restriction="taxi"/>)")
          .second,
      testing::ElementsAre("road.lane.access.no_mix_of_deny_or_allow: road 1, lane -1, s 10: at one place the lane has "
                           "a rule 'allow' and a rule 'deny': the second counts"));
}

TEST(OpenDrive, AnUnknownTypeOfObjectIsToldWithTheNearestRightOne) {
  RoadText road;
  road.more =
      "<objects><object id=\"7\" type=\"tre\" s=\"10\" t=\"8\" height=\"5\"/><object id=\"8\" type=\"tree\" s=\"20\" "
      "t=\"8\" height=\"5\"/></objects>";
  const Import import = MustImport(Document(road.Text()));
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].Text(),
            "road.object.type: road 1, s 10: the object '7' has the type 'tre', which OpenDRIVE does not know; did you "
            "mean 'tree'?");
  EXPECT_GT(import.warnings[0].line, 0u);
}

// An unreadable plate is told of; what is known, hangs as a light, or is paint is not.
TEST(OpenDrive, ASignThatIsNotKnownIsTold) {
  RoadText road;
  const auto sign = [](const std::string& id, const std::string& rest) {
    return "<signal id=\"" + id + "\" s=\"10\" t=\"-5\" " + rest + "/>\n";
  };
  road.more = "<signals>" + sign("a", R"(type="274" subtype="-1" country="DE" value="70" unit="km/h")") +
              sign("b", R"(type="274" subtype="57" country="OpenDRIVE")") +
              sign("c", R"(type="1000001" subtype="-1" dynamic="yes" zOffset="3")") +
              sign("d", R"(type="294" subtype="-1")") + sign("e", R"(type="1000003" subtype="-1")") +
              sign("f", R"(type="-1" subtype="-1")") + sign("g", R"(type="777" subtype="-1" height="0.03")") +
              sign("w", R"(type="c" subtype="31" country="se")") +
              sign("x", R"(type="777" subtype="-1" country="DE")") + sign("y", R"(type="103" subtype="30")") +
              sign("z", R"(type="274" subtype="-1" country="DE")") + "</signals>";
  const Import import = MustImport(Document(road.Text()));
  ASSERT_EQ(import.warnings.size(), 4u);
  EXPECT_EQ(import.warnings[0].Text(),
            "road.signal.type: road 1, s 10: the sign 'w' is none that is known (type 'c', subtype '31', country "
            "'se'): it is drawn as a grey plate");
  EXPECT_EQ(import.warnings[1].Text(),
            "road.signal.type: road 1, s 10: the sign 'x' is none that is known (type '777', subtype '-1', country "
            "'DE'): it is drawn as a grey plate");
  EXPECT_THAT(import.warnings[2].Text(), HasSubstr("the sign 'y' is none that is known (type '103', subtype '30'"));
  EXPECT_EQ(import.warnings[3].Text(),
            "road.signal.type: road 1, s 10: the sign 'z' says no limit: it is drawn as a grey plate");
  EXPECT_GT(import.warnings[0].line, 0u);
}

TEST(OpenDrive, MarksOfObjectsAndPlacesOfSignsThatCannotBeAreTold) {
  RoadText road;
  road.more =
      R"(<objects><object id="7" type="parkingSpace" s="10" t="8" length="5" width="2.5"><outline>
          <cornerLocal id="a" u="0" v="0"/><cornerLocal id="b" u="5" v="0"/></outline>
      <markings><marking side="left" color="yellow" width="0.12" lineLength="1" spaceLength="0.5" startOffset="0.2"
        stopOffset="0.3"/><marking side="lef" width="0.1"/>
      <marking width="0.1"><cornerReference id="a"/><cornerReference id="b"/></marking><marking width="0.1">
        <cornerReference id="a"/><cornerReference id="c"/></marking>
      <marking width="0.1"><cornerReference id="a"/></marking><marking side="rear" width="0.1" stopOffset="-1e12"/>
        </markings></object></objects>
      <signals><signal id="1" s="5" t="-4" type="206" subtype="-1" country="DE"><positionRoad roadId="2" s="1" t="2"/>
        </signal></signals>)";
  const Import import = MustImport(Document(road.Text()));
  std::vector<std::string> said;
  for (const Finding& warning : import.warnings) said.push_back(warning.Text());
  EXPECT_THAT(
      said,
      testing::UnorderedElementsAre(
          HasSubstr("road.object.marking: road 1, s 10: a mark of the object '7' lies on the side 'lef'; did you mean "
                    "'left'?: it is not painted"),
          Names("road.object.marking: … '7' … corner 'c'"),
          HasSubstr("a mark of the object '7' has a width that is not above 0, or a stroke, gap or offset below 0: it "
                    "is not painted"),
          HasSubstr("a mark of the object '7' names one corner where it goes from corner to corner: it is not painted"),
          HasSubstr("road.signal.position: road 1, s 5: the signal '1' stands at the road '2', which is not in the "
                    "file; known are 1: it is drawn where it counts")));
  const auto& marks = import.network->roads()[0].spec().objects[0].marks;
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].side, "left");
  EXPECT_EQ(marks[0].colour, "yellow");
  EXPECT_EQ(marks[0].stroke_m, 1.0);
  EXPECT_EQ(marks[0].gap_m, 0.5);
  EXPECT_EQ(marks[0].start_offset_m, 0.2);
  EXPECT_EQ(marks[0].stop_offset_m, 0.3);
  EXPECT_EQ(marks[1].corners, (std::vector<std::string>{"a", "b"}));
}

// Of an island, a parking place, a row beside a bend and a mast: what a file says of them beyond a box.
TEST(OpenDrive, FramesFillingsSkeletonsAndMaterialsAreRead) {
  RoadText road;
  road.more = R"(<objects>
    <object id="i" type="trafficIsland" s="10" t="8"><outlines><outline id="3" fillType="grass">
      <cornerLocal id="0" u="0" v="0"/><cornerLocal id="1" u="5" v="0"/><cornerLocal id="2" u="5" v="2"/></outline>
      </outlines>
      <borders><border outlineId="3" type="curb" width="0.15" useCompleteOutline="true"/>
        <border outlineId="3" type="concrete" width="0.3" useCompleteOutline="false"><cornerReference id="0"/>
        <cornerReference id="1"/></border></borders></object>
    <object id="p" type="parkingSpace" s="20" t="8"><material surface="asphalt" friction="0.7" roadMarkColor="yellow"/>
      <parkingSpace access="handicapped" restrictions="till 8"/></object>
    <object id="r" type="streetLamp" s="1" t="8"><repeat s="1" length="9" distance="3" detachFromReferenceLine="true"/>
      </object>
    <object id="m" type="pole" s="30" t="8"><skeleton><polyline id="1"><vertexRoad s="30" t="8" dz="0" radius="0.15"/>
      <vertexRoad s="30" t="8" dz="4" radius="0.1"/></polyline>
      <polyline id="2"><vertexLocal u="0" v="0" z="3" width="0.2" length="0.1"/>
        <vertexLocal u="0" v="-2" z="3.5" width="0.2" length="0.1"/></polyline></skeleton></object></objects>
    <signals><signal id="1" s="5" t="-4" type="x1-1" subtype="-1" country="US"><semantics><priority type="stop"/>
      </semantics></signal></signals>)";
  const Import import = MustImport(Document(road.Text()));
  ASSERT_EQ(import.warnings.size(), 1u);  // the plate's unknown face
  const network::RoadSpec& spec = import.network->roads()[0].spec();
  const auto& island = spec.objects[0];
  EXPECT_EQ(island.outlines[0].id, "3");
  EXPECT_EQ(island.outlines[0].fill, "grass");
  ASSERT_EQ(island.borders.size(), 2u);
  EXPECT_EQ(island.borders[0].type, "curb");
  EXPECT_EQ(island.borders[0].width_m, 0.15);
  EXPECT_TRUE(island.borders[0].corners.empty());
  EXPECT_EQ(island.borders[1].corners, (std::vector<std::string>{"0", "1"}));
  EXPECT_EQ(spec.objects[1].access, "handicapped");
  EXPECT_EQ(spec.objects[1].material.surface, "asphalt");
  EXPECT_EQ(spec.objects[1].material.friction, 0.7);
  EXPECT_EQ(spec.objects[1].material.colour, "yellow");
  EXPECT_TRUE(spec.objects[2].repeats[0].straight);
  const auto& mast = spec.objects[3];
  ASSERT_EQ(mast.skeleton.size(), 2u);
  EXPECT_FALSE(mast.skeleton[0][1].local);
  EXPECT_EQ(mast.skeleton[0][1].dz_m, 4.0);
  EXPECT_EQ(mast.skeleton[0][1].radius_m, 0.1);
  EXPECT_TRUE(mast.skeleton[1][1].local);
  EXPECT_EQ(mast.skeleton[1][1].second_m, -2.0);
  EXPECT_EQ(mast.skeleton[1][1].width_m, 0.2);
  EXPECT_EQ(mast.skeleton[1][1].length_m, 0.1);
  EXPECT_EQ(spec.signals[0].priority, "stop");
}

TEST(OpenDrive, FramesAndSkeletonsThatCannotBeAreTold) {
  RoadText road;
  const std::string corners =
      R"(<outlines><outline id="0"><cornerLocal id="0" u="0" v="0"/><cornerLocal id="1" u="5" v="0"/>
          <cornerLocal id="2" u="5" v="2"/></outline></outlines>)";
  road.more = "<objects><object id=\"i\" type=\"trafficIsland\" s=\"10\" t=\"8\">" + corners +
              R"(<borders><border outlineId="1" type="curb" width="0.15"/><border outlineId="0" type="curb" width="0"/>
      <border outlineId="0" type="kurb" width="0.1"/><border outlineId="0" type="curb" width="0.1"
        useCompleteOutline="false"><cornerReference id="0"/></border>
        <border outlineId="0" type="curb" width="0.1" useCompleteOutline="false"><cornerReference id="0"/>
        <cornerReference id="9"/></border>
      <border outlineId="0" type="curb" width="0.1"><cornerReference id="0"/></border></borders>
      <skeleton><polyline><vertexLocal u="0" v="0" z="0" radius="0.1"/></polyline><polyline>
        <vertexLocal u="0" v="0" z="0" radius="0.1"/><vertexLocal u="0" v="0" z="1" width="0.1" length="0.1"/>
        </polyline>
      <polyline><vertexLocal u="0" v="0" z="0" radius="0.1"/><vertexRoad s="10" t="8" dz="1" radius="0.1"/></polyline>
        <polyline><vertexLocal u="0" v="0" z="0"/><vertexLocal u="0" v="0" z="1"/></polyline></skeleton></object>
        </objects>)";
  const Import import = MustImport(Document(road.Text()));
  std::vector<std::string> said;
  for (const Finding& warning : import.warnings) said.push_back(warning.Text());
  const std::string points =
      "road.object.skeleton.use_radius_or_width_length: road 1, s 10: a skeleton's line of the object 'i' has points "
      "without a radius, or a width and a length, above 0; all were expected to have the one, or all the other: it is "
      "not drawn";
  EXPECT_THAT(said, testing::UnorderedElementsAre(
                        "road.object.borders.outline_id: road 1, s 10: a border of the object 'i' is of the outline "
                        "'1', which it has not: it is not drawn",
                        "road.object.borders: road 1, s 10: a border of the object 'i' is 0 m wide: it is not drawn",
                        "road.object.borders: road 1, s 10: a border of the object 'i' is of the type 'kurb'; did you "
                        "mean 'curb'?: it is not drawn",
                        "road.object.borders: road 1, s 10: a border of the object 'i' names 1 corners of its outline; "
                        "two at least were expected: it is not drawn",
                        "road.object.borders: road 1, s 10: a border of the object 'i' names the corner '9', which its "
                        "outline has not: it is not drawn",
                        "road.object.borders.useCompleteOutline_true: road 1, s 10: a border of the object 'i' goes "
                        "along its complete outline and names corners: it goes along all of it",
                        "road.object.skeleton.polyline_followed_by_vertex: road 1, s 10: a skeleton's line of the "
                        "object 'i' has 1 points; two at least were expected: it is not drawn",
                        points,
                        "road.object.skeleton.vertex_road.polyline_elements: road 1, s 10: a skeleton's line of the "
                        "object 'i' has both <vertexRoad> and <vertexLocal>: it is not drawn",
                        points));
  EXPECT_EQ(import.network->roads()[0].spec().objects[0].borders.size(), 1u);
  EXPECT_TRUE(import.network->roads()[0].spec().objects[0].skeleton.empty());
}

}  // namespace
}  // namespace rodeira::opendrive
