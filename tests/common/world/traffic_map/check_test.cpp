// SPDX-License-Identifier: Apache-2.0
// The integrity check: a map without anything wrong, and each thing that can be, alone.
#include "common/world/traffic_map/check.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "common/world/traffic_map/lane_map.hpp"
#include "tests/common/world/traffic_map/sample_map.hpp"

namespace rodeira::traffic_map {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// "E x.motors:3 curve 3 map.unused_curve" of each finding, with the numbers of its sentence.
std::vector<std::string> Found(const std::string& bytes,
                               const std::string& heights_text = "rodeira: motors/1\nheights_m: {}\n") {
  const auto map = ParseMap(bytes, "x.motors");
  EXPECT_TRUE(map.ok()) << (map.ok() ? "" : map.error().Text());
  const auto heights = ParseHeights(heights_text, "x.motors.yaml");
  EXPECT_TRUE(heights.ok()) << (heights.ok() ? "" : heights.error().Text());
  std::vector<std::string> found;
  if (!map.ok() || !heights.ok()) return found;
  bool errors = false;
  for (const Finding& finding : CheckMap(map.value(), heights.value())) {
    errors = errors || finding.severity == Severity::kError;
    const std::string text = finding.Text();
    std::string line = fmt::format("{} {} {} {}", finding.severity == Severity::kError ? 'E' : 'W',
                                   finding.Place("x.motors"), text.substr(0, text.find(": ")), finding.id.text());
    static const std::regex number("-?[0-9]+([.][0-9]+)?");
    for (std::sregex_iterator at(finding.sentence.begin(), finding.sentence.end(), number), end; at != end; ++at)
      line += " " + at->str();
    found.push_back(line);
  }
  EXPECT_EQ(MakeLaneMap(map.value(), heights.value(), "x.motors").ok(), !errors);
  return found;
}

std::string With(const std::string& what, const std::string& instead) {
  std::string text = GoodMap();
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), instead);
}
std::string And(const std::string& lines) { return kGoodLines + lines + "s,10\ni\n"; }

TEST(Check, NothingIsWrong) {
  EXPECT_THAT(Found(GoodMap()), IsEmpty());
  EXPECT_THAT(Found(Figure18()), IsEmpty());
  EXPECT_THAT(Found(AppendixA15()), IsEmpty());
}

TEST(Check, ASentenceNamesTheElement) {
  const auto map = ParseMap(And("p,9,0,0,0,1,0,0,2,0,0,3,0,0\n"), "x.motors");
  ASSERT_TRUE(map.ok());
  const auto findings = CheckMap(map.value(), {});
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings.front().Text(), "curve 9: no lane uses it");
}

TEST(Check, NumbersTwice) {
  EXPECT_THAT(Found(And("p,3,0,0,0,1,0,0,2,0,0,3,0,0\n")), ElementsAre("E x.motors:12 curve 3 map.duplicate_number 3"));
  EXPECT_THAT(Found(And("l,2,3,True,3,4,False,1,2\n")), ElementsAre("E x.motors:12 lane 2 map.duplicate_number 8"));
  EXPECT_THAT(Found(And("c,1,2,False\n")), ElementsAre("E x.motors:12 connection 1 to 2 map.duplicate_connection 10"));
  EXPECT_THAT(Found(And("c,1,2,True\n")), ElementsAre("E x.motors:12 connection 1 to 2 map.duplicate_connection 10"));
}

TEST(Check, WhatIsNotThere) {
  EXPECT_THAT(Found(With("l,2,3,True", "l,2,33,True")),
              ElementsAre("E x.motors:8 lane 2 map.no_curve 33", "W x.motors:3 curve 3 map.unused_curve"));
  EXPECT_THAT(Found(With("3,4,False", "3,44,False")),
              ElementsAre("E x.motors:8 lane 2 map.no_curve 44", "W x.motors:4 curve 4 map.unused_curve"));
  EXPECT_THAT(Found(And("c,7,2,False\n")), ElementsAre("E x.motors:12 connection 7 to 2 map.no_lane 7"));
  EXPECT_THAT(Found(And("c,1,-4,False\n")), ElementsAre("E x.motors:12 connection 1 to -4 map.no_lane -4"));
}

