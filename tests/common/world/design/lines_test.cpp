// SPDX-License-Identifier: Apache-2.0
// Lines of a world file: which are painted, how wide, in what strokes, where, and from where to where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/world/network/marking.hpp"
#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

using testing::HasSubstr;

constexpr double kLong_m = 120.0;

std::string RoadWith(const std::string& lines) {
  return "rodeira: world/2\nroads:\n  - id: a\n    axis: [line: {length_m: 120}]\n    z_m: 0\n"
         "    section: {lanes: [{id: -1, widths: [{s_m: 0, width_m: 3}, {s_m: 100, width_m: 4}]}, {id: 1, width_m: "
         "3}], offset_m: 0.5}\n"
         "    lines:\n" +
         lines;
}

// What of a road is painted.
struct Painted {
  std::vector<network::Marking> lines;
  std::vector<std::vector<network::Stroke>> strokes;
  Design design;  // which they live in
};
Painted PaintedBy(const std::string& lines) {
  Painted painted{{}, {}, SoundDesign(RoadWith(lines))};
  const network::Road& road = painted.design.network->roads()[0];
  for (const network::Marking& line : network::MarkingsOf(road)) {
    if (line.painted == nullptr) continue;
    painted.lines.push_back(line);
    painted.strokes.push_back(network::StrokesOf(road, line));
  }
  return painted;
}
double Middle(const Painted& painted, std::size_t line, double s_m) {
  return network::MarkingAt(painted.design.network->roads()[0], painted.lines[line], s_m).value;
}

// What docs/reference/world-roads.md says of a kind: its lines from left to right.
struct Half {
  double stroke_m, gap_m;  // a gap of 0: continuous
};
struct Kind {
  const char* name;
  double width_m;
  std::vector<Half> lines;
};
class LineKinds : public testing::TestWithParam<Kind> {};

