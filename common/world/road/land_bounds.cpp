// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/land_bounds.hpp"

namespace rodeira::road {

using Eigen::Vector2d;

SteeperBounds::SteeperBounds(const LandBounds& tightest)
    : tightest_low_m_(tightest.low_m()), tightest_high_m_(tightest.high_m()) {
  const LandBound &low = tightest.low(), &high = tightest.high();
  const double sum = low.distance_m + high.distance_m;
  slope_ = sum > 0.0 ? std::max(kBank, (low.z_m - high.z_m) / sum) : kBank;
  low_m_ = low.z_m - slope_ * low.distance_m - kRounding_m;
  high_m_ = high.z_m + slope_ * high.distance_m + kRounding_m;
  farther_m_ = std::max(low.distance_m, high.distance_m) + kRounding_m;
}

void LandBounds::Add(const LandBound& bound, double distance_m) {
  if (every_) all_.push_back(bound);
  nearest_m_ = std::min(nearest_m_, distance_m);
  const double low_m = bound.z_m - kBank * bound.distance_m, high_m = bound.z_m + kBank * bound.distance_m;
  if (low_m > low_m_ || (low_m == low_m_ && rank_ < low_rank_)) low_ = bound, low_m_ = low_m, low_rank_ = rank_;
  if (high_m < high_m_ || (high_m == high_m_ && rank_ < high_rank_))
    high_ = bound, high_m_ = high_m, high_rank_ = rank_;
}

PlaneHeight LandBounds::Meet() const {
  LandBound low = low_, high = high_;
  double slope = kBank;
  const auto low_at = [&](const LandBound& bound) { return bound.z_m - slope * bound.distance_m; };
  const auto high_at = [&](const LandBound& bound) { return bound.z_m + slope * bound.distance_m; };
  for (;;) {
    const double sum = low.distance_m + high.distance_m;
    const double steeper = sum > 0.0 ? (low.z_m - high.z_m) / sum : 0.0;  // the edges of two roads touch: a wall
    if (!(low_at(low) > high_at(high)) || !(steeper > slope)) break;
    slope = steeper;
    for (const LandBound& bound : all_) {
      if (low_at(bound) > low_at(low)) low = bound;
      if (high_at(bound) < high_at(high)) high = bound;
    }
  }
  const double sum = low.distance_m + high.distance_m;
  // Both edges at the point itself, as on roads that lie over one another: no slope meets both.
  if (slope == kBank || !(sum > 0.0))
    return {0.5 * (low_at(low) + high_at(high)),
            0.5 * (low.z_slope_W + high.z_slope_W + slope * (high.distance_slope_W - low.distance_slope_W))};
  const double part = high.distance_m / sum, step = low.z_m - high.z_m;
  const Vector2d part_slope =
      (low.distance_m * high.distance_slope_W - high.distance_m * low.distance_slope_W) / (sum * sum);
  return {high.z_m + part * step, high.z_slope_W + part * (low.z_slope_W - high.z_slope_W) + step * part_slope};
}

}  // namespace rodeira::road
