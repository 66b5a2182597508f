// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/polyline_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/geometry/plane.hpp"

namespace rodeira::geometry {
namespace {

// The shares of two segments at which they meet; nothing where they do not, or are parallel.
std::optional<std::pair<double, double>> Meet(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                              const Eigen::Vector2d& c, const Eigen::Vector2d& d) {
  const double area = Cross(b - a, d - c);
  if (area == 0.0) return std::nullopt;
  const double first = Cross(c - a, d - c) / area, second = Cross(c - a, b - a) / area;
  if (!(first >= 0.0 && first <= 1.0 && second >= 0.0 && second <= 1.0)) return std::nullopt;
  return std::pair(first, second);
}

// A segment as a box, for a sweep along the line's longer extent.
struct Span {
  double begin, end;  // along the sweep
  double low, high;   // across it
  std::size_t segment;
};

}  // namespace

std::vector<Crossing> CrossingsOf(const Polyline& line, std::span<const double> stations) {
  const auto at = [&](std::size_t i) -> Eigen::Vector2d { return line.points_W[i].head<2>(); };
  const std::size_t segments = line.points_W.size() - 1;
  Eigen::Vector2d low = at(0), high = at(0);
  for (std::size_t i = 1; i <= segments; ++i) low = low.cwiseMin(at(i)), high = high.cwiseMax(at(i));
  const Eigen::Index sweep = (high - low).x() >= (high - low).y() ? 0 : 1;
  std::vector<Span> spans;
  for (std::size_t i = 0; i < segments; ++i) {
    const Eigen::Vector2d from = at(i).cwiseMin(at(i + 1)), to = at(i).cwiseMax(at(i + 1));
    spans.push_back({from[sweep], to[sweep], from[1 - sweep], to[1 - sweep], i});
  }
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.segment < b.segment;
  });
  std::vector<Crossing> crossings;
  std::vector<Span> open;  // those that the sweep has not passed yet
  for (const Span& span : spans) {
    std::erase_if(open, [&](const Span& other) { return other.end < span.begin; });
    for (const Span& other : open) {
      const std::size_t i = std::min(span.segment, other.segment), k = std::max(span.segment, other.segment);
      const bool neighbours = k - i <= 1 || (i == 0 && k + 1 == segments && line.closed());
      if (neighbours || other.high < span.low || other.low > span.high) continue;
      const auto meet = Meet(at(i), at(i + 1), at(k), at(k + 1));
      if (!meet) continue;
      const auto station = [&](std::size_t segment, double share) {
        return stations[segment] + share * (stations[segment + 1] - stations[segment]);
      };
      crossings.push_back({station(i, meet->first), station(k, meet->second)});
    }
    open.push_back(span);
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.first_m != b.first_m ? a.first_m < b.first_m : a.second_m < b.second_m;
  });
  // A crossing in a node is found with both of its segments.
  const auto same = [](const Crossing& a, const Crossing& b) {
    return std::fabs(a.first_m - b.first_m) < 1e-9 && std::fabs(a.second_m - b.second_m) < 1e-9;
  };
  crossings.erase(std::unique(crossings.begin(), crossings.end(), same), crossings.end());
  return crossings;
}

}  // namespace rodeira::geometry