TEST_P(LineKinds, ArePaintedAsTheyAreSaid) {
  const Kind& kind = GetParam();
  const Painted painted = PaintedBy(std::string("      - {t_m: 1, kind: ") + kind.name + "}\n");
  ASSERT_EQ(painted.lines.size(), kind.lines.size());
  for (std::size_t i = 0; i < kind.lines.size(); ++i) {
    const auto& [stroke_m, gap_m] = kind.lines[i];
    EXPECT_EQ(painted.lines[i].width_m, kind.width_m);
    EXPECT_EQ(painted.lines[i].colour, "white");
    const double aside_m =
        kind.lines.size() == 1 ? 0.0 : (i == 0 ? 0.5 : -0.5) * (0.12 + kind.width_m);  // 0.12 between the two
    EXPECT_NEAR(Middle(painted, i, 50.0), 1.0 + aside_m, 1e-12);
    const auto& strokes = painted.strokes[i];
    if (gap_m == 0.0) {
      ASSERT_EQ(strokes.size(), 1u);
      EXPECT_NEAR(strokes[0].to_s_m - strokes[0].from_s_m, kLong_m, 1e-9);
      continue;
    }
    ASSERT_EQ(strokes.size(), static_cast<std::size_t>(std::ceil(kLong_m / (stroke_m + gap_m) - 1e-9)));
    for (std::size_t k = 0; k < strokes.size(); ++k) {
      EXPECT_NEAR(strokes[k].from_s_m, static_cast<double>(k) * (stroke_m + gap_m), 1e-9);
      EXPECT_NEAR(strokes[k].to_s_m, std::min(strokes[k].from_s_m + stroke_m, kLong_m), 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, LineKinds,
    testing::Values(Kind{"continuous", 0.12, {{0, 0}}}, Kind{"dashed", 0.12, {{4, 8}}},
                    Kind{"double", 0.12, {{0, 0}, {0, 0}}}, Kind{"double_dashed", 0.12, {{4, 8}, {4, 8}}},
                    Kind{"mixed", 0.12, {{0, 0}, {4, 8}}}, Kind{"none", 0.12, {}}, Kind{"boundary", 0.15, {{0, 0}}},
                    Kind{"single", 0.12, {{0, 0}}}, Kind{"dashed_same", 0.12, {{3, 9}}},
                    Kind{"dashed_speed_ctrl", 0.3, {{1.5, 1.5}}}, Kind{"dashed_warn", 0.12, {{5, 2}}}),
    [](const auto& kind) { return std::string(kind.param.name); });

TEST(Lines, OfAMixedOneEachHalfIsSaid) {
  const Painted painted = PaintedBy(
      "      - {t_m: 0, kind: mixed, left: dashed, right: continuous, apart_m: 0.2, stroke_m: 2, gap_m: 3, width_m: "
      "0.1}\n");
  ASSERT_EQ(painted.lines.size(), 2u);
  EXPECT_NEAR(Middle(painted, 0, 10.0), 0.15, 1e-12);
  EXPECT_EQ(painted.lines[0].stroke_m, 2.0);
  EXPECT_EQ(painted.lines[0].gap_m, 3.0);
  EXPECT_NEAR(Middle(painted, 1, 10.0), -0.15, 1e-12);
  EXPECT_EQ(painted.lines[1].gap_m, 0.0);
}

TEST(Lines, HaveTheirColour) {
  for (const char* colour : {"white", "yellow", "blue", "red", "orange"}) {
    const Painted painted = PaintedBy(std::string("      - {t_m: 0, kind: continuous, colour: ") + colour + "}\n");
    ASSERT_EQ(painted.lines.size(), 1u);
    EXPECT_EQ(painted.lines[0].colour, colour);
  }
}

// Dashes are counted from the line's own beginning.
TEST(Lines, BeginAndEndWhereTheyAreSaid) {
  const Painted painted = PaintedBy(
      "      - {t_m: 0, kind: dashed, from_s_m: 30, to_s_m: 70}\n      - {t_m: 1, kind: continuous, from_s_m: 15.5, "
      "to_s_m: 16}\n");
  ASSERT_EQ(painted.strokes.size(), 2u);
  ASSERT_EQ(painted.strokes[0].size(), 4u);
  EXPECT_NEAR(painted.strokes[0].front().from_s_m, 30.0, 1e-9);
  EXPECT_NEAR(painted.strokes[0].back().from_s_m, 66.0, 1e-9);
  EXPECT_NEAR(painted.strokes[0].back().to_s_m, 70.0, 1e-9);
  ASSERT_EQ(painted.strokes[1].size(), 1u);
  EXPECT_NEAR(painted.strokes[1][0].from_s_m, 15.5, 1e-9);
  EXPECT_NEAR(painted.strokes[1][0].to_s_m, 16.0, 1e-9);
  EXPECT_THAT(FirstProblem(RoadWith("      - {t_m: 0, kind: dashed, from_s_m: 30, to_s_m: 20}\n")),
              HasSubstr("a line must end after its beginning"));
}

// On a lane's outer edge wherever that goes, where both sides meet, or between points; moved to the left by 'offset_m'.
TEST(Lines, LieWhereTheyAreSaid) {
  const Painted painted = PaintedBy(
      "      - {lane: -1, kind: continuous, offset_m: 0.2}\n      - {lane: 1, kind: continuous}\n      - {lane: 0, "
      "kind: continuous}\n"
      "      - {ts: [{s_m: 20, t_m: 1}, {s_m: 40, t_m: 2}], kind: continuous, offset_m: -0.5}\n");
  ASSERT_EQ(painted.lines.size(), 4u);
  EXPECT_NEAR(Middle(painted, 0, 0.0), 0.5 - 3.0 + 0.2, 1e-12);
  EXPECT_NEAR(Middle(painted, 0, 50.0), 0.5 - 3.5 + 0.2, 1e-12);  // half of the way from 3 to 4 m
  EXPECT_NEAR(Middle(painted, 1, 50.0), 0.5 + 3.0, 1e-12);
  EXPECT_NEAR(Middle(painted, 2, 50.0), 0.5, 1e-12);
  EXPECT_NEAR(Middle(painted, 3, 10.0), 1.0 - 0.5, 1e-12);
  EXPECT_NEAR(Middle(painted, 3, 25.0), 1.0 + 3.0 / 16.0 - 2.0 / 64.0 - 0.5, 1e-12);  // 3u^2 - 2u^3 of a quarter
  EXPECT_NEAR(Middle(painted, 3, 60.0), 2.0 - 0.5, 1e-12);
}

}  // namespace
}  // namespace rodeira::design
