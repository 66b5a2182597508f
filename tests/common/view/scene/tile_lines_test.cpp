// SPDX-License-Identifier: Apache-2.0
// Lines are cut where they pass from tile to tile.
#include <gtest/gtest.h>

#include <cstdint>

#include "common/view/scene/tiles/tile_lines.hpp"

namespace rodeira::scene {
namespace {

// As far as anything may lie: hundreds of thousands of tiles in one piece of a line, from either end, on a way that is
// neither along nor across them.
TEST(TileLines, ALineAcrossAllTilesIsCutAtEachOfTheirEdges) {
  const Eigen::Vector3d from(-5e7, -1e7, 0.0), to(5e7, 1e7, 0.0);
  for (const bool back : {false, true}) {
    TileLines tiles;
    const Line3 line = back ? Line3{to, from} : Line3{from, to};
    AddToTiles({&line, 1}, tiles);
    const WorldStep a = ToSteps(line[0].head<2>()), b = ToSteps(line[1].head<2>());
    const auto passed = [](std::int64_t p, std::int64_t q) {
      return static_cast<std::size_t>(std::abs(TileOf(q) - TileOf(p)));
    };
    std::size_t pieces = 0, through_corners = 0;
    for (const auto& [key, lines] : tiles) {
      for (const tessellation::GridLine& piece : lines) {
        ASSERT_EQ(piece.size(), 2u);
        ++pieces;
        for (const tessellation::GridPoint& p : piece) {
          ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.x <= kTileSteps && p.y <= kTileSteps);
          through_corners += (p.x == 0 || p.x == kTileSteps) && (p.y == 0 || p.y == kTileSteps) ? 1 : 0;
        }
      }
    }
    EXPECT_GE(pieces + through_corners, passed(a.x, b.x) + passed(a.y, b.y) + 1);
    EXPECT_LE(pieces, passed(a.x, b.x) + passed(a.y, b.y) + 1);
  }
}

}  // namespace
}  // namespace rodeira::scene
