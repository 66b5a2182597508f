// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace rodeira::network {

// The paint of a line of which only the kind is given: one line, or two in parallel. A gap of 0 is continuous.
struct LineKind {
  std::string_view name;
  int lines = 1;  // 0, 1 or 2
  bool dashed_left = false, dashed_right = false;
  double width_m = 0.12;  // of each
  double stroke_m = 0.0, gap_m = 0.0;
};

inline constexpr double kLinesApart_m = 0.12;  // between the two (Vienna Convention, annex 2: 0.10 to 0.18)

// The first six say what is painted; with the others, and `none`, `dashed` and `double_dashed`, they are the border
// types of traffic maps. Approach strokes are 2 to 3 times their gap (the same annex).
inline constexpr std::array<LineKind, 11> kLineKinds = {{
    {"continuous", 1, false, false, 0.12, 0.0, 0.0},
    {"dashed", 1, true, true, 0.12, 4.0, 8.0},
    {"double", 2, false, false, 0.12, 0.0, 0.0},
    {"double_dashed", 2, true, true, 0.12, 4.0, 8.0},
    {"mixed", 2, false, true, 0.12, 4.0, 8.0},
    {"none", 0, false, false, 0.12, 0.0, 0.0},
    {"boundary", 1, false, false, 0.15, 0.0, 0.0},
    {"single", 1, false, false, 0.12, 0.0, 0.0},
    {"dashed_same", 1, true, true, 0.12, 3.0, 9.0},
    {"dashed_speed_ctrl", 1, true, true, 0.30, 1.5, 1.5},
    {"dashed_warn", 1, true, true, 0.12, 5.0, 2.0},
}};

// One of the names above; continuous for any other.
constexpr const LineKind& LineKindByName(std::string_view name) {
  for (const LineKind& kind : kLineKinds) {
    if (kind.name == name) return kind;
  }
  return kLineKinds[0];
}

}  // namespace rodeira::network
