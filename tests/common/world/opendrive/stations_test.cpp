// SPDX-License-Identifier: Apache-2.0
// Records and things that begin where their road or lane section is not, and ids that stand twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/common/world/opendrive/sample.hpp"
#include "tests/names.hpp"

namespace rodeira::opendrive {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

struct Said {
  std::vector<std::string> errors, warnings;
};

Said WhatIsSaidOf(const std::string& content) {
  Said said;
  const auto import = Read(Document(content), "sample.xodr", Tolerance::Unrepaired());
  EXPECT_TRUE(import.ok());
  if (!import) return said;
  for (const Finding& error : import.value().errors) said.errors.push_back(error.Text());
  for (const Finding& warning : import.value().warnings) said.warnings.push_back(warning.Text());
  return said;
}

std::string LaneOf(const std::string& records) { return "<lane id=\"-1\" type=\"driving\">" + records + "</lane>"; }

TEST(Stations, RecordsBehindTheRoadsEndAreToldAsCountingNowhere) {
  RoadText road;
  road.elevation = R"(<elevation s="0" a="0"/><elevation s="600" a="1"/>)";
  EXPECT_THAT(WhatIsSaidOf(road.Text()).warnings,
              ElementsAre("road.elevation.s: road 1, s 600: <elevation> begins at s 600, behind the end of its road "
                          "(100 m): it counts nowhere"));
  road = {};
  road.lateral = R"(<superelevation s="0" a="0"/><superelevation s="101" a="0"/>)";
  EXPECT_THAT(WhatIsSaidOf(road.Text()).warnings,
              ElementsAre("road.lateral.superelevation.s: road 1, s 101: <superelevation> begins at s 101, behind the "
                          "end of its road (100 m): it counts nowhere"));
  road = {};
  road.more = R"(<type s="150" type="town"/>)";
  EXPECT_THAT(
      WhatIsSaidOf(road.Text()).warnings,
      ElementsAre(
          "road.type.s: road 1, s 150: <type> begins at s 150, behind the end of its road (100 m): it counts nowhere"));
}

TEST(Stations, RecordsBelowZeroAreErrors) {
  RoadText road;
  road.elevation = R"(<elevation s="-50" a="0"/>)";
  EXPECT_THAT(WhatIsSaidOf(road.Text()).errors,
              ElementsAre("road.elevation.s: road 1, s -50: <elevation> begins at s -50; 0 or more was expected"));
  road = {};
  road.right = LaneOf(R"(<width sOffset="-1" a="3.5"/>)");
  EXPECT_THAT(
      WhatIsSaidOf(road.Text()).errors,
      ElementsAre(
          "road.lane.width.s_offset: road 1, lane -1, s 0: <width> begins at sOffset -1; 0 or more was expected"));
}

// In a section that ends before the road does it is the section's end that counts.
TEST(Stations, OfALaneItIsItsSectionThatCounts) {
  RoadText road;
  road.right =
      LaneOf(R"(<width sOffset="0" a="3.5"/><speed sOffset="60" max="10"/>)") +
      R"(</right></laneSection><laneSection s="50"><left><lane id="1" type="driving"><width sOffset="0" a="3.5"/>
          </lane></left>
<center><lane id="0" type="none"/></center><right>)" +
      LaneOf(R"(<width sOffset="0" a="3.5"/><speed sOffset="40" max="10"/>)");
  EXPECT_THAT(WhatIsSaidOf(road.Text()).warnings,
              ElementsAre(Names("road.lane.speed.s_offset: road 1, lane -1, s 0: … <speed> … sOffset 60 … (50 m)")));
}

TEST(Stations, AFirstRecordBehindTheBeginningIsToldOnlyWhereItSaysSomething) {
  RoadText road;
  road.right = LaneOf(R"(<width sOffset="10" a="3.5"/>)");
  EXPECT_THAT(WhatIsSaidOf(road.Text()).warnings,
              ElementsAre("road.lane.width.first: road 1, lane -1, s 0: the first <width> begins at sOffset 10; 0 was "
                          "expected: up to there it is read backwards"));
  road = {};
  road.offset = R"(<laneOffset s="20" a="0" b="0.1"/>)";
  EXPECT_THAT(WhatIsSaidOf(road.Text()).warnings,
              ElementsAre("road.laneOffset.first: road 1: the first <laneOffset> begins at s 20; 0 was expected: up to "
                          "there it is read backwards"));
  road.offset = R"(<laneOffset s="20" a="0"/>)";
  EXPECT_THAT(WhatIsSaidOf(road.Text()).warnings, IsEmpty());
}

