// SPDX-License-Identifier: Apache-2.0
// FILE.motors.yaml: what an author wrote stays, whatever is edited beside it.
#include "common/world/traffic_map/companion_text.hpp"

#include <gtest/gtest.h>

#include "tests/common/editor/drawing.hpp"

namespace rodeira::traffic_map {
namespace {

const std::string kText =
    "# the bridge over the river\nrodeira: motors/1\n\n# surveyed in May\nheights_m:   # m\n  3: [0, 0, 6, 6]   # "
    "abutment\n  4: [0.0, 0, 6, 6]\n"
    "lights:  # by day\n  - phases:\n      - {green: [1], for_s: 25}   # main road\n      - {green: [2], for_s: 20}\n"
    "# signs by the council\nsigns:\n  - lane: 2\n    kind: give_way\n";

Heights Read(const std::string& text) {
  const auto heights = ParseHeights(text, "x.motors.yaml");
  EXPECT_TRUE(heights.ok()) << (heights.ok() ? "" : heights.error().Text());
  return heights.ok() ? heights.value() : Heights{};
}

TEST(Companion, UneditedKeepsItsBytes) { EXPECT_EQ(CompanionText(Read(kText), Read(kText), kText), kText); }

TEST(Companion, OnlyWhatIsEditedIsWrittenAnewAndNoCommentIsLost) {
  Heights now = Read(kText);
  now.curves.push_back({7, {1, 2, 3, 4.5}, 0});
  now.flows.push_back({1, 300.0, 0});
  EXPECT_EQ(
      CompanionText(now, Read(kText), kText),
      "# the bridge over the river\nrodeira: motors/1\n# surveyed in May\n# m\nheights_m:\n  3: [0, 0, 6, 6]   # "
      "abutment\n  4: [0.0, 0, 6, 6]\n  7: [1, 2, 3, 4.5]\n"
      "lights:  # by day\n  - phases:\n      - {green: [1], for_s: 25}   # main road\n      - {green: [2], for_s: 20}\n"
      "# signs by the council\nsigns:\n  - lane: 2\n    kind: give_way\nflows_vehph:\n  1: 300\n");
  now = Read(kText);
  now.lights[0].phases[1].green_s = 30.0;
  now.curves[0].z_m = {};
  const std::string text = CompanionText(now, Read(kText), kText);
  for (const char* comment :
       {"# the bridge", "# surveyed", "# m\n", "# abutment", "# by day", "# main road", "# signs by"})
    EXPECT_NE(text.find(comment), std::string::npos) << comment << text;
  EXPECT_EQ(CompanionText(Read(text)), CompanionText(now));
}

TEST(Companion, WhatIsNoListOfLinesIsWrittenWhole) {
  const std::string flow = "{rodeira: motors/1, heights_m: {3: [0, 0, 6, 6]}}\n";
  Heights now = Read(flow);
  EXPECT_EQ(CompanionText(now, Read(flow), flow), flow);
  now.curves[0].z_m[0] = 1.0;
  EXPECT_EQ(CompanionText(now, Read(flow), flow), "rodeira: motors/1\nheights_m:\n  3: [1, 0, 6, 6]\n");
}

TEST(Companion, NewTextSaysTheSame) {
  Heights all = Read(kText);
  all.flows = {{1, 120.5, 0}, {4, 3000.0, 0}};
  all.signs.push_back({1, SignKind::kSpeedLimit, 12.25, 30.0, 0});
  all.signs.push_back({1, SignKind::kPriority, 0.0, 0.0, 0});
  all.lights[0].offset_s = 7.5;
  all.lights[0].phases[1].green = {"2", "it's [3], #4"};
  const Heights again = Read(CompanionText(all));
  EXPECT_EQ(CompanionText(again), CompanionText(all));
  ASSERT_EQ(again.signs.size(), 3u);
  EXPECT_EQ(again.signs[1].limit_kmh, 30.0);
  EXPECT_EQ(again.signs[1].before_end_m, 12.25);
  EXPECT_EQ(again.signs[2].kind, SignKind::kPriority);
  EXPECT_EQ(again.flows[1].vehph, 3000.0);
  EXPECT_EQ(again.lights[0].offset_s, 7.5);
  EXPECT_EQ(again.lights[0].phases[1].green, all.lights[0].phases[1].green);
  EXPECT_EQ(CompanionText(Heights{}), "");
}

TEST(Companion, WhatIsWrongIsSaid) {
  const auto refused = [](const std::string& lines) {
    const auto heights = ParseHeights("rodeira: motors/1\n" + lines, "x.motors.yaml");
    return heights.ok() ? std::string() : heights.error().Text();
  };
  EXPECT_NE(refused("signs:\n  - {lane: 1, kind: giveway}\n").find("x.motors.yaml:3"), std::string::npos);
  EXPECT_NE(refused("signs:\n  - {lane: 1, kind: giveway}\n").find("give_way"), std::string::npos);
  EXPECT_NE(refused("signs:\n  - {lane: 1, kind: speed_limit}\n").find("limit_kmh"), std::string::npos);
  EXPECT_NE(refused("flows_vehph:\n  one: 20\n").find("'one' is not a lane's number"), std::string::npos);
  EXPECT_NE(refused("flows_vehph:\n  1: -20\n").find("x.motors.yaml:3"), std::string::npos);
}

}  // namespace
}  // namespace rodeira::traffic_map
