// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/laid.hpp"

#include <algorithm>
#include <utility>

namespace rodeira::network {
namespace {

constexpr double kRounding_m = 1e-9;

// 3 u^2 - 2 u^3 of a distance over a width: its value and its slope by the distance.
std::pair<double, double> Ease(double distance_m, double over_m) {
  if (distance_m <= 0.0) return {0.0, 0.0};
  if (distance_m >= over_m) return {1.0, 0.0};
  const double u = distance_m / over_m;
  return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u) / over_m};
}

}  // namespace

Bump::Height Bump::At(double s_m, double t_m) const {
  if (!piece.Holds(s_m, t_m)) return {};
  const geometry::CubicPoint along = height.Evaluate(s_m);
  const auto [right, right_slope] = Ease(t_m - piece.right_t_m, side_m);
  const auto [left, left_slope] = Ease(piece.left_t_m - t_m, side_m);
  return {along.value * right * left, along.slope * right * left,
          along.value * (right_slope * left - right * left_slope)};
}

Laid CutLaid(const Laid& whole, double from_m, double to_m) {
  Laid part;
  for (Patch patch : whole.patches) {
    patch.piece.from_s_m = std::max(patch.piece.from_s_m - from_m, 0.0);
    patch.piece.to_s_m = std::min(patch.piece.to_s_m, to_m) - from_m;
    if (patch.piece.to_s_m > patch.piece.from_s_m) part.patches.push_back(std::move(patch));
  }
  for (Bump bump : whole.bumps) {
    if (bump.piece.from_s_m > to_m - kRounding_m || bump.piece.to_s_m < from_m + kRounding_m) continue;
    bump.piece.from_s_m -= from_m;
    bump.piece.to_s_m -= from_m;
    std::vector<geometry::Cubic> records(bump.height.records().begin(), bump.height.records().end());
    for (geometry::Cubic& record : records) record.from -= from_m;
    bump.height = geometry::CubicTable(std::move(records));
    part.bumps.push_back(std::move(bump));
  }
  return part;
}

}  // namespace rodeira::network
