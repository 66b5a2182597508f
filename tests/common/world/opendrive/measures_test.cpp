// SPDX-License-Identifier: Apache-2.0
// Numbers that are a slip of the hand: measures beyond all that is built, and counts without end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "common/world/network/marking.hpp"
#include "common/world/network/placing.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::opendrive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> Texts(const std::vector<Finding>& findings) {
  std::vector<std::string> texts;
  for (const Finding& finding : findings) texts.push_back(finding.Text());
  return texts;
}

std::vector<std::string> ErrorsOf(const std::function<void(RoadText&)>& change) {
  RoadText road;
  change(road);
  const auto import = Read(Document(road.Text()), "sample.xodr", Tolerance::Unrepaired());
  EXPECT_TRUE(import.ok());
  return import ? Texts(import.value().errors) : std::vector<std::string>();
}

std::string LaneOf(const std::string& records) { return "<lane id=\"-1\" type=\"driving\">" + records + "</lane>"; }
std::string WideBy(const std::string& coefficients) { return LaneOf("<width sOffset=\"0\" " + coefficients + "/>"); }

TEST(Measures, AWidthBeyondAllThatIsBuiltIsAnErrorWhereItIs) {
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) { r.right = WideBy(R"(a="1e8")"); }),
      ElementsAre("road.lane.width: road 1, lane -1, s 0: the lane is 1e+08 m wide here; at most 1000 m was expected"));
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) { r.right = WideBy(R"(a="3.5" b="1e6")"); }),
      ElementsAre(
          "road.lane.width: road 1, lane -1, s 100: the lane is 1e+08 m wide here; at most 1000 m was expected"));
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) { r.right = WideBy(R"(a="3.5" d="10")"); }),
      ElementsAre(
          "road.lane.width: road 1, lane -1, s 100: the lane is 1e+07 m wide here; at most 1000 m was expected"));
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) { r.right = WideBy(R"(a="-1e8")"); }),
      ElementsAre(
          "road.lane.width: road 1, lane -1, s 0: the lane is -1e+08 m wide here; at most 1000 m was expected"));
  // Between the ends: 4000 u - 160 u^2 + 1.6 u^3 is 0 at u = 0 and 50, and largest at 50 / 3.
  EXPECT_THAT(ErrorsOf([](RoadText& r) {
                r.right = LaneOf(R"(<width sOffset="20" a="0" b="4000" c="-160" d="1.6"/><width sOffset="70" a="3"/>)");
              }),
              testing::Contains(
                  HasSubstr("s 0: the lane is -156800 m wide here")));  // up to where it begins it is read backwards
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) {
        r.right = LaneOf(
            R"(<width sOffset="0" a="3"/><width sOffset="20" a="0" b="4000" c="-160" d="1.6"/>
                <width sOffset="70" a="3"/>)");
      }),
      ElementsAre(
          "road.lane.width: road 1, lane -1, s 36.6667: the lane is 29629.6 m wide here; at most 1000 m was expected"));
  const auto import = Read(Document([] {
                             RoadText r;
                             r.right = "\n" + WideBy(R"(a="1e8")");
                             return r.Text();
                           }()),
                           "sample.xodr", Tolerance::Unrepaired());
  ASSERT_EQ(import.value().errors.size(), 1u);
  EXPECT_EQ(import.value().errors[0].line, 13u);
}

// What a record says counts up to the next one, and within its lane section and road only.
TEST(Measures, OnlyWhereARecordCounts) {
  EXPECT_THAT(ErrorsOf([](RoadText& r) {
                r.right = LaneOf(R"(<width sOffset="0" a="0" b="0" c="3.5"/><width sOffset="1" a="3.5"/>)");
              }),
              IsEmpty());
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) { r.right = LaneOf(R"(<width sOffset="0" a="3.5"/><width sOffset="150" a="1e9"/>)"); }),
      IsEmpty());
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) { r.right = LaneOf(R"(<width sOffset="0" a="1e9"/><width sOffset="0" a="3.5"/>)"); }),
      IsEmpty());
  EXPECT_THAT(ErrorsOf([](RoadText& r) { r.right = WideBy(R"(a="1000")"); }), IsEmpty());
  EXPECT_THAT(ErrorsOf([](RoadText& r) { r.elevation = R"(<elevation s="0" a="20000"/>)"; }), IsEmpty());
}

