// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_markings/stencils.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;

constexpr double kStem_m = 0.15, kStraightHead_m = 0.45;

// What of a convex polygon lies where sign y <= limit.
Polygon2 ClipBelow(const Polygon2& polygon, double sign, double limit) {
  Polygon2 kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double from = limit - sign * p.y(), to = limit - sign * q.y();
    if (from >= 0.0) kept.push_back(p);
    if ((from > 0.0 && to < 0.0) || (from < 0.0 && to > 0.0)) kept.emplace_back(p + from / (from - to) * (q - p));
  }
  return kept;
}

}  // namespace

ArrowWays WaysOf(std::string_view word) {
  std::size_t at = word.find("arrow");
  if (at == std::string_view::npos) at = word.find("Arrow");
  ArrowWays ways;
  if (at == std::string_view::npos) return ways;
  const std::string_view rest = word.substr(at + 5);
  if (rest.find("Merge") != std::string_view::npos) return ways;
  ways.left = rest.find("Left") != std::string_view::npos;
  ways.right = rest.find("Right") != std::string_view::npos;
  ways.straight = rest.find("Straight") != std::string_view::npos;
  return ways;
}

std::vector<Polygon2> ArrowShape(const ArrowWays& ways, double length_m, double width_m) {
  std::vector<Polygon2> shape;
  const double back = -0.5 * length_m, stem = 0.5 * kStem_m;
  const auto x = [&](double share) { return back + share * length_m; };
  const bool turns = ways.left || ways.right;
  // The stem ends at its head, or where its last branch leaves it.
  shape.push_back(
      {{back, -stem}, {x(ways.straight ? 0.7 : 0.5), -stem}, {x(ways.straight ? 0.7 : 0.5), stem}, {back, stem}});
  if (ways.straight) {
    const double half = std::max(stem, turns ? std::min(0.5 * width_m, 0.5 * kStraightHead_m) : 0.5 * width_m);
    shape.push_back({{x(0.7), -half}, {x(1.0), 0.0}, {x(0.7), half}});
  }
  // A branch runs ahead and to its side, and ends in a head that points to the side; alone it reaches the front.
  const double far = ways.straight ? 0.65 : 1.0, reach = std::max(0.5 * width_m, 3.0 * stem),
               neck = 0.5 * (stem + reach);
  for (const double side : {1.0, -1.0}) {
    if (!(side > 0.0 ? ways.left : ways.right)) continue;
    Polygon2 branch = {{x(0.4), side * stem},
                       {x(0.5), side * stem},
                       {x(0.5 + 0.5 * (far - 0.4)), side * neck},
                       {x(0.5 * (far + 0.4)), side * neck}};
    Polygon2 head = {{x(0.4), side * neck}, {x(far), side * neck}, {x(0.5 * (far + 0.4)), side * reach}};
    if (side < 0.0) std::reverse(branch.begin(), branch.end()), std::reverse(head.begin(), head.end());
    shape.push_back(std::move(branch));
    shape.push_back(std::move(head));
  }
  return shape;
}

std::vector<Polygon2> StopLineShape(double right_m, double left_m) {
  if (!(left_m > right_m)) return {};
  constexpr double kHalf = 0.5 * kStopLine_m;
  return {{{-kHalf, right_m}, {kHalf, right_m}, {kHalf, left_m}, {-kHalf, left_m}}};
}

std::vector<Polygon2> GiveWayShape(double right_m, double left_m) {
  std::vector<Polygon2> strokes;
  if (!(left_m > right_m)) return strokes;
  constexpr double kHalf = 0.5 * kGiveWayLine_m, kPeriod_m = kGiveWayStroke_m + kGiveWayGap_m;
  const double count = std::clamp(std::floor((left_m - right_m + kGiveWayGap_m) / kPeriod_m + 1e-9), 1.0, 1000.0),
               stroke = std::min(kGiveWayStroke_m, left_m - right_m);
  const double first = 0.5 * (right_m + left_m) - 0.5 * ((count - 1.0) * kPeriod_m + stroke);
  for (double i = 0.0; i < count; i += 1.0) {
    const double right = first + i * kPeriod_m;
    strokes.push_back({{-kHalf, right}, {kHalf, right}, {kHalf, right + stroke}, {-kHalf, right + stroke}});
  }
  return strokes;
}

std::vector<Polygon2> ZebraShape(const Polygon2& outline) {
  std::vector<Polygon2> stripes;
  if (outline.size() < 3) return stripes;
  double low = outline[0].y(), high = low;
  for (const Vector2d& p : outline) low = std::min(low, p.y()), high = std::max(high, p.y());
  constexpr double kPeriod_m = kStripe_m + kStripeGap_m;
  const double count = std::clamp(std::floor((high - low + kStripeGap_m) / kPeriod_m + 1e-9), 1.0, 1000.0);
  const double first = 0.5 * (low + high) - 0.5 * (count * kPeriod_m - kStripeGap_m);
  for (double i = 0.0; i < count; i += 1.0) {
    const double right = first + i * kPeriod_m;
    Polygon2 stripe = ClipBelow(ClipBelow(outline, 1.0, right + kStripe_m), -1.0, -right);
    if (stripe.size() > 2) stripes.push_back(std::move(stripe));
  }
  return stripes;
}

Polygon2 HullOf(std::span<const Vector2d> points) {
  Polygon2 sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(),
            [](const Vector2d& a, const Vector2d& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  Polygon2 hull;
  // Andrew's monotone chains: the lower one, then the upper one back.
  const auto chain = [&hull](const auto& from, const auto& to) {
    const std::size_t begin = hull.size();
    for (auto p = from; p != to; ++p) {
      while (hull.size() >= begin + 2 && geometry::Cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  if (sorted.size() < 3) return {};
  chain(sorted.begin(), sorted.end());
  chain(sorted.rbegin(), sorted.rend());
  return hull;
}

}  // namespace rodeira::scene
