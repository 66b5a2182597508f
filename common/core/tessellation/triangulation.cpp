// SPDX-License-Identifier: Apache-2.0
// The triangles, and points put into them.
#include "common/core/tessellation/triangulation.hpp"

#include "common/core/base/assert.hpp"

namespace rodeira::tessellation {

Triangulation::Triangulation(std::int32_t size) {
  RODEIRA_ASSERT(size > 0 && size <= GridPoint::kMost);
  points_ = {{0, 0}, {size, 0}, {size, size}, {0, size}};
  at_ = {0, 0, 0, 1};
  triangles_.resize(2);
  cut_from_ = {0, 0};
  triangles_[0] = {{0, 1, 2}, {kNone, kNone, 1}, {}};
  triangles_[1] = {{0, 2, 3}, {0, kNone, kNone}, {}};
}

void Triangulation::Set(std::uint32_t triangle, std::array<std::uint32_t, 3> corner,
                        std::array<std::uint32_t, 3> across, std::array<bool, 3> fixed) {
  triangles_[triangle] = {corner, across, fixed};
  for (const std::uint32_t c : corner) at_[c] = triangle;
}

// The triangle `beyond` a side now has another one across it.
void Triangulation::Meet(std::uint32_t beyond, std::uint32_t before, std::uint32_t now) {
  if (beyond == kNone) return;
  for (std::uint32_t& across : triangles_[beyond].across) {
    if (across == before) {
      across = now;
      return;
    }
  }
  RODEIRA_ASSERT(false);
}

Triangulation::Side Triangulation::Opposite(Side side) const {
  const std::uint32_t beyond = triangles_[side.triangle].across[static_cast<std::size_t>(side.k)];
  if (beyond == kNone) return {};
  for (int k = 0; k < 3; ++k) {
    if (triangles_[beyond].across[static_cast<std::size_t>(k)] == side.triangle &&
        triangles_[beyond].corner[static_cast<std::size_t>(k)] ==
            triangles_[side.triangle].corner[static_cast<std::size_t>((side.k + 1) % 3)])
      return {beyond, k};
  }
  RODEIRA_ASSERT(false);
  return {};
}

std::uint32_t Triangulation::Find(GridPoint p) const {
  std::uint32_t at = last_;
  for (std::size_t steps = 0; steps <= 3 * triangles_.size(); ++steps) {
    const Triangle& triangle = triangles_[at];
    std::uint32_t next = kNone;
    for (std::size_t k = 0; k < 3 && next == kNone; ++k) {
      const std::size_t side = (k + steps) % 3;  // a walk that always tried the same side first could go in circles
      if (triangle.across[side] != kNone &&
          Turn(points_[triangle.corner[side]], points_[triangle.corner[(side + 1) % 3]], p) < 0)
        next = triangle.across[side];
    }
    if (next == kNone) return last_ = at;
    at = next;
  }
  for (at = 0; at < triangles_.size(); ++at) {
    const Triangle& t = triangles_[at];
    if (Turn(points_[t.corner[0]], points_[t.corner[1]], p) >= 0 &&
        Turn(points_[t.corner[1]], points_[t.corner[2]], p) >= 0 &&
        Turn(points_[t.corner[2]], points_[t.corner[0]], p) >= 0)
      return last_ = at;
  }
  RODEIRA_ASSERT(false);
  return kNone;
}

std::uint32_t Triangulation::FindWithin(GridPoint p, std::uint32_t near) const {
  constexpr int kMaxSteps = 64;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Triangle& triangle = triangles_[near];
    bool within = true;
    std::uint32_t next = kNone;
    for (std::size_t k = 0; k < 3 && next == kNone; ++k) {
      const std::int64_t turn = Turn(points_[triangle.corner[k]], points_[triangle.corner[(k + 1) % 3]], p);
      within = within && turn > 0;
      if (turn < 0) next = triangle.across[k];
    }
    if (next == kNone) return within ? near : kNone;
    near = next;
  }
  return kNone;
}

std::uint32_t Triangulation::Insert(GridPoint p) { return PutIn(Find(p), p); }

// Within a triangle there is one answer. On a side there are two: then it is the one that is found without `near`.
std::uint32_t Triangulation::Insert(GridPoint p, std::uint32_t near) {
  const std::uint32_t within = FindWithin(p, near);
  if (within == kNone) return Insert(p);
  last_ = within;
  return PutIn(within, p);
}

std::uint32_t Triangulation::PutIn(std::uint32_t at, GridPoint p) {
  const Triangle triangle = triangles_[at];
  for (const std::uint32_t corner : triangle.corner) {
    if (points_[corner] == p) return corner;
  }
  const auto number = static_cast<std::uint32_t>(points_.size());
  points_.push_back(p);
  at_.push_back(kNone);
  int on = -1;
  for (int k = 0; k < 3; ++k) {
    if (Turn(points_[triangle.corner[static_cast<std::size_t>(k)]],
             points_[triangle.corner[static_cast<std::size_t>((k + 1) % 3)]], p) == 0)
      on = k;
  }
  if (on < 0)
    SplitTriangle(at, number);
  else
    SplitSide({at, on}, number);
  Settle();
  return number;
}

