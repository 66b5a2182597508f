// SPDX-License-Identifier: Apache-2.0
// What of an OpenDRIVE file is read, what is refused, and how it is told: roads, geometry, lanes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "common/core/base/files.hpp"
#include "common/world/network/marking.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/names.hpp"

namespace rodeira::opendrive {
namespace {

using testing::HasSubstr;

// The errors of a text before any is repaired, as a person sees them.
std::vector<std::string> Errors(const std::string& text, const Tolerance& tolerance = Tolerance::Unrepaired()) {
  const auto import = Read(text, "f.xodr", tolerance);
  if (!import) return {import.error().Text()};
  std::vector<std::string> errors;
  for (const Finding& error : import.value().errors) {
    errors.push_back(ToError(error, "f.xodr").Text());
    EXPECT_NE(ToError(error, "f.xodr").id.text(), "opendrive.rule_broken") << error.rule << " has no id of its own";
  }
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
    EXPECT_FALSE(import.value().network->roads().empty()) << file;
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

// Strictly each is refused by its rule; by default it is driven, and that rule's repair is named.
TEST(OpenDrive, EveryInvalidFileIsRefusedStrictlyAndRepairedByDefault) {
  const auto files = RealFiles("invalid");
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  using RulesAndKinds = std::vector<std::pair<std::string, std::string>>;
  const std::map<std::string, RulesAndKinds> expected = {
      {"asamqc_geometry_ascending_order.xodr", {{"road.geometry.elem_asc_order", "element.sorted"}}},
      {"asamqc_geometry_contact_point.xodr", {{"road.geometry.contact_point", "road.links_by_lanes"}}},
      {"asamqc_junction_needed.xodr", {{"road.linkage.is_junction_needed", "road.links_by_lanes"}}},
      {"asamqc_link_to_missing_lane.xodr", {{"road.lane.link.lanes_across_lane_sections", "lane.link_dropped"}}},
      {"asamqc_smoothness_many.xodr",
       {{"road.geometry.contact_point", "geometry.gap_bridged"},
        {"lane_smoothness.contact_point_no_horizontal_gaps", "lane.gap_driven"},
        {"lane_smoothness.contact_point_no_vertical_gaps", "surface.step_kept"}}}};
  for (const auto& file : files) {
    const auto strictly = Load(file, Tolerance::Strict()), usual = Load(file);
    ASSERT_TRUE(strictly.ok() && usual.ok()) << file;
    EXPECT_EQ(strictly.value().network, nullptr) << file;
    EXPECT_NE(usual.value().network, nullptr) << file;
    EXPECT_TRUE(usual.value().errors.empty()) << file;
    const auto known = expected.find(file.filename());
    ASSERT_TRUE(known != expected.end()) << file << " is not in this test's table";
    for (const auto& [rule, kind] : known->second) {
      const auto has = [&rule = rule](const std::vector<Finding>& findings, const std::string& name) {
        return std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) {
          return finding.rule == rule && finding.repair.Name() == name;
        });
      };
      EXPECT_TRUE(has(strictly.value().errors, "")) << file << " " << rule;
      EXPECT_TRUE(has(usual.value().warnings, kind)) << file << " " << rule << " " << kind;
    }
  }
}

TEST(OpenDrive, AnErrorHasTheIdOfItsRule) {
  const auto id = [](const std::string& rule) {
    Finding finding;
    finding.rule = rule;
    return std::string(ToError(finding, "f.xodr").id.text());
  };
  EXPECT_EQ(id("core.once"), "opendrive.core_once");
  EXPECT_EQ(id("road.lane.roadMark"), "opendrive.road_lane_roadmark");
  EXPECT_EQ(id("road.object.borders.useCompleteOutline_true"), "opendrive.road_object_borders_usecompleteoutline_true");
  EXPECT_EQ(id("road.geometry.elem_asc_order"), "opendrive.road_geometry_elem_asc_order");
  // Parts that are names of elements and attributes are left out.
  EXPECT_EQ(id("road.lane.width.first"), "opendrive.road_lane_first");
  EXPECT_EQ(id("road.lanes.first"), "opendrive.road_first");
  EXPECT_EQ(id("ids.id_unique_in_class"), "opendrive.ids_id_unique_in_class");
  EXPECT_EQ(id("ids.id_unique_in_class.signal"), "opendrive.ids_id_unique_in_class");
  // Such a part has no dot and is not empty.
  EXPECT_EQ(id("road.lane.width.more.first"), "opendrive.rule_broken");
  EXPECT_EQ(id("road..first"), "opendrive.rule_broken");
  EXPECT_EQ(id("no.such.rule"), "opendrive.rule_broken");
}

// The page is written from the sources; the rules here are those that real files break.
TEST(OpenDrive, EveryRuleThatARealFileBreaksIsListed) {
  auto files = RealFiles();
  const auto invalid = RealFiles("invalid");
  files.insert(files.end(), invalid.begin(), invalid.end());
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  const std::string page = base::ReadText(SourceDir() + "/docs/reference/opendrive-rules.md").value();
  std::set<std::string> broken;
  for (const auto& file : files) {
    const auto import = Load(file, Tolerance::Unrepaired());
    ASSERT_TRUE(import.ok()) << import.error().Text();
    for (const auto* findings : {&import.value().errors, &import.value().warnings})
      for (const Finding& finding : *findings) broken.insert(finding.rule);
  }
  EXPECT_GT(broken.size(), 10U);
  const auto has = [&](const std::string& text) { return page.find(text) != std::string::npos; };
  // The page has `{}` for a part of a name that stands in no source.
  const auto is_listed = [&](const std::string& rule) {
    if (has("| `" + rule + "` |")) return true;
    for (std::size_t dot = rule.find('.'); dot != std::string::npos; dot = rule.find('.', dot + 1)) {
      const std::size_t end = std::min(rule.find('.', dot + 1), rule.size());
      if (has("| `" + rule.substr(0, dot) + ".{}" + rule.substr(end) + "` |")) return true;
    }
    return false;
  };
  for (const std::string& rule : broken) EXPECT_TRUE(is_listed(rule)) << rule;
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
  EXPECT_THAT(with([](RoadText& r) {
                r.geometry = R"(<geometry s="0" x="zero" y="0" hdg="0" length="100"><line/></geometry>)";
              }),
              testing::ElementsAre(Names("f.xodr:6: xml.attribute: road 1, s 0: … 'x' of <geometry> … 'zero'")));
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
  EXPECT_THAT(Errors("<OpenSCENARIO/>"), testing::ElementsAre(Names("<OpenSCENARIO> … <OpenDRIVE>")));
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
  EXPECT_THAT(errors_of(road, "<road id=\"1\" length=\"abc\""),
              testing::ElementsAre(Names("xml.attribute: road 1: … 'length' of <road> … 'abc'")));
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
  EXPECT_THAT(said, testing::UnorderedElementsAre(
                        std::pair(std::string("not_read: the attribute 'perpToRoad' of <object> is not read (2 times)"),
                                  line_of("perpToRoad")),
                        std::pair(std::string("not_read: <surface> of <object> is not read"), line_of("<surface")),
                        std::pair(std::string("not_read: the attribute 'lighting' of <tunnel> is not read"),
                                  line_of("<tunnel")),
                        std::pair(std::string("not_read: <reference> of <signal> is not read"), line_of("<reference")),
                        testing::Pair(Names("not_read: … <junctionGroup> of <OpenDRIVE>"), line_of("<junctionGroup"))));
}

}  // namespace
}  // namespace rodeira::opendrive
