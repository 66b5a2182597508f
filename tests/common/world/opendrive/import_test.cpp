// SPDX-License-Identifier: Apache-2.0
// What of an OpenDRIVE file is read, what is refused, and how it is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/world/network/marking.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using testing::HasSubstr;

// The errors of a text before any is repaired, as a person sees them.
std::vector<std::string> Errors(const std::string& text, const Tolerance& tolerance = Tolerance::Unrepaired()) {
  const auto import = Read(text, "f.xodr", tolerance);
  if (!import) return {import.error().Text()};
  std::vector<std::string> errors;
  for (const Finding& error : import.value().errors) errors.push_back(ToError(error, "f.xodr").Text());
  EXPECT_EQ(import.value().network == nullptr, !errors.empty());
  return errors;
}

TEST(OpenDrive, EveryRealFileLoads) {
  const auto files = RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto import = Load(file);
    ASSERT_TRUE(import.ok()) << import.error().Text();
    for (const Finding& error : import.value().errors) ADD_FAILURE() << ToError(error, file).Text();
    // The lengths of the roads are those that the file says.
    for (const network::Road& road : import.value().network->roads())
      EXPECT_NEAR(road.length_m(), road.spec().length_m, 0.05) << file << " " << road.id();
  }
}

TEST(OpenDrive, EveryInvalidFileIsRefusedByItsRule) {
  const auto files = RealFiles("invalid");
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  const std::map<std::string, std::vector<std::string>> expected = {
      {"asamqc_geometry_ascending_order.xodr", {":15: road.geometry.elem_asc_order: road 1, s 100: "}},
      {"asamqc_geometry_contact_point.xodr", {":5: road.geometry.contact_point: road 1, s 50: a gap of 3.5 m"}},
      {"asamqc_junction_needed.xodr", {":6: road.linkage.is_junction_needed: road 1, s 10: roads 2 and 3 both"}},
      {"asamqc_link_to_missing_lane.xodr",
       {"road.lane.link.lanes_across_lane_sections: road 1, lane 3, s 50: the lane's predecessor is lane 4",
        "road.lane.link.lanes_across_lane_sections: road 1, lane -3, s 50: the lane's predecessor is lane -4"}},
      {"asamqc_smoothness_many.xodr",
       {"road.geometry.contact_point: road 0, s 8.70392: a gap of 0.1002 m",
        "lane_smoothness.contact_point_no_horizontal_gaps: road 9, lane -1, s 101.094: a gap of 0.05489 m"}}};
  for (const auto& file : files) {
    const auto import = Load(file, Tolerance::Unrepaired());
    ASSERT_TRUE(import.ok()) << import.error().Text();
    EXPECT_EQ(import.value().network, nullptr) << file;
    std::string all;
    for (const Finding& error : import.value().errors) all += ToError(error, file.filename()).Text() + "\n";
    const auto known = expected.find(file.filename());
    ASSERT_TRUE(known != expected.end()) << file << " is not in this test's table; it says\n" << all;
    for (const std::string& sentence : known->second) EXPECT_THAT(all, HasSubstr(sentence));
  }
}

TEST(OpenDrive, SmallGapsAreWarningsAndStrictlyErrors) {
  RoadText road;
  road.geometry =
      R"(<geometry s="0" x="0" y="0" hdg="0" length="50"><line/></geometry>
          <geometry s="50" x="50.0015" y="0" hdg="0.0005" length="50"><line/></geometry>)";
  const auto import = MustImport(Document(road.Text()));
  ASSERT_EQ(import.warnings.size(), 2u);
  EXPECT_EQ(import.warnings[0].Text(),
            "road.geometry.contact_point: road 1, s 50: a gap of 0.0015 m to the element before; it is closed, as up "
            "to 0.05 m are (by ASAM at most 1e-06)");
  EXPECT_THAT(Errors(Document(road.Text()), Tolerance::Strict()),
              testing::ElementsAre(HasSubstr("road.geometry.contact_point: road 1, s 50"),
                                   HasSubstr("road.geometry.contact_heading: road 1, s 50")));
  road.geometry =
      R"(<geometry s="0" x="0" y="0" hdg="0" length="50"><line/></geometry>
          <geometry s="50" x="50.051" y="0" hdg="0" length="50"><line/></geometry>)";
  EXPECT_THAT(Errors(Document(road.Text())), testing::ElementsAre(HasSubstr("a gap of 0.051 m")));
}