void Triangulation::SplitTriangle(std::uint32_t triangle, std::uint32_t p) {
  const Triangle t = triangles_[triangle];
  const auto first = static_cast<std::uint32_t>(triangles_.size());
  triangles_.resize(triangles_.size() + 2);
  cut_from_.resize(triangles_.size(), triangle);
  const std::array<std::uint32_t, 3> parts = {triangle, first, first + 1};
  for (std::size_t k = 0; k < 3; ++k) {
    Set(parts[k], {t.corner[k], t.corner[(k + 1) % 3], p}, {t.across[k], parts[(k + 1) % 3], parts[(k + 2) % 3]},
        {t.fixed[k], false, false});
    if (k > 0) Meet(t.across[k], triangle, parts[k]);
    stack_.push_back({parts[k], 0});
  }
}

void Triangulation::SplitSide(Side side, std::uint32_t p) {
  const Side back = Opposite(side);
  const auto k = static_cast<std::size_t>(side.k);
  const Triangle t = triangles_[side.triangle];
  const std::uint32_t a = t.corner[k], b = t.corner[(k + 1) % 3], c = t.corner[(k + 2) % 3];
  const auto near = static_cast<std::uint32_t>(triangles_.size()), far = near + 1;
  triangles_.resize(triangles_.size() + (back.triangle == kNone ? 1 : 2));
  cut_from_.push_back(side.triangle);
  if (back.triangle != kNone) cut_from_.push_back(back.triangle);
  const std::uint32_t across_a = back.triangle == kNone ? kNone : far, across_b = back.triangle;
  Set(side.triangle, {p, b, c}, {across_b, t.across[(k + 1) % 3], near}, {t.fixed[k], t.fixed[(k + 1) % 3], false});
  Set(near, {a, p, c}, {across_a, side.triangle, t.across[(k + 2) % 3]}, {t.fixed[k], false, t.fixed[(k + 2) % 3]});
  Meet(t.across[(k + 2) % 3], side.triangle, near);
  stack_.push_back({side.triangle, 1});
  stack_.push_back({near, 2});
  if (back.triangle == kNone) return;
  const auto l = static_cast<std::size_t>(back.k);
  const Triangle u = triangles_[back.triangle];  // from b to a, then d
  const std::uint32_t d = u.corner[(l + 2) % 3];
  Set(back.triangle, {b, p, d}, {side.triangle, far, u.across[(l + 2) % 3]}, {t.fixed[k], false, u.fixed[(l + 2) % 3]});
  Set(far, {p, a, d}, {near, u.across[(l + 1) % 3], back.triangle}, {t.fixed[k], u.fixed[(l + 1) % 3], false});
  Meet(u.across[(l + 1) % 3], back.triangle, far);
  stack_.push_back({back.triangle, 2});
  stack_.push_back({far, 1});
}

void Triangulation::Flip(Side side) {
  const Side back = Opposite(side);
  const auto k = static_cast<std::size_t>(side.k), l = static_cast<std::size_t>(back.k);
  const Triangle t = triangles_[side.triangle], u = triangles_[back.triangle];
  const std::uint32_t a = t.corner[k], b = t.corner[(k + 1) % 3], c = t.corner[(k + 2) % 3], d = u.corner[(l + 2) % 3];
  Set(side.triangle, {c, a, d}, {t.across[(k + 2) % 3], u.across[(l + 1) % 3], back.triangle},
      {t.fixed[(k + 2) % 3], u.fixed[(l + 1) % 3], false});
  Set(back.triangle, {d, b, c}, {u.across[(l + 2) % 3], t.across[(k + 1) % 3], side.triangle},
      {u.fixed[(l + 2) % 3], t.fixed[(k + 1) % 3], false});
  Meet(u.across[(l + 1) % 3], back.triangle, side.triangle);
  Meet(t.across[(k + 1) % 3], side.triangle, back.triangle);
}

void Triangulation::Settle() {
  while (!stack_.empty()) {
    const Side side = stack_.back();
    stack_.pop_back();
    const auto k = static_cast<std::size_t>(side.k);
    const Triangle& t = triangles_[side.triangle];
    if (t.fixed[k] || t.across[k] == kNone) continue;
    const Side back = Opposite(side);
    const std::uint32_t d = triangles_[back.triangle].corner[static_cast<std::size_t>((back.k + 2) % 3)];
    if (!InCircle(points_[t.corner[0]], points_[t.corner[1]], points_[t.corner[2]], points_[d])) continue;
    Flip(side);
    for (const std::uint32_t triangle : {side.triangle, back.triangle}) {
      stack_.push_back({triangle, 0});
      stack_.push_back({triangle, 1});
    }
  }
}

std::vector<std::uint32_t> Triangulation::Faces() const {
  std::vector<std::uint32_t> faces(triangles_.size(), kNone);
  std::vector<std::uint32_t> open;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < triangles_.size(); ++first) {
    if (faces[first] != kNone) continue;
    open.push_back(first);
    faces[first] = count;
    while (!open.empty()) {
      const Triangle& t = triangles_[open.back()];
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (t.fixed[k] || t.across[k] == kNone || faces[t.across[k]] != kNone) continue;
        faces[t.across[k]] = count;
        open.push_back(t.across[k]);
      }
    }
    ++count;
  }
  return faces;
}

}  // namespace rodeira::tessellation
