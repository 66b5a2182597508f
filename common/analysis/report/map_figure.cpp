// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/report/map_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rodeira::report {
namespace {

constexpr double kWidth = 1100.0, kMaxHeight = 620.0, kLegend = 60.0, kMargin_m = 40.0;
// From slow to fast; told apart in print and by colour-blind readers (viridis).
constexpr std::array kSpeedColours{"#440154", "#443983", "#31688e", "#21918c", "#35b779", "#90d743", "#fde725"};

struct MapFrame {
  double west = 0.0, south = 0.0, east = 0.0, north = 0.0, scale = 1.0;
  double X(double x) const { return (x - west) * scale; }
  double Y(double y) const { return (north - y) * scale; }
  bool Holds(double x, double y) const { return x >= west && x <= east && y >= south && y <= north; }
};

MapFrame FrameAround(const measures::Drive& drive) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  MapFrame frame{kInfinity, kInfinity, -kInfinity, -kInfinity, 1.0};
  for (std::size_t k = 0; k < drive.size(); ++k) {
    if (std::isnan(drive.x_m[k])) continue;
    frame.west = std::min(frame.west, drive.x_m[k]), frame.east = std::max(frame.east, drive.x_m[k]);
    frame.south = std::min(frame.south, drive.y_m[k]), frame.north = std::max(frame.north, drive.y_m[k]);
  }
  frame.west -= kMargin_m, frame.south -= kMargin_m, frame.east += kMargin_m, frame.north += kMargin_m;
  frame.scale = std::min(kWidth / (frame.east - frame.west), kMaxHeight / (frame.north - frame.south));
  return frame;
}

// The outline of each driving lane, cut into the parts that lie within the frame.
std::string LanesPath(const network::Network& network, const MapFrame& frame) {
  const double step_m = std::clamp(4.0 / frame.scale, 2.0, 20.0);
  std::string path;
  std::vector<Eigen::Vector2d> outer, inner;
  const auto close = [&] {
    if (outer.size() > 1) {
      char letter = 'M';
      const auto add = [&](const Eigen::Vector2d& p) {
        path += fmt::format("{}{:.1f} {:.1f}", letter, frame.X(p.x()), frame.Y(p.y()));
        letter = 'L';
      };
      std::ranges::for_each(outer, add);
      std::for_each(inner.rbegin(), inner.rend(), add);
      path += 'Z';
    }
    outer.clear();
    inner.clear();
  };
  for (const network::LaneKey& key : network.Lanes()) {
    const network::Lane* lane = network.Find(key);
    if (lane == nullptr || !network::IsDrivable(lane->type)) continue;
    const network::Road& road = network.roads()[key.road];
    const network::LaneSection& section = network.Section(key);
    const double length_m = section.end_s_m - section.s_m;
    const auto steps = static_cast<std::size_t>(std::max(1.0, std::ceil(length_m / step_m)));
    for (std::size_t i = 0; i <= steps; ++i) {
      const double s =
          road.Held(key.section, section.s_m + length_m * static_cast<double>(i) / static_cast<double>(steps));
      const auto span = network.Span(key, s);
      if (!span) continue;
      const Eigen::Vector3d out = road.Surface(s, span->outer_t_m, section, *span).p_W;
      const Eigen::Vector3d in = road.Surface(s, span->inner_t_m, section, *span).p_W;
      if (!frame.Holds(out.x(), out.y()) && !frame.Holds(in.x(), in.y())) {
        close();
        continue;
      }
      outer.push_back(out.head<2>());
      inner.push_back(in.head<2>());
    }
    close();
  }
  return path;
}

