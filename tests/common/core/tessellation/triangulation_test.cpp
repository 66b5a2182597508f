// SPDX-License-Identifier: Apache-2.0
#include "common/core/tessellation/triangulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "common/core/base/random.hpp"
#include "common/core/tessellation/noding.hpp"

namespace rodeira::tessellation {
namespace {

constexpr std::int32_t kSize = 1 << 21;

std::int32_t Draw(std::uint64_t seed, std::uint64_t n, std::uint64_t what, std::int32_t most) {
  return static_cast<std::int32_t>(base::RandomUniform({seed, n, what}, 0.0, most));
}

// Everything that must hold of any triangulation of the square, counted anew.
void ExpectWhole(const Triangulation& t, bool delaunay) {
  std::int64_t area = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (std::uint32_t i = 0; i < t.triangles().size(); ++i) {
    const auto& triangle = t.triangles()[i];
    const auto& p = t.points();
    const std::int64_t turn = Turn(p[triangle.corner[0]], p[triangle.corner[1]], p[triangle.corner[2]]);
    ASSERT_GT(turn, 0) << "triangle " << i;
    area += turn;
    for (std::size_t k = 0; k < 3; ++k) {
      ++sides[{triangle.corner[k], triangle.corner[(k + 1) % 3]}];
      if (triangle.across[k] == Triangulation::kNone) continue;
      const auto& beyond = t.triangles()[triangle.across[k]];
      const auto back = std::find(beyond.across.begin(), beyond.across.end(), i) - beyond.across.begin();
      ASSERT_LT(back, 3);
      EXPECT_EQ(beyond.fixed[static_cast<std::size_t>(back)], triangle.fixed[k]);
      const std::uint32_t d = beyond.corner[static_cast<std::size_t>((back + 2) % 3)];
      if (delaunay && !triangle.fixed[k]) {
        EXPECT_FALSE(InCircle(p[triangle.corner[0]], p[triangle.corner[1]], p[triangle.corner[2]], p[d]))
            << "triangle " << i;
      }
    }
  }
  EXPECT_EQ(area, 2 * static_cast<std::int64_t>(kSize) * kSize);  // no hole, nothing twice
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    const auto on_edge = [&](std::uint32_t i) {
      const GridPoint q = t.points()[i];
      return q.x == 0 || q.y == 0 || q.x == kSize || q.y == kSize;
    };
    if (sides.contains({side.second, side.first})) continue;
    EXPECT_TRUE(on_edge(side.first) && on_edge(side.second));
  }
}

bool IsFixed(const Triangulation& t, GridSegment segment) {
  for (const auto& triangle : t.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const GridPoint a = t.points()[triangle.corner[k]], b = t.points()[triangle.corner[(k + 1) % 3]];
      if (std::min(a, b) == segment.a && std::max(a, b) == segment.b) return triangle.fixed[k];
    }
  }
  return false;
}

TEST(Triangulation, PointsAnywhere) {
  Triangulation t(kSize);
  for (std::uint64_t n = 0; n < 2000; ++n) t.Insert({Draw(1, n, 0, kSize), Draw(1, n, 1, kSize)});
  ExpectWhole(t, true);
  EXPECT_EQ(t.triangles().size(), 2 * (t.points().size() - 4) + 2);  // Euler: no drawn point lies on the square's edge
}

// Rows and columns: circles through four points and points on sides everywhere, on the square's edge as well.
TEST(Triangulation, PointsInRows) {
  Triangulation t(kSize);
  for (std::int32_t x = 0; x <= 16; ++x) {
    for (std::int32_t y = 0; y <= 16; ++y) t.Insert({x * (kSize / 16), y * (kSize / 16)});
  }
  ExpectWhole(t, true);
  EXPECT_EQ(t.points().size(), 17u * 17u);
  EXPECT_EQ(t.triangles().size(), 2u * 16u * 16u);
  EXPECT_EQ(t.Insert({kSize / 2, kSize / 2}), t.Insert({kSize / 2, kSize / 2}));
}

TEST(Triangulation, SidesThatCrossAreRefused) {
  Triangulation t(kSize);
  EXPECT_TRUE(t.Fix(0, 2));
  EXPECT_FALSE(t.Fix(1, 3));
  EXPECT_EQ(t.Faces().size(), 2u);
  EXPECT_NE(t.Faces()[0], t.Faces()[1]);
  ExpectWhole(t, true);
}

