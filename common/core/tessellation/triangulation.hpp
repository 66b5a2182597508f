// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/core/tessellation/grid_point.hpp"

namespace rodeira::tessellation {

// A square in triangles: the constrained Delaunay triangulation of the points and sides that are put into it. Exact: no
// rounding decides anything, so that the same calls give the same triangles everywhere.
class Triangulation {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  // Side k goes from corner k to corner k + 1.
  struct Triangle {
    std::array<std::uint32_t, 3> corner{};  // counter-clockwise
    std::array<std::uint32_t, 3> across{kNone, kNone,
                                        kNone};  // the triangle beyond each side; kNone: the square's edge
    std::array<bool, 3> fixed{};
  };

  // Of the square [0, size] x [0, size]; its corners are points 0 to 3, counter-clockwise from the south-west.
  explicit Triangulation(std::int32_t size);

  std::span<const GridPoint> points() const { return points_; }
  std::span<const Triangle> triangles() const { return triangles_; }
  // A point within the square or on its edge; its number. A point that is there already keeps its own.
  std::uint32_t Insert(GridPoint p);
  // The same triangles; the point is sought from one of them on, near which it should lie.
  std::uint32_t Insert(GridPoint p, std::uint32_t near);
  // A side from a to b that stays, in pieces where points lie on it. False where it would cross another fixed side:
  // then a part of it is missing.
  bool Fix(std::uint32_t a, std::uint32_t b);
  // The side from a to b, where it is one, need not stay any longer.
  void Release(std::uint32_t a, std::uint32_t b);
  // A triangle that holds p: within it or on its edge.
  std::uint32_t Find(GridPoint p) const;
  // For each triangle the number of its face: faces are parted by fixed sides. Numbered by their first triangles.
  std::vector<std::uint32_t> Faces() const;
  // The triangle, of a lower number, of which one was cut by a point that was put in. Both are of one face.
  std::uint32_t CutFrom(std::uint32_t triangle) const { return cut_from_[triangle]; }

 private:
  struct Side {
    std::uint32_t triangle = kNone;
    int k = 0;
  };
  std::int64_t TurnAt(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return Turn(points_[a], points_[b], points_[c]);
  }
  // The triangle that holds p within, sought from another one on; kNone where it lies on a side, or was not found soon.
  std::uint32_t FindWithin(GridPoint p, std::uint32_t near) const;
  std::uint32_t PutIn(std::uint32_t triangle, GridPoint p);
  void Set(std::uint32_t triangle, std::array<std::uint32_t, 3> corner, std::array<std::uint32_t, 3> across,
           std::array<bool, 3> fixed);
  void Meet(std::uint32_t beyond, std::uint32_t before, std::uint32_t now);
  void SplitTriangle(std::uint32_t triangle, std::uint32_t p);
  void SplitSide(Side side, std::uint32_t p);
  // The two triangles of a side with the other diagonal.
  void Flip(Side side);
  // Flips until the sides that were put on the stack are Delaunay's.
  void Settle();
  Side Opposite(Side side) const;
  Side SideBetween(std::uint32_t a, std::uint32_t b) const;
  bool FixFirst(std::uint32_t& a, std::uint32_t b);
  bool Force(std::uint32_t a, std::uint32_t b, std::vector<std::array<std::uint32_t, 2>> crossed);

  std::vector<GridPoint> points_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> cut_from_;  // by triangle
  std::vector<std::uint32_t> at_;        // a triangle at each point
  std::vector<Side> stack_;
  mutable std::uint32_t last_ = 0;
};

}  // namespace rodeira::tessellation