TEST(Check, NoStartNoEnd) {
  EXPECT_THAT(Found(With("2,False,1,1\n", "2,False,1,0\n")), ElementsAre("E x.motors map map.no_start 1"));
  std::string text = With("3,4,False,1,2", "3,4,False,1,0");
  text.replace(text.find("6,False,1,2"), 11, "6,False,1,0");
  EXPECT_THAT(Found(text), ElementsAre("E x.motors map map.no_end 2", "E x.motors:8 lane 2 map.dead_end",
                                       "E x.motors:9 lane 3 map.dead_end"));
}

TEST(Check, Ways) {
  EXPECT_THAT(Found(With("c,1,3,True,0,0,0\n", "")), ElementsAre("E x.motors:9 lane 3 map.unconnected_lane"));
  EXPECT_THAT(Found(With("6,False,1,2\n", "6,False,1,0\n")), ElementsAre("E x.motors:9 lane 3 map.dead_end"));
  EXPECT_THAT(Found(And("c,2,1,False\n")), ElementsAre("W x.motors:8 lane 2 map.goes_on_behind_end",
                                                       "E x.motors:12 connection 2 to 1 map.gap 60.00 0.05"));
  EXPECT_THAT(Found(And("c,1,1,False\n")), ElementsAre("E x.motors:12 connection 1 to 1 map.connection_to_itself"));
  // A second start lane with vehicles that circle for ever with another lane, which no start lane but it leads to.
  const std::string circle = And("l,4,1,False,3,2,False,1,1\nl,5,1,False,3,2,False,1,0\nc,4,5,False\nc,5,4,False\n");
  EXPECT_THAT(Found(circle), testing::IsSupersetOf(
                                 {"E x.motors:12 lane 4 map.no_way_to_end", "W x.motors:13 lane 5 map.no_way_to_end"}));
  const std::string source = And("l,4,1,False,3,2,False,1,0\nc,4,2,False\n");
  EXPECT_THAT(Found(source), ElementsAre("W x.motors:12 lane 4 map.unreachable_lane"));
}

TEST(Check, Curves) {
  EXPECT_THAT(Found(And("p,9,0,0,0,1,0,0,2,0,0,3,0,0\n")), ElementsAre("W x.motors:12 curve 9 map.unused_curve"));
  EXPECT_THAT(Found(With("p,5,30,1,1.5,34,1,1.5,38.5,1,6,38.5,1,10", "p,5,30,1,1.5,30,2,1.5,30,3,1.5,30,4,1.5")),
              ElementsAre("E x.motors:5 curve 5 map.empty_curve"));
}

TEST(Check, Lanes) {
  EXPECT_THAT(
      Found(With("l,1,1,False,3,2,False", "l,1,1,False,3,1,False")),
      ElementsAre("E x.motors:7 lane 1 map.one_curve_on_both_sides 1", "W x.motors:2 curve 2 map.unused_curve"));
  EXPECT_THAT(Found(With("l,2,3,True", "l,2,3,False")), ElementsAre("E x.motors:8 lane 2 map.opposed_borders 3 4"));
  EXPECT_THAT(Found(With("l,1,1,False,3,2,False", "l,1,1,True,3,2,False")),
              testing::Contains("E x.motors:7 lane 1 map.opposed_borders 1 2 1 2"));
  EXPECT_THAT(Found(With("l,1,1,False,3,2,False", "l,1,1,False,3,2,True")),
              testing::Contains("E x.motors:7 lane 1 map.opposed_borders 1 2 2 1"));
  EXPECT_THAT(Found(With("l,2,3,True,3,4,False", "l,2,3,True,3,4,True")),
              testing::Contains("E x.motors:8 lane 2 map.opposed_borders 3 4"));
  EXPECT_THAT(Found(With("l,1,1,False,3,2,False", "l,1,2,False,3,1,False")),
              ElementsAre("E x.motors:7 lane 1 map.exchanged_borders 2 1"));
  EXPECT_THAT(Found(With("p,2,0,1,-1.5,", "p,2,0,1,4.5,")),
              testing::Contains("E x.motors:7 lane 1 map.crossed_borders"));
  // In the middle the left border lies at (1.5 + 3 * -0.75 + 3 * -0.75 + 1.5) / 8 = -0.1875.
  EXPECT_THAT(Found(With("p,1,0,1,1.5,10,1,1.5,20,1,1.5", "p,1,0,1,1.5,10,1,-0.75,20,1,-0.75")),
              testing::Contains("W x.motors:7 lane 1 map.narrow_lane 1.31"));
  EXPECT_THAT(Found(With("p,1,0,1,1.5,10,1,1.5,", "p,1,-1.5,1,31.5,9,1,27,")),
              testing::Contains(testing::HasSubstr(" map.wide_lane ")));
  std::string sharp = With("p,5,30,1,1.5,34,1,1.5,38.5,1,6,38.5,1,10", "p,5,30,1,1.5,30.1,1,1.5,29,1,1.5,29,1,2");
  sharp.replace(sharp.find("36,1,-1.5,41.5,1,4,41.5,1,10"), 28, "32,1,-1.5,33,1,0,33,1,2");
  EXPECT_THAT(Found(sharp), testing::Contains(testing::HasSubstr("lane 3 map.sharp_bend ")));
}