// A graph v = 0.005 u^2 over 60 m of u, by an element that says another length: a millimetre is passed over, a little
// more is told, half of it is refused; strictly all beyond a millimetre.
TEST(OpenDrive, ACubicsLengthIsHeldAgainstItsCurves) {
  const double u = 60.0, x = 0.01 * u, length = (x * std::sqrt(1.0 + x * x) + std::asinh(x)) / 0.02;
  const auto with = [&](double said) {
    RoadText road;
    road.length = said;
    road.geometry = fmt::format(
        R"(<geometry s="0" x="0" y="0" hdg="0" length="{}">
            <paramPoly3 pRange="normalized" aU="0" bU="60" cU="0" dU="0" aV="0" bV="0" cV="18" dV="0"/></geometry>)",
        said);
    return Document(road.Text());
  };
  EXPECT_TRUE(MustImport(with(length + 0.0009)).warnings.empty());
  EXPECT_THAT(Errors(with(length + 0.0009), Tolerance::Strict()), testing::IsEmpty());
  const auto import = MustImport(with(length + 0.0011));
  ASSERT_EQ(import.warnings.size(), 1u);
  EXPECT_EQ(import.warnings[0].rule, "road.geometry.paramPoly3.length_match");
  EXPECT_THAT(Errors(with(length + 0.0011), Tolerance::Strict()),
              testing::ElementsAre(
                  HasSubstr("f.xodr:6: road.geometry.paramPoly3.length_match: road 1, s 0: the curve is 63.4")));
  EXPECT_THAT(Errors(with(2.1 * length)), testing::ElementsAre(HasSubstr("road.geometry.paramPoly3.length_match")));
}

TEST(OpenDrive, WrongThingsAreNamedWithTheirPlace) {
  const auto with = [](auto change) {
    RoadText road;
    change(road);
    return Errors(Document(road.Text()));
  };
  const auto one = [](const char* text) { return testing::ElementsAre(HasSubstr(text)); };
  EXPECT_THAT(
      with([](RoadText& r) {
        r.geometry = R"(<geometry s="0" x="zero" y="0" hdg="0" length="100"><line/></geometry>)";
      }),
      one("f.xodr:6: xml.attribute: road 1, s 0: attribute 'x' of <geometry> is 'zero'; a number was expected"));
  EXPECT_THAT(
      with([](RoadText& r) { r.geometry = R"(<geometry s="0" y="0" hdg="0" length="100"><line/></geometry>)"; }),
      one("<geometry> has no attribute 'x'"));
  EXPECT_THAT(with([](RoadText& r) {
                r.geometry = R"(<geometry s="0" x="inf" y="0" hdg="0" length="100"><line/></geometry>)";
              }),
              one("'x' of <geometry> is 'inf'"));
  EXPECT_THAT(with([](RoadText& r) { r.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="100"/>)"; }),
              one("none of line, arc, spiral, poly3 and paramPoly3"));
  EXPECT_THAT(with([](RoadText& r) { r.geometry = ""; }), one("the road has no plan view"));
  EXPECT_THAT(with([](RoadText& r) {
                r.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="100"><arc curvature="1e9"/></geometry>)";
              }),
              one("road.geometry.shape"));
  EXPECT_THAT(with([](RoadText& r) { r.length = 90.0; }),
              one("road.length: road 1: the road says 90 m, its elements have 100 m"));
  EXPECT_THAT(with([](RoadText& r) { r.right = "<lane id=\"-2\" type=\"driving\"/>"; }),
              one("lane -1 was expected on the right, and lane -2 found"));
  EXPECT_THAT(with([](RoadText& r) { r.right = "<lane id=\"1\" type=\"driving\"/>"; }),
              one("a lane on the right has the id 1; one below 0 was expected"));
  EXPECT_THAT(with([](RoadText& r) { r.right = "<lane id=\"-1\" type=\"drivin\"/>"; }),
              one("lane -1, s 0: the lane's type is 'drivin'; did you mean 'driving'?"));
  EXPECT_THAT(with([](RoadText& r) {
                r.elevation =
                    R"(<elevation s="50" a="0" b="0" c="0" d="0"/><elevation s="10" a="0" b="0" c="0" d="0"/>)";
              }),
              one("road.elevation.elem_asc_order: road 1, s 10"));
  EXPECT_THAT(
      with([](RoadText& r) { r.link = R"(<successor elementType="road" elementId="77" contactPoint="start"/>)"; }),
      one("road.linkage.id: road 1, s 100: the road's end goes on into road 77, which is not in the file"));
  EXPECT_THAT(with([](RoadText& r) { r.link = R"(<successor elementType="street" elementId="77"/>)"; }),
              one("elementType is 'street'; road or junction was expected"));
  EXPECT_THAT(with([](RoadText& r) { r.attributes = "junction=\"-1\" rule=\"UHT\""; }),
              one("rule is 'UHT'; RHT or LHT was expected"));
  EXPECT_THAT(with([](RoadText& r) { r.more = R"(<signals><signal id="a" s="5" t="x"/></signals>)"; }),
              one("s 5: attribute 't' of <signal> is 'x'"));
  EXPECT_THAT(Errors(Document("")), one("there is no <road> in the file"));
  EXPECT_THAT(Errors("<OpenDRIVE><header revMajor=\"2\" revMinor=\"0\"/>" + RoadText().Text() + "</OpenDRIVE>"),
              one("this is OpenDRIVE 2.0; 1.4 to 1.8 was expected"));
  EXPECT_THAT(Errors("<OpenDRIVE>\n<road>\n</OpenDRIVE>"), one("f.xodr:3: this is no XML"));
  EXPECT_THAT(Errors("<OpenSCENARIO/>"), one("the outermost element is <OpenSCENARIO>; <OpenDRIVE> was expected"));
  EXPECT_THAT(Errors(Document(RoadText().Text() + RoadText().Text())), one("ids.id_unique_in_class: road 1"));
}

