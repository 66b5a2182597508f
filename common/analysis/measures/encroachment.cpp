// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/encroachment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/analysis/measures/statistics.hpp"
#include "common/core/base/assert.hpp"

namespace rodeira::measures {
namespace {

using Eigen::Vector2d;

double ReachOf(const Footprint& f) { return 0.5 * std::hypot(f.length_m, f.width_m); }

// Whether the rectangles are apart along an axis of a.
bool ApartAlong(const Footprint& a, const Footprint& b) {
  const Vector2d ahead(std::cos(a.heading_rad), std::sin(a.heading_rad)), left(-ahead.y(), ahead.x());
  const Vector2d ahead_b(std::cos(b.heading_rad), std::sin(b.heading_rad)), left_b(-ahead_b.y(), ahead_b.x());
  const Vector2d between = b.middle_W - a.middle_W;
  const auto half_b = [&](const Vector2d& axis) {
    return 0.5 * (b.length_m * std::abs(ahead_b.dot(axis)) + b.width_m * std::abs(left_b.dot(axis)));
  };
  return std::abs(between.dot(ahead)) > 0.5 * a.length_m + half_b(ahead) ||
         std::abs(between.dot(left)) > 0.5 * a.width_m + half_b(left);
}

Footprint Between(const Footprint& a, const Footprint& b, double share) {
  Footprint f = a;
  f.middle_W += share * (b.middle_W - a.middle_W);
  f.heading_rad += share * WrapAngle(b.heading_rad - a.heading_rad);
  return f;
}

// The share of the step from sample i at which touching changes.
double ChangeWithin(std::span<const Footprint> path, std::size_t i, const SweptArea& area) {
  const bool before = area.Touches(path[i]);
  double low = 0.0, high = 1.0;
  constexpr int kHalvings = 40;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (area.Touches(Between(path[i], path[i + 1], middle)) == before ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

SweptArea::SweptArea(std::span<const Footprint> path) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    poses_.push_back(path[i]);
    if (i + 1 == path.size()) break;
    const double step = (path[i + 1].middle_W - path[i].middle_W).norm();
    const auto pieces = static_cast<int>(std::ceil(10.0 * step / std::max(path[i].length_m, 0.1)));
    for (int k = 1; k < pieces; ++k) poses_.push_back(Between(path[i], path[i + 1], static_cast<double>(k) / pieces));
  }
}

bool SweptArea::Touches(const Footprint& footprint) const {
  return std::any_of(poses_.begin(), poses_.end(), [&](const Footprint& pose) { return Overlap(footprint, pose); });
}

std::optional<Stay> StayIn(std::span<const Footprint> path, const SweptArea& area) {
  std::optional<std::size_t> first;
  std::size_t last = 0, count = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!area.Touches(path[i])) continue;
    if (!first) first = i;
    last = i;
    ++count;
  }
  if (!first) return std::nullopt;
  Stay stay{static_cast<double>(*first), static_cast<double>(last), count, *first > 0, last + 1 < path.size()};
  if (stay.begins) stay.enters = static_cast<double>(*first - 1) + ChangeWithin(path, *first - 1, area);
  if (stay.ends) stay.leaves += ChangeWithin(path, last, area);
  return stay;
}

bool Overlap(const Footprint& a, const Footprint& b) {
  if ((b.middle_W - a.middle_W).norm() > ReachOf(a) + ReachOf(b)) return false;
  return !ApartAlong(a, b) && !ApartAlong(b, a);
}

Measure PostEncroachmentTime(std::span<const Footprint> a, std::span<const Footprint> b, double rate_hz) {
  RODEIRA_ASSERT(a.size() == b.size());
  const std::size_t all = 2 * a.size();
  const UsedOptions used = Used({{"area", "intersection of the swept footprints"}, {"rate_hz", rate_hz}});
  const auto stay_a = StayIn(a, SweptArea(b)), stay_b = StayIn(b, SweptArea(a));
  if (!stay_a || !stay_b) return NotFound("the paths have no common area", "s", 0, all, used);
  const bool a_first = stay_a->enters <= stay_b->enters;
  const Stay& first = a_first ? *stay_a : *stay_b;
  const Stay& second = a_first ? *stay_b : *stay_a;
  const std::size_t n = first.samples + second.samples;
  if (!first.ends) return NotFound("the first vehicle is in the common area at the end", "s", n, all, used);
  return Found((second.enters - first.leaves) / rate_hz, "s", n, all, used);
}

}  // namespace rodeira::measures
