// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/mark_paint.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::road {
namespace {

constexpr double kMarkStretch_m = 16.0;
constexpr double kMarkStep_m = 1.0;  // between the places where a line's t is looked at
constexpr double kRoom_m = 0.05;     // and what it may bend between them

std::size_t StretchOf(double s_m, std::size_t count) {
  return std::min(static_cast<std::size_t>(std::max(0.0, s_m / kMarkStretch_m)), count - 1);
}

}  // namespace

MarkPaint::MarkPaint(std::shared_ptr<const network::Network> network) : network_(std::move(network)) {
  for (const network::Road& road : network_->roads()) {
    Lines& lines = roads_.emplace_back();
    lines.by_stretch.resize(static_cast<std::size_t>(road.length_m() / kMarkStretch_m) + 1);
    for (const network::Marking& marking : network::MarkingsOf(road)) Add(road, marking, lines);
  }
}

void MarkPaint::Add(const network::Road& road, const network::Marking& marking, Lines& lines) {
  Line line{marking, {}};
  for (const network::Stroke& stroke : network::StrokesOf(road, marking)) {
    line.edges_s_m.push_back(stroke.from_s_m);
    line.edges_s_m.push_back(stroke.to_s_m);
  }
  const auto number = static_cast<std::uint32_t>(lines.lines.size());
  for (std::size_t stretch = StretchOf(marking.from_s_m, lines.by_stretch.size()); stretch < lines.by_stretch.size();
       ++stretch) {
    const double from = std::max(marking.from_s_m, kMarkStretch_m * static_cast<double>(stretch)),
                 to = std::min(marking.to_s_m, kMarkStretch_m * static_cast<double>(stretch + 1));
    if (from > to) break;
    Near near{number, 1e9, -1e9};
    const double count = std::ceil((to - from) / kMarkStep_m) + 1.0;
    for (double i = 0.0; i <= count; i += 1.0) {
      const geometry::CubicPoint t = network::MarkingAt(road, marking, from + (to - from) * i / count);
      const double room = kRoom_m + 0.5 * marking.width_m + kMarkStep_m * std::fabs(t.slope);
      near.low_t_m = std::min(near.low_t_m, t.value - room);
      near.high_t_m = std::max(near.high_t_m, t.value + room);
    }
    lines.by_stretch[stretch].push_back(near);
  }
  lines.lines.push_back(std::move(line));
}

bool MarkPaint::At(std::uint32_t road, std::uint32_t section, double s_m, double t_m) const {
  const Lines& lines = roads_[road];
  for (const Near& near : lines.by_stretch[StretchOf(s_m, lines.by_stretch.size())]) {
    if (t_m < near.low_t_m || t_m > near.high_t_m) continue;
    const auto& [marking, edges] = lines.lines[near.line];
    if (s_m < marking.from_s_m || s_m > marking.to_s_m || (marking.painted == nullptr && marking.section != section))
      continue;
    const auto after = std::upper_bound(edges.begin(), edges.end(), s_m);
    if ((after - edges.begin()) % 2 == 0) continue;
    if (std::fabs(t_m - network::MarkingAt(network_->roads()[road], marking, s_m).value) <= 0.5 * marking.width_m)
      return true;
  }
  return false;
}

}  // namespace rodeira::road