TEST(Measures, WhateverMakesAPlaceAbsurdlyFarOrHighIsAnError) {
  const auto one = [](const std::string& text) { return ElementsAre(text); };
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) { r.offset = R"(<laneOffset s="0" a="0"/><laneOffset s="50" a="0" b="100"/>)"; }),
      one("road.lane_offset: road 1, s 100: the lanes begin 5000 m beside the line here; at most 1000 m was expected"));
  EXPECT_THAT(ErrorsOf([](RoadText& r) { r.right = LaneOf(R"(<border sOffset="0" a="-2000"/>)"); }),
              one("road.lane.border: road 1, lane -1, s 0: the lane's border lies -2000 m beside the line here; at "
                  "most 1000 m was expected"));
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) { r.elevation = R"(<elevation s="0" a="0" b="1e6"/>)"; }),
      one("road.elevation: road 1, s 100: the road is at a height of 1e+08 m here; at most 20000 m was expected"));
  EXPECT_THAT(ErrorsOf([](RoadText& r) { r.lateral = R"(<superelevation s="0" a="0" b="1"/>)"; }),
              one("road.lateral.superelevation: road 1, s 100: the superelevation is 100 rad here; at most 1.5 rad was "
                  "expected"));
  EXPECT_THAT(ErrorsOf([](RoadText& r) { r.lateral = R"(<crossfall s="0" a="2"/>)"; }),
              one("road.lateral.crossfall: road 1, s 0: the crossfall is 2 rad here; at most 1.5 rad was expected"));
  EXPECT_THAT(ErrorsOf([](RoadText& r) {
                r.lateral = R"(<crossfall side="left" s="0" a="0"/><crossfall side="right" s="10" a="2"/>)";
              }),
              one("road.lateral.crossfall: road 1, s 0: the crossfall is 2 rad here; at most 1.5 rad was expected"));
  EXPECT_THAT(ErrorsOf([](RoadText& r) { r.lateral = R"(<shape s="0" t="-4" a="0" d="1e9"/>)"; }),
              ElementsAre(HasSubstr("road.lateral.height: road 1, s 0: the road's surface lies 4.21875e+11 m above its "
                                    "line at t 3.5; at most 1000 m was expected")));
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) {
        r.lateral =
            R"(<crossSectionSurface><surfaceStrips><strip id="-1"><constant>
                <coefficients s="0" a="1e9" b="0" c="0" d="0"/></constant></strip></surfaceStrips>
                </crossSectionSurface>)";
      }),
      ElementsAre(HasSubstr("road.lateral.height: road 1, s 0: the road's surface lies 1e+09 m above its line")));
  EXPECT_THAT(ErrorsOf([](RoadText& r) {
                r.right = LaneOf(R"(<width sOffset="0" a="3.5"/><height sOffset="30" inner="0" outer="1e9"/>)");
              }),
              one("road.lane.height: road 1, lane -1, s 30: the lane lies 1e+09 m above the road here; at most 100 m "
                  "was expected"));
  EXPECT_THAT(ErrorsOf([](RoadText& r) {
                r.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="100"><arc curvature="100"/></geometry>)";
              }),
              one("road.geometry.shape: road 1, s 0: this element turns 1592 times; at most 20 were expected"));
}

// Each of many lanes may be wide, and all together may not lie in another town.
TEST(Measures, TheLanesOfASideTogether) {
  std::string right;
  for (int id = 1; id <= 11; ++id)
    right += fmt::format("<lane id=\"{}\" type=\"driving\"><width sOffset=\"0\" a=\"950\"/></lane>", -id);
  EXPECT_THAT(ErrorsOf([&](RoadText& r) { r.right = right; }),
              ElementsAre("road.lane.width: road 1, s 0: the lanes on the right reach 10450 m from the line; at most "
                          "10000 m was expected"));
}