TEST(OpenDrive, JunctionsNameWhatIsMissing) {
  RoadText way, incoming;
  incoming.id = "7";
  way.attributes = "junction=\"5\"";
  const auto errors =
      Errors(Document(incoming.Text() + way.Text() +
                      R"(<junction id="5"><connection id="0" incomingRoad="7" connectingRoad="1" contactPoint="start">
          <laneLink from="-4" to="-9"/></connection>
                                         <connection id="1" incomingRoad="8" connectingRoad="1" contactPoint="start"/>
                                        </junction>)"));
  EXPECT_THAT(errors, testing::UnorderedElementsAre(
                          HasSubstr("connection 1 of junction 5 names the road '8', which is not in the file"),
                          HasSubstr("road 1, lane -9, s 0: connection 0 of junction 5 leads to this lane"),
                          HasSubstr("road 7, lane -4, s 0: connection 0 of junction 5 comes from this lane")));
}

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

// A line that sways about the edge by 0.01 (s - 20) from s = 20 on, and from 50 on at 0.3.
TEST(OpenDrive, AMarkSwaysAboutItsEdge) {
  RoadText road;
  road.right =
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          <roadMark sOffset="20" type="solid" color="white" width="0.12">
      <sway ds="0" a="0" b="0.01" c="0" d="0"/><sway ds="30" a="0.3" b="0" c="0" d="0"/></roadMark></lane>)";
  const auto network = MustRead(Document(road.Text()));
  const auto markings = network::MarkingsOf(network->roads()[0]);
  ASSERT_EQ(markings.size(), 1u);
  EXPECT_EQ(markings[0].from_s_m, 20.0);
  EXPECT_NEAR(network::MarkingAt(network->roads()[0], markings[0], 35.0).value, -3.5 + 0.15, 1e-12);
  EXPECT_NEAR(network::MarkingAt(network->roads()[0], markings[0], 80.0).value, -3.5 + 0.3, 1e-12);
  road.right.replace(road.right.find("ds=\"30\""), 7, "ds=\"-1\"");
  EXPECT_THAT(Errors(Document(road.Text())), testing::ElementsAre(HasSubstr("road.lane.roadMark.sway.elem_asc_order")));
}

TEST(OpenDrive, PolynomialsBorderAndOldSpellings) {
  RoadText road;
  // A graph v = 0.005 u^2 by its own length, and the same curve as a parametric one of either range.
  const auto length = [](double u) {
    const double x = 0.01 * u;
    return (x * std::sqrt(1.0 + x * x) + std::asinh(x)) / 0.02;
  };
  road.length = length(60.0);
  for (const char* form :
       {R"(<poly3 a="0" b="0" c="0.005" d="0"/>)",
        R"(<paramPoly3 pRange="normalized" aU="0" bU="60" cU="0" dU="0" aV="0" bV="0" cV="18" dV="0"/>)"}) {
    road.geometry = fmt::format(R"(<geometry s="0" x="0" y="0" hdg="0" length="{}">{}</geometry>)", road.length, form);
    const auto network = MustRead(Document(road.Text()));
    const auto at = network->roads()[0].axis().Evaluate(length(40.0));
    EXPECT_NEAR(at.p_W.x(), 40.0, 1e-9) << form;
    EXPECT_NEAR(at.p_W.y(), 8.0, 1e-9) << form;
  }
  road = RoadText();
  road.right =
      R"(<lane id="-1" type="driving"><border sOffset="0" a="-3" b="0" c="0" d="0"/></lane>
          <lane id="-2" type="shoulder"><border sOffset="0" a="4.5" b="0.01" c="0" d="0"/></lane>)";
  const auto network = MustRead(Document(road.Text()));
  EXPECT_EQ(network->Span({0, 0, -1}, 50.0)->outer_t_m, -3.0);
  EXPECT_NEAR(network->Span({0, 0, -2}, 50.0)->outer_t_m, -5.0, 1e-12);
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
              sign("c", R"(type="1000001" subtype="-1" dynamic="yes")") + sign("d", R"(type="294" subtype="-1")") +
              sign("e", R"(type="1000003" subtype="-1")") + sign("f", R"(type="-1" subtype="-1")") +
              sign("g", R"(type="777" subtype="-1" height="0.03")") +
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
          HasSubstr("a mark of the object '7' names the corner 'c', which its outline has not: it is not painted"),
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
    <signals><signal id="1" s="5" t="-4" type="r1-1" subtype="-1" country="US"><semantics><priority type="stop"/>
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