TEST(Check, Joints) {
  std::string shifted = GoodMap();  // the left border of lane 2 begins 1 m too far to the left
  shifted.replace(shifted.find("40,1,1.5,30,1,1.5"), 17, "40,1,1.5,30,1,2.5");
  EXPECT_THAT(Found(shifted), ElementsAre("E x.motors:10 connection 1 to 2 map.gap 1.00 0.05"));
  EXPECT_THAT(Found(With("34,1,1.5,38.5,1,6", "34,1,3.5,38.5,1,6")),
              testing::Contains(testing::HasSubstr("W x.motors:11 connection 1 to 3 map.kink 11.3")));
}

TEST(Check, Picture) {
  EXPECT_THAT(Found(GoodMap() + kPng2x1), IsEmpty());
  EXPECT_THAT(Found(GoodMap() + "\xff\xd8\xff\xe0\0\x04xy\xff\xc0\0\x0b\x08\0\x10\0\x20\x01\xff\xd9"s), IsEmpty());
  EXPECT_THAT(Found(GoodMap() + "\xff\xd8\xff\xe0\0\x04xy\xff\xc0\0\x0b\x08\0\x10\0\x20\x01"s),
              ElementsAre("E x.motors map map.wrong_picture 18"));
  EXPECT_THAT(Found(GoodMap() + kPng2x1.substr(0, kPng2x1.size() - 1)),
              ElementsAre(fmt::format("E x.motors map map.wrong_picture {}", kPng2x1.size() - 1)));
  EXPECT_THAT(Found(GoodMap()), IsEmpty());  // a map need have no picture, and nothing in it says that it should
  EXPECT_THAT(Found(GoodMap() + "GIF89a"), ElementsAre("E x.motors map map.wrong_picture 6"));
  EXPECT_THAT(Found(GoodMap() + kPng2x1.substr(0, 20)), ElementsAre("E x.motors map map.wrong_picture 20"));
  std::string huge = GoodMap() + kPng2x1;
  huge[GoodMap().size() + 16] = 0x7f;
  EXPECT_THAT(Found(huge), ElementsAre("E x.motors map map.large_picture 2130706434 1 16384"));
}

