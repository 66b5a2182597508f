// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/trajectory_diagram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "common/core/base/append_format.hpp"
#include "common/core/base/xml_text.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kPlotWidth_px = 900.0, kPlotHeight_px = 460.0, kPlotLeft_px = 60.0, kPlotTop_px = 40.0;
constexpr std::array<const char*, 5> kSpeedColours = {"#b2182b", "#ef8a62", "#d9c24c", "#67a9cf",
                                                      "#2166ac"};  // from standing to the limit

int ShadeAt(double speed_mps, double limit_mps) {
  return std::clamp(static_cast<int>(speed_mps / limit_mps * static_cast<double>(kSpeedColours.size())), 0,
                    static_cast<int>(kSpeedColours.size()) - 1);
}

void Legend(std::string& svg) {
  double x = kPlotLeft_px;
  for (const char* shade : kSpeedColours) {
    base::AppendFormat(svg, "<rect x='{:.0f}' y='26' width='20' height='8' fill='{}'/>", x, shade);
    x += 20.0;
  }
  base::AppendFormat(svg, "<text x='{:.0f}' y='34'>speed, from standing to the limit</text>\n", x + 8.0);
}

}  // namespace

void TrajectoryDiagram::Add(double time_s, const TrafficModel& model) {
  last_s_ = time_s;
  for (const AgentPose& pose : model.poses()) {
    const Agent& agent = model.agent(pose.id);
    std::size_t i = agent.path.size() - 1;
    while (i > 0 && agent.path[i].begin_m > agent.o_m) --i;
    if (agent.path[i].track == track_)
      ways_[{pose.id, pose.trip}].push_back({time_s, agent.o_m - agent.path[i].zero_m, pose.speed_mps});
  }
}

std::string TrajectoryDiagram::ToSvg(const lanes::Graph& graph, const std::string& title) const {
  const double length = graph[track_].length_m(), limit = graph.SpeedLimit_mps(track_, 0.5 * length);
  const auto x = [&](double t) { return kPlotLeft_px + kPlotWidth_px * t / std::max(last_s_, 1e-9); };
  const auto y = [&](double d) { return kPlotTop_px + kPlotHeight_px * (1.0 - d / length); };
  std::set<std::uint32_t> here;
  for (const auto& [vehicle, points] : ways_) here.insert(vehicle.first);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} {1:.0f}' "
      "font-family='sans-serif' font-size='12'>\n"
      "<rect width='{0:.0f}' height='{1:.0f}' fill='white'/>\n<text x='{2}' y='20' font-size='14'>{3}, {7} of them "
      "here</text>\n"
      "<rect x='{2}' y='{4}' width='{5}' height='{6}' fill='none' stroke='#bbb'/>\n",
      kPlotLeft_px + kPlotWidth_px + 20.0, kPlotTop_px + kPlotHeight_px + 40.0, kPlotLeft_px, base::XmlText(title),
      kPlotTop_px, kPlotWidth_px, kPlotHeight_px, here.size());
  Legend(svg);
  for (int k = 0; k <= 4; ++k) {
    base::AppendFormat(svg,
                       "<text x='{:.0f}' y='{:.0f}' text-anchor='middle'>{:.5g} s</text><text x='{:.0f}' y='{:.0f}' "
                       "text-anchor='end'>{:.4g} m</text>\n",
                       x(0.25 * k * last_s_), kPlotTop_px + kPlotHeight_px + 18.0, 0.25 * k * last_s_,
                       kPlotLeft_px - 6.0, y(0.25 * k * length) + 4.0, 0.25 * k * length);
  }
  svg += "<g fill='none' stroke-width='1'>\n";
  for (const auto& [vehicle, points] : ways_) {
    for (std::size_t i = 0; i + 1 < points.size();) {
      const int shade = ShadeAt(points[i].speed_mps, limit);
      const auto goes_on = [&points = points](std::size_t k) {
        return k + 1 < points.size() && points[k + 1].d_m >= points[k].d_m - 1e-9;
      };
      std::string line;
      std::size_t end = i;
      while (goes_on(end) && (end == i || ShadeAt(points[end].speed_mps, limit) == shade)) ++end;
      for (std::size_t k = i; k <= end; ++k)
        base::AppendFormat(line, "{:.1f},{:.1f} ", x(points[k].time_s), y(points[k].d_m));
      if (end > i)
        base::AppendFormat(svg, "<polyline stroke='{}' points='{}'/>\n", kSpeedColours[static_cast<std::size_t>(shade)],
                           line);
      i = std::max(end, i + 1);
    }
  }
  return svg + "</g>\n</svg>\n";
}

}  // namespace rodeira::traffic