// A length that is no number, or none, is one sentence.
TEST(OpenDrive, ALengthThatIsNoneIsToldOnce) {
  const auto errors_of = [](const std::string& from, const std::string& to) {
    std::string text = Document(RoadText().Text());
    text.replace(text.find(from), from.size(), to);
    const auto import = Read(text, "sample.xodr", Tolerance::Unrepaired());
    std::vector<std::string> said;
    for (const Finding& error : import.value().errors) said.push_back(error.Text());
    return said;
  };
  const std::string road = "<road id=\"1\" length=\"100\"", element = "hdg=\"0\" length=\"100\"";
  EXPECT_THAT(
      errors_of(road, "<road id=\"1\" length=\"abc\""),
      testing::ElementsAre("xml.attribute: road 1: attribute 'length' of <road> is 'abc'; a number was expected"));
  EXPECT_THAT(errors_of(road, "<road id=\"1\""),
              testing::ElementsAre("xml.attribute: road 1: <road> has no attribute 'length'"));
  EXPECT_THAT(errors_of(road, "<road id=\"1\" length=\"-5\""),
              testing::ElementsAre("road.length: road 1: the road is -5 m long"));
  EXPECT_THAT(errors_of(element, "hdg=\"0\" length=\"-1\""),
              testing::ElementsAre("road.geometry.length: road 1, s 0: an element is -1 m long"));
}

// What is passed over is said once a kind, at the first, with how often.
TEST(OpenDrive, WhatIsNotReadIsTold) {
  RoadText road;
  road.more =
      "<objects><object id=\"7\" type=\"pole\" s=\"10\" t=\"8\" perpToRoad=\"true\"><surface/></object>\n"
      "<object id=\"8\" type=\"pole\" s=\"20\" t=\"8\" perpToRoad=\"true\"/><object id=\"9\" type=\"pole\" s=\"30\" "
      "t=\"8\" perpToRoad=\"false\"/>\n<tunnel s=\"1\" length=\"9\" id=\"t\" type=\"standard\" "
      "lighting=\"0.5\"/></objects>\n"
      "<signals><signal id=\"1\" s=\"5\" t=\"-4\" type=\"206\" subtype=\"-1\"><reference elementId=\"7\" "
      "elementType=\"object\"/></signal></signals>";
  const std::string text = Document(road.Text() + "<junctionGroup id=\"1\" type=\"roundabout\"/>\n");
  const auto line_of = [&](const std::string& what) {
    return static_cast<std::size_t>(
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(what)), '\n'));
  };
  const Import import = MustImport(text);
  std::vector<std::pair<std::string, std::size_t>> said;
  for (const Finding& warning : import.warnings) said.emplace_back(warning.Text(), warning.line);
  EXPECT_THAT(
      said,
      testing::UnorderedElementsAre(
          std::pair(std::string("not_read: the attribute 'perpToRoad' of <object> is not read (2 times)"),
                    line_of("perpToRoad")),
          std::pair(std::string("not_read: <surface> of <object> is not read"), line_of("<surface")),
          std::pair(std::string("not_read: the attribute 'lighting' of <tunnel> is not read"), line_of("<tunnel")),
          std::pair(std::string("not_read: <reference> of <signal> is not read"), line_of("<reference")),
          std::pair(std::string("not_read: railways and groups of junctions are not read: <junctionGroup> of "
                                "<OpenDRIVE>"),
                    line_of("<junctionGroup"))));
}

}  // namespace
}  // namespace rodeira::opendrive
