// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/tessellation/bend.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::scene {
namespace {

// Tangents are sampled this far from the ends, which may lie on an edge themselves.
constexpr double kTangentInset_m = 0.02;
constexpr double kSameSlope = 1e-6;

}  // namespace

std::optional<double> BendBetween(const GroundAt& ground, const Eigen::Vector2d& a_W, double a_z_m,
                                  const Eigen::Vector2d& b_W, double b_z_m, const BendRange& range,
                                  bool straight_ends) {
  const double length_m = (b_W - a_W).norm();
  if (length_m < 4.0 * range.margin_m) return std::nullopt;
  const auto at = [&](double part) { return ground(a_W + part * (b_W - a_W)); };
  const auto off = [&](double part) {
    const road::SurfacePoint there = at(part);
    return there.inside ? std::fabs(there.z_m - (a_z_m + part * (b_z_m - a_z_m))) : 0.0;
  };
  double worst_m = off(0.5), worst_part = 0.5;
  const auto look_at = [&](double part) {
    if (const double m = off(part); m > worst_m) worst_m = m, worst_part = part;
  };
  if (worst_m <= range.tolerance_m && length_m > range.short_m) {  // an S is straight in its middle
    const int parts = std::max(straight_ends ? 2 : 4, 2 * static_cast<int>(std::ceil(0.5 * length_m / range.step_m)));
    for (int k = 1; k < parts; ++k) {
      if (2 * k != parts) look_at(static_cast<double>(k) / parts);
    }
  }
  if (worst_m <= range.tolerance_m && range.ends_m > 0.0 && length_m > 4.0 * range.ends_m) {
    for (const double part : {range.ends_m / length_m, 1.0 - range.ends_m / length_m}) look_at(part);
  }
  if (worst_m <= range.tolerance_m) return std::nullopt;
  const Eigen::Vector2d along = (b_W - a_W) / length_m;
  const double inside = kTangentInset_m / length_m;
  const road::SurfacePoint first = at(inside), last = at(1.0 - inside);
  const double rise_a = along.dot(Eigen::Vector2d(first.slope_x, first.slope_y)),
               rise_b = along.dot(Eigen::Vector2d(last.slope_x, last.slope_y));
  const double margin = range.margin_m / length_m;
  if (std::fabs(rise_a - rise_b) > kSameSlope) {
    const double part = (b_z_m - a_z_m - rise_b * length_m) / (rise_a - rise_b) / length_m;
    if (part >= margin && part <= 1.0 - margin && off(part) >= worst_m) return part;
  }
  return std::clamp(worst_part, margin, 1.0 - margin);
}

}  // namespace rodeira::scene