// Pieces of one colour each. A missing sample interrupts the way.
std::string WayLines(const measures::Drive& drive, const MapFrame& frame, double max_speed_mps) {
  std::string svg, points;
  std::size_t colour = 0;
  Eigen::Vector2d last(0.0, 0.0);
  const auto end = [&] {
    if (!points.empty()) svg += fmt::format("<polyline points='{}' stroke='{}'/>\n", points, kSpeedColours[colour]);
    points.clear();
  };
  for (std::size_t k = 0; k < drive.size(); ++k) {
    if (std::isnan(drive.x_m[k])) {
      end();
      continue;
    }
    const Eigen::Vector2d at(frame.X(drive.x_m[k]), frame.Y(drive.y_m[k]));
    const double share = max_speed_mps > 0.0 ? std::abs(drive.speed_mps[k]) / max_speed_mps : 0.0;
    const auto now =
        static_cast<std::size_t>(std::clamp(share * kSpeedColours.size(), 0.0, kSpeedColours.size() - 1.0));
    if (!points.empty() && now == colour && (at - last).norm() < 1.5) continue;
    points += fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
    last = at;
    if (now == colour) continue;
    const bool goes_on = points.find(' ') + 1 < points.size();
    if (goes_on) end();
    colour = now;
    points = fmt::format("{:.1f},{:.1f} ", at.x(), at.y());
  }
  end();
  return svg;
}

double ScaleBar_m(double scale) {
  double length_m = 1000.0;
  for (const double shorter : {500.0, 200.0, 100.0, 50.0, 20.0, 10.0}) {
    if (length_m * scale > 200.0) length_m = shorter;
  }
  return length_m;
}

}  // namespace

std::string MapSvg(const measures::Drive& drive, const network::Network* network) {
  const MapFrame frame = FrameAround(drive);
  if (!(frame.west < frame.east)) return {};
  const double width = (frame.east - frame.west) * frame.scale, height = (frame.north - frame.south) * frame.scale;
  double most_mps = 0.0;
  for (const double speed : drive.speed_mps) {
    if (std::abs(speed) > most_mps) most_mps = std::abs(speed);
  }
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} {1:.0f}' "
      "font-family='sans-serif' font-size='12'>\n<rect width='{0:.0f}' height='{2:.1f}' fill='#eef0ea'/>\n",
      std::max(width, 420.0), height + kLegend, height);
  if (network != nullptr)
    svg +=
        fmt::format("<path d='{}' fill='#b9bcc2' stroke='#ffffff' stroke-width='0.5'/>\n", LanesPath(*network, frame));
  svg += "<g fill='none' stroke-width='3' stroke-linejoin='round' stroke-linecap='round'>\n" +
         WayLines(drive, frame, most_mps) + "</g>\n";
  for (std::size_t k = 0; k < drive.size(); ++k) {
    if (std::isnan(drive.x_m[k])) continue;
    svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='5' fill='#ffffff' stroke='#c1440e' stroke-width='2'/>\n",
                       frame.X(drive.x_m[k]), frame.Y(drive.y_m[k]));
    break;
  }
  constexpr double kBox = 24.0;
  const double top = height + 14.0, boxes = kBox * kSpeedColours.size();
  for (std::size_t i = 0; i < kSpeedColours.size(); ++i) {
    svg += fmt::format("<rect x='{}' y='{:.1f}' width='{}' height='12' fill='{}'/>\n", kBox * static_cast<double>(i),
                       top, kBox, kSpeedColours[i]);
  }
  svg +=
      fmt::format("<text x='0' y='{0:.1f}'>0</text><text x='{1}' y='{0:.1f}' text-anchor='end'>{2:.0f} km/h</text>\n",
                  top + 28.0, boxes, 3.6 * most_mps);
  const double bar_m = ScaleBar_m(frame.scale), left = boxes + 40.0;
  svg += fmt::format(
      "<path d='M{0:.1f} {1:.1f}H{2:.1f}' stroke='#333' stroke-width='3'/><text x='{0:.1f}' y='{3:.1f}'>{4:.0f} m; the "
      "circle is the start</text>\n",
      left, top + 6.0, left + bar_m * frame.scale, top + 28.0, bar_m);
  return svg + "</svg>\n";
}

}  // namespace rodeira::report
