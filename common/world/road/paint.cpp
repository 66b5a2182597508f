// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/paint.hpp"

#include <algorithm>
#include <cmath>

#include "common/world/network/strokes.hpp"

namespace rodeira::road {
namespace {

constexpr double kPaintStretch_m = 32.0;
constexpr double kPaintRounding_m = 1e-6;  // far above all of it

}  // namespace

Paint::Paint(const network::Network& network) {
  for (const network::Road& road : network.roads()) {
    Lines& lines = roads_.emplace_back();
    const auto stretches = static_cast<std::size_t>(road.length_m() / kPaintStretch_m) + 1;
    if (!road.spec().lines.empty()) lines.by_stretch.resize(stretches);
    for (const network::PaintedLine& painted : road.spec().lines) {
      Line line{painted.from_s_m, painted.to_s_m, 0.5 * painted.width_m, 0.0, 0.0, &painted.t, {}};
      painted.t.Bounds(painted.from_s_m, painted.to_s_m, line.low_t_m, line.high_t_m);
      line.low_t_m -= line.half_width_m + kPaintRounding_m;
      line.high_t_m += line.half_width_m + kPaintRounding_m;
      if (painted.gap_m > 0.0) {
        for (const network::Stroke& stroke : network::Strokes(road, painted)) {
          line.edges_s_m.push_back(stroke.from_s_m);
          line.edges_s_m.push_back(stroke.to_s_m);
        }
      }
      const auto number = static_cast<std::uint32_t>(lines.lines.size());
      const auto first = static_cast<std::size_t>(std::max(0.0, painted.from_s_m / kPaintStretch_m));
      const auto last = static_cast<std::size_t>(std::max(0.0, painted.to_s_m / kPaintStretch_m));
      for (std::size_t i = first; i <= std::min(last, stretches - 1); ++i) lines.by_stretch[i].push_back(number);
      lines.lines.push_back(std::move(line));
    }
  }
}

std::size_t Paint::Lines::StretchAt(double s_m) const {
  return std::min(static_cast<std::size_t>(std::max(0.0, s_m / kPaintStretch_m)), by_stretch.size() - 1);
}

bool Paint::MayBe(std::uint32_t road, double low_s_m, double high_s_m, double low_t_m, double high_t_m) const {
  const Lines& lines = roads_[road];
  if (lines.by_stretch.empty()) return false;
  for (std::size_t stretch = lines.StretchAt(low_s_m); stretch <= lines.StretchAt(high_s_m); ++stretch) {
    for (const std::uint32_t number : lines.by_stretch[stretch]) {
      const Line& line = lines.lines[number];
      if (high_t_m >= line.low_t_m && low_t_m <= line.high_t_m && high_s_m >= line.from_s_m && low_s_m <= line.to_s_m)
        return true;
    }
  }
  return false;
}

bool Paint::At(std::uint32_t road, double s_m, double t_m) const {
  const Lines& lines = roads_[road];
  if (lines.by_stretch.empty()) return false;
  for (const std::uint32_t number : lines.by_stretch[lines.StretchAt(s_m)]) {
    const Line& line = lines.lines[number];
    if (t_m < line.low_t_m || t_m > line.high_t_m) continue;
    if (s_m < line.from_s_m || s_m > line.to_s_m || std::fabs(t_m - line.t->Value(s_m)) > line.half_width_m) continue;
    if (line.edges_s_m.empty()) return true;
    const auto after = std::upper_bound(line.edges_s_m.begin(), line.edges_s_m.end(), s_m);
    if ((after - line.edges_s_m.begin()) % 2 == 1) return true;
  }
  return false;
}

}  // namespace rodeira::road