// Lines drawn across one another, noded, are sides of the triangulation, every one of them; and points put in
// afterwards leave them where they are.
TEST(Triangulation, NodedLinesBecomeSides) {
  for (std::uint64_t seed = 10; seed < 20; ++seed) {
    std::vector<GridLine> lines;
    const std::int32_t most = seed % 2 == 0 ? kSize : 64;  // a coarse one: everything meets in grid points
    for (std::uint64_t n = 0; n < 60; ++n) {
      GridLine line;
      for (std::uint64_t k = 0; k < 4; ++k)
        line.push_back({Draw(seed, n, 2 * k, most), Draw(seed, n, 2 * k + 1, most)});
      lines.push_back(line);
    }
    const std::vector<GridSegment> segments = Node(lines);
    ASSERT_FALSE(segments.empty());
    Triangulation t(kSize);
    for (const GridSegment& segment : segments) {
      t.Insert(segment.a);
      t.Insert(segment.b);
    }
    for (const GridSegment& segment : segments)
      EXPECT_TRUE(t.Fix(t.Insert(segment.a), t.Insert(segment.b))) << "seed " << seed;
    ExpectWhole(t, true);
    for (const GridSegment& segment : segments) EXPECT_TRUE(IsFixed(t, segment)) << "seed " << seed;
    const auto faces = t.Faces();
    const auto count = *std::max_element(faces.begin(), faces.end());
    for (std::uint64_t n = 0; n < 200; ++n) t.Insert({Draw(seed + 100, n, 0, kSize), Draw(seed + 100, n, 1, kSize)});
    ExpectWhole(t, true);
    const auto more = t.Faces();
    EXPECT_EQ(*std::max_element(more.begin(), more.end()), count) << "points put in open or close a face";
    if (HasFailure()) return;
  }
}

// What a point is sought from changes nothing; and each new triangle is of the face of the one that it was cut from.
TEST(Triangulation, WhereAPointIsSoughtFromChangesNothing) {
  const std::vector<GridLine> lines = {{{1000, 1000}, {kSize - 1000, 900}, {kSize - 2000, kSize - 500}, {1000, 1000}},
                                       {{0, kSize / 2}, {kSize, kSize / 2}}};
  const std::vector<GridSegment> segments = Node(lines);
  ASSERT_GE(segments.size(), 5U);
  Triangulation plain(kSize), sought(kSize);
  for (Triangulation* t : {&plain, &sought}) {
    for (const GridSegment& segment : segments) {
      const std::uint32_t a = t->Insert(segment.a), b = t->Insert(segment.b);
      ASSERT_TRUE(t->Fix(a, b));
    }
  }
  std::vector<std::uint32_t> face_of = sought.Faces();
  for (std::uint64_t n = 0; n < 2000; ++n) {
    GridPoint p{Draw(77, n, 0, kSize), Draw(77, n, 1, kSize)};
    if (n % 5 == 0) p.y = kSize / 2;  // on a side
    if (n % 7 == 0)
      p = plain.points()[static_cast<std::size_t>(
          Draw(77, n, 2, static_cast<std::int32_t>(plain.points().size()) - 1))];  // there already
    const auto near =
        static_cast<std::uint32_t>(Draw(77, n, 3, static_cast<std::int32_t>(sought.triangles().size()) - 1));
    ASSERT_EQ(plain.Insert(p), sought.Insert(p, near)) << n;
    for (std::size_t i = face_of.size(); i < sought.triangles().size(); ++i)
      face_of.push_back(face_of[sought.CutFrom(static_cast<std::uint32_t>(i))]);
  }
  ASSERT_EQ(plain.triangles().size(), sought.triangles().size());
  for (std::size_t i = 0; i < plain.triangles().size(); ++i)
    ASSERT_EQ(plain.triangles()[i].corner, sought.triangles()[i].corner) << i;
  const std::vector<std::uint32_t> faces = sought.Faces();
  std::map<std::uint32_t, std::uint32_t> same;
  for (std::size_t i = 0; i < faces.size(); ++i)
    ASSERT_EQ(same.try_emplace(faces[i], face_of[i]).first->second, face_of[i]) << i;
}

TEST(Triangulation, FindsWhereAPointLies) {
  Triangulation t(kSize);
  for (std::uint64_t n = 0; n < 300; ++n) t.Insert({Draw(3, n, 0, kSize), Draw(3, n, 1, kSize)});
  for (std::uint64_t n = 0; n < 300; ++n) {
    const GridPoint p{Draw(4, n, 0, kSize), Draw(4, n, 1, kSize)};
    const auto& triangle = t.triangles()[t.Find(p)];
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_GE(Turn(t.points()[triangle.corner[k]], t.points()[triangle.corner[(k + 1) % 3]], p), 0);
  }
}

}  // namespace
}  // namespace rodeira::tessellation