TEST(Measures, Marks) {
  const auto mark = [](const std::string& lines, const std::string& width = "0.12") {
    return LaneOf(R"(<width sOffset="0" a="3.5"/><roadMark sOffset="5" type="solid" color="white" width=")" + width +
                  "\">" + lines + "</roadMark>");
  };
  EXPECT_THAT(
      ErrorsOf([&](RoadText& r) { r.right = mark("", "1e9"); }),
      ElementsAre(
          "road.lane.roadMark: road 1, lane -1, s 5: <roadMark> has a width of 1e+09 m; at most 100 m was expected"));
  EXPECT_THAT(
      ErrorsOf([&](RoadText& r) {
        r.right = mark(
            R"(<type name="x" width="0.1"><line length="3" space="6" tOffset="1e9" sOffset="0" width="1e9"/></type>)");
      }),
      ElementsAre(
          "road.lane.roadMark: road 1, lane -1, s 5: <line> has a width of 1e+09 m; at most 100 m was expected",
          "road.lane.roadMark: road 1, lane -1, s 5: <line> has a tOffset of 1e+09 m; at most 1000 m was expected"));
  EXPECT_THAT(ErrorsOf([&](RoadText& r) { r.right = mark(R"(<sway ds="0" a="0" b="1e6"/>)"); }),
              ElementsAre(HasSubstr("the mark lies 1e+08 m beside its place here; at most 1000 m was expected")));
}

std::string Broken(double length_m, double space_m) {
  return LaneOf(fmt::format(
      R"(<width sOffset="0" a="3.5"/><roadMark sOffset="0" type="broken" color="white" width="0.12">
          <type name="x" width="0.1"><line length="{}" space="{}" tOffset="0" sOffset="0"/></type></roadMark>)",
      length_m, space_m));
}

TEST(Measures, DashesWithoutEndAreALine) {
  RoadText road;
  road.right = Broken(1e-7, 1e-7);
  const Import import = MustImport(Document(road.Text()));
  EXPECT_THAT(Texts(import.warnings),
              ElementsAre("road.lane.roadMark: road 1, lane -1, s 0: the dashes of a line and the gaps between them "
                          "are 2e-07 m long together; 0.1 m at least were expected: it is painted without gaps"));
  const network::Road& read = import.network->roads()[0];
  const auto markings = network::MarkingsOf(read);
  ASSERT_EQ(markings.size(), 1u);
  EXPECT_EQ(network::StrokesOf(read, markings[0]).size(), 1u);
  road.right = Broken(0.05, 0.05);
  const Import fine = MustImport(Document(road.Text()));
  EXPECT_THAT(fine.warnings, IsEmpty());
  EXPECT_NEAR(
      static_cast<double>(
          network::StrokesOf(fine.network->roads()[0], network::MarkingsOf(fine.network->roads()[0])[0]).size()),
      1000.0, 1.0);
}

std::string ObjectOf(const std::string& attributes, const std::string& within = "") {
  return R"(<objects><object id="o" type="crosswalk" s="50" )" + attributes + ">" + within + "</object></objects>";
}