// A file that says more pixels than its bytes can hold, however well they are packed.
TEST(Check, APictureHoldsItsPixels) {
  const auto png = [](int side, std::size_t bytes) {
    std::string file = kPng2x1;
    for (const std::size_t at : {18u, 22u})
      file[at] = static_cast<char>(side / 256), file[at + 1] = static_cast<char>(side % 256);
    return file.insert(file.size() - 12, std::string(bytes - file.size(), '\0'));
  };
  EXPECT_THAT(Found(GoodMap() + png(16000, 100)), ElementsAre("E x.motors map map.wrong_picture 100 16000 16000"));
  const std::size_t least = (16000u * (1 + 3 * 16000u) + 1031) / 1032;  // one colour everywhere, of three bytes a pixel
  EXPECT_THAT(Found(GoodMap() + png(16000, least)), IsEmpty());
  EXPECT_THAT(Found(GoodMap() + png(16000, least - 1)).size(), 1u);
  const std::string jpeg = "\xff\xd8\xff\xc0\0\x0b\x08\x3e\x80\x3e\x80\x01\xff\xd9"s;
  EXPECT_THAT(Found(GoodMap() + jpeg), ElementsAre("E x.motors map map.wrong_picture 14 16000 16000"));
  EXPECT_THAT(Found(GoodMap() + jpeg.substr(0, 12) + std::string(500'000 - 14, '\0') + "\xff\xd9"),
              IsEmpty());  // 2000 by 2000 blocks of a bit
}

TEST(Check, PriorityIsSaidOnce) {
  const auto signs = [](const std::string& kinds) { return "rodeira: motors/1\nsigns:\n" + kinds; };
  EXPECT_THAT(Found(GoodMap(),
                    signs("  - {lane: 2, kind: stop}\n  - {lane: 2, kind: priority}\n  - {lane: 2, kind: give_way}\n")),
              ElementsAre("W x.motors.yaml:4 sign of lane 2 map.conflicting_signs 3",
                          "W x.motors.yaml:5 sign of lane 2 map.conflicting_signs 3"));
  EXPECT_THAT(Found(GoodMap(), signs("  - {lane: 1, kind: priority}\n")),
              ElementsAre("W x.motors.yaml:3 sign of lane 1 map.conflicting_signs 3"));
  EXPECT_THAT(Found(GoodMap(), signs("  - {lane: 1, kind: stop}\n  - {lane: 1, kind: speed_limit, limit_kmh: 30}\n  - "
                                     "{lane: 2, kind: give_way}\n")),
              IsEmpty());
}

TEST(Check, Heights) {
  const std::string head = "rodeira: motors/1\nheights_m:\n";
  EXPECT_THAT(Found(GoodMap(), head + "  9: [0, 0, 1, 1]\n"),
              ElementsAre("E x.motors.yaml:3 heights of curve 9 map.no_curve"));
  EXPECT_THAT(Found(GoodMap(), head + "  1: [0, 0, 2, 2]\n  2: [0, 0, 2, 2]\n"),
              ElementsAre("W x.motors:10 connection 1 to 2 map.step -2.000",
                          "W x.motors:11 connection 1 to 3 map.step -2.000"));
  // 9 m at the inner control points over 30 m: dz/dt = 27 at the beginning.
  EXPECT_THAT(Found(GoodMap(), head + "  1: [0, 9, 9, 0]\n  2: [0, 9, 9, 0]\n"),
              ElementsAre("W x.motors:7 lane 1 map.steep_lane 90"));
  for (const auto& [text, part] : {std::pair("1: [0, 0, 1]", "has 3 heights; 4 were expected"),
                                   std::pair("x: [0, 0, 0, 1]", "'x' is not a curve's number"),
                                   std::pair("1: [0, 0, 0, 1e9]", "a number from -10000 to 10000 was expected"),
                                   std::pair("01: [0, 0, 0, 1]\n  1: [0, 0, 0, 1]", "curve 1 has heights already")}) {
    const auto heights = ParseHeights(head + "  " + text + "\n", "x.motors.yaml");
    ASSERT_FALSE(heights.ok()) << text;
    EXPECT_THAT(heights.error().Text(), testing::HasSubstr(part));
  }
}

TEST(Check, FlowsBeginOnStartLanesAlone) {
  EXPECT_THAT(Found(GoodMap(), "rodeira: motors/1\nflows_vehph:\n  1: 300\n"), IsEmpty());
  EXPECT_THAT(Found(GoodMap(), "rodeira: motors/1\nflows_vehph:\n  2: 300\n"),
              ElementsAre("E x.motors.yaml:3 flow of lane 2 map.flow_at_no_start"));
}

TEST(LaneMap, EveryNumberIsResolved) {
  const auto map = MakeLaneMap(ParseMap(GoodMap() + kPng2x1, "x.motors").value(), {}, "x.motors");
  ASSERT_TRUE(map.ok());
  EXPECT_THAT(map.value().start_lanes, ElementsAre(0u));
  EXPECT_THAT(map.value().end_lanes, ElementsAre(1u, 2u));
  EXPECT_THAT(map.value().lanes[0].onward, ElementsAre(0u, 1u));
  EXPECT_THAT(map.value().lanes[2].arriving, ElementsAre(1u));
  EXPECT_FALSE(map.value().connections[0].stop);
  EXPECT_TRUE(map.value().connections[1].stop);
  EXPECT_NEAR(map.value().lanes[1].shape.At(10.0).p_W.x(), 40.0, 1e-9);
  EXPECT_NEAR(map.value().lanes[1].shape.At(10.0).width_m(), 3.0, 1e-9);
  EXPECT_EQ(map.value().picture_height_m, 100.0);
  EXPECT_EQ(map.value().picture_width_m, 200.0);
}

}  // namespace
}  // namespace rodeira::traffic_map
