// SPDX-License-Identifier: Apache-2.0
// A part of a road is the road there.
#include "common/world/design/cut.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "common/core/base/random.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/network/strokes.hpp"
#include "tests/common/world/design/made_roads.hpp"

namespace rodeira::design {
namespace {

constexpr const char* kRoad = R"(rodeira: world/2
roads:
  - id: a
    start: {x_m: 100, y_m: -50, heading_deg: 160}
    axis:
      - line: {length_m: 80}
      - clothoid: {length_m: 70, radius_end_m: 60}
      - arc: {length_m: 100, radius_m: 60}
      - clothoid: {length_m: 60, radius_start_m: 60, radius_end_m: -90}
    vertical: [{s_m: 0, z_m: 20}, {s_m: 120, z_m: 26, parabola_m: 90}, {s_m: 310, z_m: 17}]
    superelevation: [{s_m: 60, slope: 0}, {s_m: 150, slope: -0.05}, {s_m: 300, slope: 0.02}]
    section:
      template: rural
      lanes:
        - {id: -1, width_m: 3.5}
        - {id: -2, widths: [{s_m: 90, width_m: 0}, {s_m: 130, width_m: 3.25}], kerb_m: 0.1}
        - {id: 1, widths: [{s_m: 0, width_m: 3}, {s_m: 310, width_m: 4}]}
    lines:
      - {lane: 0, kind: dashed, stroke_m: 3, gap_m: 5}
    objects:
      - {type: post, side: right, from_s_m: 5, every_m: 10}
)";

// The same axis as a spline.
constexpr const char* kSpline = R"(rodeira: world/2
roads:
  - id: a
    points: {list: [[0, 0, 5], [80, 10, 7], [150, 60, 9], [220, 150, 8], [300, 160, 4]]}
    section: {template: bypass}
)";

void ExpectTheSame(const std::string& text, double from, double to) {
  const Design design = SoundDesign(text);
  const network::Road& whole = design.network->roads()[0];
  const network::Road part = Cut(whole, from, to, "part");
  EXPECT_NEAR(part.length_m(), to - from, 1e-7);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double s = base::RandomUniform({i, 1}, 0.001, part.length_m() - 0.001),
                 t = base::RandomUniform({i, 2}, -6.0, 6.0);
    const network::SurfaceSample ours = part.Surface(s, t), theirs = whole.Surface(s + from, t);
    ASSERT_NEAR((ours.p_W - theirs.p_W).norm(), 0.0, 1e-7) << s << " " << t;
    ASSERT_NEAR((ours.ds_W - theirs.ds_W).norm() + (ours.dt_W - theirs.dt_W).norm(), 0.0, 1e-6) << s << " " << t;
  }
}

TEST(Cut, APartIsTheRoadThere) {
  for (const auto& [from, to] : {std::pair(0.0, 77.0), {77.0, 101.5}, {101.5, 260.25}, {200.0, 310.0}})
    ExpectTheSame(kRoad, from, to);
}

TEST(Cut, APartOfASplineToo) {
  for (const auto& [from, to] : {std::pair(0.0, 50.0), {50.0, 300.0}, {120.0, 130.0}}) ExpectTheSame(kSpline, from, to);
}

TEST(Cut, PaintAndFurnitureStayWhereTheyWere) {
  const Design design = SoundDesign(kRoad);
  const network::Road& whole = design.network->roads()[0];
  const auto painted = [](const network::Road& road, double s) {
    for (const network::PaintedLine& line : road.spec().lines) {
      for (const network::Stroke& stroke : network::Strokes(road, line)) {
        if (s >= stroke.from_s_m && s <= stroke.to_s_m) return true;
      }
    }
    return false;
  };
  const network::Road part = Cut(whole, 100.0, 220.0, "part");
  for (double s = 0.05; s < 119.9; s += 0.1) EXPECT_EQ(painted(part, s), painted(whole, s + 100.0)) << s;
  ASSERT_EQ(part.spec().objects.size(), 1u);
  // Beside lane -2, which grows, the row has several pieces: its posts stand at s = 105, 115 … 215 of the road, each
  // once, and where they stood.
  network::NetworkSpec both;
  both.roads = {whole, part};
  const network::Network network(std::move(both));
  std::map<double, double> before, after;
  for (const network::Placed& post : network::PlaceFurniture(network).things) {
    auto& posts = post.road == 0 ? before : after;
    EXPECT_TRUE(posts.emplace(std::round(post.s_m + (post.road == 0 ? 0.0 : 100.0)), post.t_m).second) << post.s_m;
  }
  ASSERT_EQ(after.size(), 12u);
  EXPECT_GT(part.spec().objects[0].repeats.size(), 1u);
  for (const auto& [s, t] : after) {
    ASSERT_TRUE(before.contains(s)) << s;
    EXPECT_NEAR(before[s], t, 1e-9) << s;
  }
}

}  // namespace
}  // namespace rodeira::design
