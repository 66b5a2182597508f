// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/geometry/cubic.hpp"

// What an author lays on a piece of a road, beyond what OpenDRIVE can say.
namespace rodeira::network {

// Between two stations and two lateral places.
struct LaidPiece {
  double from_s_m = 0.0, to_s_m = 0.0;
  double right_t_m = 0.0, left_t_m = 0.0;

  // Both ends and both sides belong to it.
  bool Holds(double s_m, double t_m) const {
    return s_m >= from_s_m && s_m <= to_s_m && t_m >= right_t_m && t_m <= left_t_m;
  }
};

// Another ground: ice, sand, a mended place. It covers lanes and paint.
struct Patch {
  LaidPiece piece;
  std::string surface;  // as of LaneMaterial; empty: what lies there stays, with another friction
  double friction = 1.0;
};

// A height over the road: a hump, a ramp, a row of them. Over side_m along both of its sides it passes into nothing by
// 3 u^2 - 2 u^3.
struct Bump {
  LaidPiece piece;
  double side_m = 0.3;
  geometry::CubicTable height;  // over s; 0 at both ends of the piece

  // The height, and how it grows with s and with t; nothing outside.
  struct Height {
    double z_m = 0.0, by_s = 0.0, by_t = 0.0;
  };
  // s and t of the road.
  Height At(double s_m, double t_m) const;
};

// All that an author laid on one road.
struct Laid {
  std::vector<Patch> patches;  // of several at one place the last one lies on top
  std::vector<Bump> bumps;     // of several at one place all count

  bool empty() const { return patches.empty() && bumps.empty(); }
};

// What of it lies between two stations, counted from the first. A bump that reaches beyond stays whole.
Laid CutLaid(const Laid& whole, double from_m, double to_m);

}  // namespace rodeira::network