TEST(Measures, Things) {
  const auto one = [](std::string_view thing, std::string_view element, std::string_view measure, double most) {
    return ElementsAre(
        fmt::format("road.{}.measures: road 1, s 50: <{}> has a {} of 1e+09 m; at most {:.6g} m was expected", thing,
                    element, measure, most));
  };
  for (const std::string measure : {"t", "zOffset", "length", "width", "height", "radius"})
    EXPECT_THAT(
        ErrorsOf([&](RoadText& r) { r.more = ObjectOf((measure == "t" ? "" : "t=\"8\" ") + measure + "=\"1e9\""); }),
        one("object", "object", measure, 1e4));
  for (const std::string measure : {"tEnd", "zOffsetEnd", "heightEnd", "widthEnd", "lengthEnd", "radiusEnd", "tStart",
                                    "zOffsetStart", "heightStart", "widthStart", "lengthStart", "radiusStart"})
    EXPECT_THAT(ErrorsOf([&](RoadText& r) {
                  r.more =
                      ObjectOf("t=\"8\"", "<repeat s=\"0\" length=\"100\" distance=\"10\" " + measure + "=\"1e9\"/>");
                }),
                one("object", "repeat", measure, 1e4));
  EXPECT_THAT(
      ErrorsOf([](RoadText& r) {
        r.more = ObjectOf(
            "t=\"8\"",
            R"(<outline><cornerLocal u="1e9" v="0"/><cornerLocal u="0" v="1"/><cornerLocal u="0" v="0"/></outline>)");
      }),
      one("object", "cornerLocal", "u", 1e4));
  EXPECT_THAT(ErrorsOf([](RoadText& r) {
                r.more = ObjectOf(
                    "t=\"8\"",
                    R"(<outlines><outline><cornerRoad s="0" t="1e9"/><cornerRoad s="1" t="0"/><cornerRoad s="0" t="0"/>
                </outline></outlines>)");
              }),
              one("object", "cornerRoad", "t", 1e4));
  EXPECT_THAT(ErrorsOf([](RoadText& r) {
                r.more = ObjectOf("t=\"8\"",
                                  R"(<skeleton><polyline id="0"><vertexLocal u="0" v="0" z="0" radius="1e9"/>
                <vertexLocal u="1" v="0" z="0" radius="1"/></polyline></skeleton>)");
              }),
              one("object", "vertexLocal", "radius", 1e4));
  const auto sign = [](const std::string& attributes, const std::string& within = "") {
    return R"(<signals><signal id="s" type="274" country="DE" value="50" s="50" )" + attributes + ">" + within +
           "</signal></signals>";
  };
  for (const std::string measure : {"t", "zOffset", "width", "height"})
    EXPECT_THAT(
        ErrorsOf([&](RoadText& r) { r.more = sign((measure == "t" ? "" : "t=\"8\" ") + measure + "=\"1e9\""); }),
        one("signal", "signal", measure, 1e4));
  EXPECT_THAT(
      ErrorsOf([&](RoadText& r) { r.more = sign("t=\"8\"", R"(<positionInertial x="0" y="1e9" z="0" hdg="0"/>)"); }),
      one("signal", "positionInertial", "y", 5e7));
  EXPECT_THAT(ErrorsOf([](RoadText& r) {
                r.more = R"(<surface><CRG file="a.crg" sStart="0" sEnd="100" zScale="1e9"/></surface>)";
              }),
              ElementsAre("road.surface.crg: road 1, s 0: the measured surface's heights count 1e+09 times; at most "
                          "1000 times was expected"));
}

TEST(Measures, ARowWithoutEndGoesOnAsOneBody) {
  RoadText road;
  road.more = ObjectOf("t=\"8\" height=\"1\" width=\"0.2\"", R"(<repeat s="0" length="100" distance="1e-9"/>)");
  const Import import = MustImport(Document(road.Text()));
  EXPECT_THAT(Texts(import.warnings),
              ElementsAre("road.object.repeat.distance: road 1, s 50: <repeat> has a distance of 1e-09 m; 0 or at "
                          "least 0.01 m was expected: it goes on without gaps"));
  const network::Furniture furniture = network::PlaceFurniture(*import.network);
  EXPECT_TRUE(furniture.things.empty());
  EXPECT_EQ(furniture.runs.size(), 1u);
}

TEST(Measures, HeightsOfAJunction) {
  const auto import = Read(
      Document(
          RoadText().Text() +
          R"(<junction id="9"><planView><geometry s="0" x="0" y="0" hdg="0" length="100"><line/></geometry></planView>
<elevationGrid sStart="0" gridSpacing="60"><elevation center="1" left="1 1e7" right="1"/>
  <elevation center="1" left="1" right="1"/></elevationGrid></junction>)"),
      "sample.xodr", Tolerance::Unrepaired());
  ASSERT_TRUE(import.ok());
  EXPECT_THAT(Texts(import.value().errors),
              ElementsAre("junctions.elevation_grid.height: attribute 'left' of <elevation> has a height of 1e+07 m; "
                          "at most 20000 m was expected"));
}

}  // namespace
}  // namespace rodeira::opendrive