TEST(Stations, ThingsBesideTheirRoadAreTold) {
  RoadText road;
  road.more = R"(<objects><object id="a" type="tree" s="900" t="5"/><object id="b" type="tree" s="-3" t="5"/></objects>
<signals><signal id="c" s="5000" t="4" type="206" country="DE" dynamic="no"/></signals>)";
  EXPECT_THAT(
      WhatIsSaidOf(road.Text()).warnings,
      ElementsAre(
          "road.object.s: road 1, s 900: the object 'a' is at s 900, and its road goes from 0 to 100 m (2 such)",
          "road.signal.s: road 1, s 5000: the signal 'c' is at s 5000, and its road goes from 0 to 100 m"));
}

TEST(Stations, ARepeatOfLessThanNothingIsAnError) {
  RoadText road;
  road.more =
      R"(<objects><object id="a" type="tree" s="9" t="5"><repeat s="9" length="-5" distance="1"/></object></objects>)";
  EXPECT_THAT(WhatIsSaidOf(road.Text()).errors,
              ElementsAre(Names("road.object.repeat.length: road 1, s 9: … <repeat> … -5; 0 ")));
}

TEST(Stations, AnIdThatStandsTwiceIsToldWithTheFirstPlace) {
  RoadText road;
  road.more = R"(<objects><object id="a" type="tree" s="9" t="5"/><object id="a" type="tree" s="19" t="5"/></objects>)";
  EXPECT_THAT(WhatIsSaidOf(road.Text()).warnings,
              ElementsAre("ids.id_unique_in_class.object: road 1, s 19: the id 'a' stands at two objects, the first at "
                          "road 1; ids of its own were expected for each"));
}

// Whether a finding is of where a record or an object begins.
bool IsOfStations(const Finding& finding) {
  return finding.rule.ends_with(".s") || finding.rule.ends_with(".s_offset") || finding.rule.ends_with(".first");
}

// The rules of all kinds of findings have the names by which the next test knows them.
TEST(Stations, TheirRulesAreKnownByTheirNames) {
  RoadText behind, lane_behind, late, object;
  behind.elevation = R"(<elevation s="600" a="0"/>)";
  lane_behind.right = LaneOf(R"(<width sOffset="0" a="3.5"/><speed sOffset="160" max="10"/>)");
  late.right = LaneOf(R"(<width sOffset="10" a="3.5"/>)");
  object.more = R"(<objects><object id="a" type="tree" s="900" t="5"/></objects>)";
  for (const RoadText& road : {behind, lane_behind, late, object}) {
    const auto import = Read(Document(road.Text()), "sample.xodr", Tolerance::Unrepaired());
    ASSERT_TRUE(import.ok());
    EXPECT_EQ(std::ranges::count_if(import.value().warnings, IsOfStations), 1) << road.Text();
  }
}

// Of the real files two have ids that stand twice, as their authors wrote them; no record of any begins elsewhere than
// on its road.
TEST(Stations, RealFilesBeginWhereTheirRoadsAre) {
  const auto files = RealFiles();
  if (files.empty()) GTEST_SKIP() << "the real files are not there";
  std::set<std::pair<std::string, std::string>> twice;  // file and rule
  for (const auto& file : files) {
    const auto import = Load(file, {});
    ASSERT_TRUE(import.ok());
    EXPECT_TRUE(import.value().errors.empty()) << file;
    for (const Finding& warning : import.value().warnings) {
      EXPECT_FALSE(IsOfStations(warning)) << file << ": " << warning.Text();
      if (warning.rule.starts_with("ids.")) twice.emplace(file.stem().string(), warning.rule);
    }
  }
  EXPECT_THAT(twice, ElementsAre(std::pair("esmini_multi_intersections", "ids.id_unique_in_class.signal"),
                                 std::pair("esmini_straight_500m_signs", "ids.id_unique_in_class.object"),
                                 std::pair("esmini_straight_500m_signs", "ids.id_unique_in_class.signal")));
}

}  // namespace
}  // namespace rodeira::opendrive
