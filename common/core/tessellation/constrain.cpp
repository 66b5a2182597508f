// SPDX-License-Identifier: Apache-2.0
// Sides that stay (S. W. Sloan, "A fast algorithm for generating constrained Delaunay triangulations", 1993).
#include <algorithm>
#include <deque>

#include "common/core/base/assert.hpp"
#include "common/core/tessellation/triangulation.hpp"

namespace rodeira::tessellation {

// The side from a to b, in the triangle to its left (or, on the square's edge, from b to a); none where there is none.
Triangulation::Side Triangulation::SideBetween(std::uint32_t a, std::uint32_t b) const {
  const auto corner_of = [&](std::uint32_t triangle) {
    const auto& corner = triangles_[triangle].corner;
    return static_cast<std::size_t>(std::find(corner.begin(), corner.end(), a) - corner.begin());
  };
  std::uint32_t at = at_[a];
  do {  // counter-clockwise around a
    const std::size_t k = corner_of(at);
    const Triangle& t = triangles_[at];
    if (t.corner[(k + 1) % 3] == b) return {at, static_cast<int>(k)};
    if (t.corner[(k + 2) % 3] == b && t.across[(k + 2) % 3] == kNone) return {at, static_cast<int>((k + 2) % 3)};
    at = t.across[(k + 2) % 3];
  } while (at != kNone && at != at_[a]);
  if (at != kNone) return {};
  at = at_[a];
  while (at != kNone) {  // and clockwise, where a lies on the square's edge
    const std::size_t k = corner_of(at);
    const Triangle& t = triangles_[at];
    if (t.corner[(k + 1) % 3] == b) return {at, static_cast<int>(k)};
    at = t.across[k];
  }
  return {};
}

bool Triangulation::Fix(std::uint32_t a, std::uint32_t b) {
  while (a != b) {
    if (!FixFirst(a, b)) return false;
  }
  return true;
}

void Triangulation::Release(std::uint32_t a, std::uint32_t b) {
  const Side side = SideBetween(a, b);
  if (side.triangle == kNone) return;
  const Side back = Opposite(side);
  triangles_[side.triangle].fixed[static_cast<std::size_t>(side.k)] = false;
  if (back.triangle != kNone) triangles_[back.triangle].fixed[static_cast<std::size_t>(back.k)] = false;
  stack_.push_back(side);
  Settle();
}

// Fixes the side from a to the first point on the way to b, which becomes a.
bool Triangulation::FixFirst(std::uint32_t& a, std::uint32_t b) {
  const auto fix = [this](Side side) {
    const Side back = Opposite(side);
    triangles_[side.triangle].fixed[static_cast<std::size_t>(side.k)] = true;
    if (back.triangle != kNone) triangles_[back.triangle].fixed[static_cast<std::size_t>(back.k)] = true;
  };
  if (const Side side = SideBetween(a, b); side.triangle != kNone) {
    fix(side);
    a = b;
    return true;
  }
  // The triangle at a; the way leads through its far side.
  std::uint32_t at = at_[a];
  bool forward = true;
  std::size_t k = 0;
  while (true) {
    const Triangle& t = triangles_[at];
    k = static_cast<std::size_t>(std::find(t.corner.begin(), t.corner.end(), a) - t.corner.begin());
    const std::uint32_t right = t.corner[(k + 1) % 3], left = t.corner[(k + 2) % 3];
    const std::int64_t to_right = TurnAt(a, b, right), to_left = TurnAt(a, b, left);
    for (const auto& [turn, corner] : {std::pair(to_right, right), std::pair(to_left, left)}) {
      const GridPoint o = points_[a], p = points_[b], q = points_[corner];
      const bool ahead =
          static_cast<std::int64_t>(p.x - o.x) * (q.x - o.x) + static_cast<std::int64_t>(p.y - o.y) * (q.y - o.y) > 0;
      if (turn == 0 && ahead) {
        fix(SideBetween(a, corner));
        a = corner;
        return true;
      }
    }
    if (to_right < 0 && to_left > 0) break;
    std::uint32_t next = t.across[forward ? (k + 2) % 3 : k];
    if (next == kNone && forward) {
      forward = false;
      next = triangles_[at_[a]].across[static_cast<std::size_t>(
          std::find(triangles_[at_[a]].corner.begin(), triangles_[at_[a]].corner.end(), a) -
          triangles_[at_[a]].corner.begin())];
    }
    RODEIRA_ASSERT(next != kNone && (!forward || next != at_[a]));
    at = next;
  }
  // Through the triangles to b or to the first point on the way.
  std::vector<std::array<std::uint32_t, 2>> crossed;
  Side side{at, static_cast<int>((k + 1) % 3)};
  while (true) {
    const auto j = static_cast<std::size_t>(side.k);
    const Triangle& t = triangles_[side.triangle];
    if (t.fixed[j] || t.across[j] == kNone) return false;
    crossed.push_back({t.corner[j], t.corner[(j + 1) % 3]});
    const Side back = Opposite(side);
    const std::uint32_t apex = triangles_[back.triangle].corner[static_cast<std::size_t>((back.k + 2) % 3)];
    const std::int64_t turn = TurnAt(a, b, apex);
    if (apex == b || turn == 0) {
      const bool done = Force(a, apex, std::move(crossed));
      if (!done) return false;
      fix(SideBetween(a, apex));
      a = apex;
      return true;
    }
    // `back` goes from left to right; the side after it ends at the apex.
    side = {back.triangle, turn > 0 ? (back.k + 1) % 3 : (back.k + 2) % 3};
  }
}

// Flips the sides that the way from a to b crosses until it is a side itself.
bool Triangulation::Force(std::uint32_t a, std::uint32_t b, std::vector<std::array<std::uint32_t, 2>> crossed) {
  std::deque<std::array<std::uint32_t, 2>> open(crossed.begin(), crossed.end());
  std::vector<std::array<std::uint32_t, 2>> fresh;
  std::size_t idle = 0;
  while (!open.empty()) {
    const auto [u, v] = open.front();
    open.pop_front();
    const Side side = SideBetween(u, v);
    RODEIRA_ASSERT(side.triangle != kNone);
    const Side back = Opposite(side);
    const std::uint32_t c = triangles_[side.triangle].corner[static_cast<std::size_t>((side.k + 2) % 3)];
    const std::uint32_t d = triangles_[back.triangle].corner[static_cast<std::size_t>((back.k + 2) % 3)];
    const std::uint32_t from = triangles_[side.triangle].corner[static_cast<std::size_t>(side.k)];
    const std::uint32_t to = triangles_[side.triangle].corner[static_cast<std::size_t>((side.k + 1) % 3)];
    const bool convex = TurnAt(c, from, d) > 0 && TurnAt(d, to, c) > 0;
    if (!convex) {
      open.push_back({u, v});
      if (++idle > 2 * open.size() + 8) return false;
      continue;
    }
    idle = 0;
    Flip(side);
    const bool ends = c == a || c == b || d == a || d == b;
    const std::int64_t to_c = TurnAt(a, b, c), to_d = TurnAt(a, b, d);
    if (!ends && ((to_c > 0 && to_d < 0) || (to_c < 0 && to_d > 0)))
      open.push_back({c, d});
    else
      fresh.push_back({c, d});
  }
  // The side itself must stay while its surroundings become Delaunay's again.
  const Side done = SideBetween(a, b);
  RODEIRA_ASSERT(done.triangle != kNone);
  const Side back = Opposite(done);
  triangles_[done.triangle].fixed[static_cast<std::size_t>(done.k)] = true;
  triangles_[back.triangle].fixed[static_cast<std::size_t>(back.k)] = true;
  for (const auto& [c, d] : fresh) {
    if (const Side side = SideBetween(c, d); side.triangle != kNone) stack_.push_back(side);
  }
  Settle();
  return true;
}

}  // namespace rodeira::tessellation
