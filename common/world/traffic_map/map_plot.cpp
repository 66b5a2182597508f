// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/map_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/core/base/constants.hpp"
#include "common/world/traffic_map/border_paint.hpp"

namespace rodeira::traffic_map {
namespace {

constexpr double kWidth_px = 1000.0;
constexpr double kMargin_m = 6.0;

// The paper: metres to pixels, y downward.
struct Paper {
  double west_m = 1e300, south_m = 1e300, east_m = -1e300, north_m = -1e300;
  double scale = 1.0;

  explicit Paper(const LaneMap& map) {
    for (const MapLane& lane : map.lanes) {
      for (const Border* border : {&lane.shape.left(), &lane.shape.right()}) {
        for (int i = 0; i <= 16; ++i) Take(border->plan.At(i / 16.0));
      }
    }
    west_m -= kMargin_m, south_m -= kMargin_m, east_m += kMargin_m, north_m += kMargin_m;
    scale = kWidth_px / std::max(east_m - west_m, north_m - south_m);
  }
  void Take(const Eigen::Vector2d& p) {
    west_m = std::min(west_m, p.x()), east_m = std::max(east_m, p.x());
    south_m = std::min(south_m, p.y()), north_m = std::max(north_m, p.y());
  }
  double X(double x_m) const { return (x_m - west_m) * scale; }
  double Y(double y_m) const { return (north_m - y_m) * scale; }
  std::string Point(const Eigen::Vector2d& p) const { return fmt::format("{:.2f} {:.2f}", X(p.x()), Y(p.y())); }
  // A cubic from where the pen stands, or with a move before it.
  std::string CurveTo(const Cubic& c) const {
    return fmt::format("C{} {} {}", Point(c.p_W[1]), Point(c.p_W[2]), Point(c.p_W[3]));
  }
  std::string Curve(const Cubic& c) const { return "M" + Point(c.p_W[0]) + CurveTo(c); }
};

std::string_view Fill(LaneMode mode) {
  return mode == LaneMode::kStart ? "#5d7f63" : mode == LaneMode::kEnd ? "#8a5f5f" : "#6a6a70";
}

std::string DrawBorder(const Border& border, BorderType type, std::string_view lane_colour, const Paper& paper) {
  const network::LineKind& paint = PaintOf(type);
  if (paint.lines == 0) return "";
  const std::string dash = paint.gap_m == 0.0 ? ""
                                              : fmt::format(" stroke-dasharray=\"{:.2f} {:.2f}\"",
                                                            paint.stroke_m * paper.scale, paint.gap_m * paper.scale);
  const auto stroke = [&](double width_m, std::string_view colour) {
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\"{}/>\n",
                       paper.Curve(border.plan), colour, std::max(0.6, width_m * paper.scale), dash);
  };
  if (paint.lines == 1) return stroke(paint.width_m, "#ffffff");
  return stroke(2.0 * paint.width_m + network::kLinesApart_m, "#ffffff") + stroke(network::kLinesApart_m, lane_colour);
}

std::string DrawLane(const MapLane& lane, const Paper& paper) {
  const Cubic back = lane.shape.right().plan.Reversed();
  std::string svg = fmt::format("<path d=\"{}L{}{}Z\" fill=\"{}\"/>\n", paper.Curve(lane.shape.left().plan),
                                paper.Point(back.p_W[0]), paper.CurveTo(back), Fill(lane.mode));
  svg += DrawBorder(lane.shape.left(), lane.left_type, Fill(lane.mode), paper);
  return svg + DrawBorder(lane.shape.right(), lane.right_type, Fill(lane.mode), paper);
}

// The direction and the number, in the middle of the lane.
std::string DrawName(const MapLane& lane, const Paper& paper) {
  const LanePoint at = lane.shape.At(0.5 * lane.shape.length_m());
  const double size = std::clamp(0.3 * at.width_m() * paper.scale, 3.0, 9.0);
  const double degrees = -std::atan2(at.tangent_W.y(), at.tangent_W.x()) * 180.0 / base::kPi;
  std::string svg = fmt::format(
      "<path d=\"M{0:.1f} 0L-{0:.1f} {1:.1f}L-{0:.1f} -{1:.1f}Z\" fill=\"#f2c84b\" transform=\"translate({2}) "
      "rotate({3:.1f})\"/>\n",
      0.6 * size, 0.4 * size, paper.Point(at.p_W), degrees);
  const LanePoint label =
      lane.shape.At(0.5 * lane.shape.length_m() - std::min(1.6 * size / paper.scale, 0.4 * lane.shape.length_m()));
  svg += fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-family=\"sans-serif\" font-size=\"{:.1f}\" fill=\"#ffffff\" "
      "text-anchor=\"middle\">{}</text>\n",
      paper.X(label.p_W.x()), paper.Y(label.p_W.y()) + 0.35 * size, size, lane.id);
  return svg;
}

std::string DrawStop(const MapLane& lane, const Paper& paper) {
  const LanePoint at = lane.shape.AtParameter(1.0);
  const Eigen::Vector2d left = at.p_W + at.left_m * at.left_W(), right = at.p_W + at.right_m * at.left_W();
  return fmt::format("<path d=\"M{}L{}\" stroke=\"#e03030\" stroke-width=\"{:.2f}\"/>\n", paper.Point(left),
                     paper.Point(right), std::max(1.5, 0.5 * paper.scale));
}

double HighestOf(const MapLane& lane) {
  double z = -1e300;
  for (int i = 0; i <= 8; ++i) z = std::max(z, lane.shape.AtParameter(i / 8.0).z_m);
  return z;
}

std::string DrawRule(const Paper& paper) {
  double length_m = 1.0;
  while (length_m * 10.0 * paper.scale < 0.4 * kWidth_px) length_m *= 10.0;
  if (length_m * 5.0 * paper.scale < 0.4 * kWidth_px) length_m *= 5.0;
  const double y = paper.Y(paper.south_m) - 6.0;
  return fmt::format(
      "<path d=\"M6 {0:.1f}H{1:.1f}\" stroke=\"#202020\" stroke-width=\"2\"/>\n"
      "<text x=\"{2:.1f}\" y=\"{0:.1f}\" font-family=\"sans-serif\" font-size=\"13\">{3:.0f} m</text>\n",
      y, 6.0 + length_m * paper.scale, 12.0 + length_m * paper.scale, length_m);
}

}  // namespace

std::string PlotMap(const LaneMap& map) {
  const Paper paper(map);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\">\n",
      paper.X(paper.east_m), paper.Y(paper.south_m));
  svg += "<rect width=\"100%\" height=\"100%\" fill=\"#dfe6d8\"/>\n";
  std::vector<double> heights;
  for (const MapLane& lane : map.lanes) heights.push_back(HighestOf(lane));
  std::vector<std::size_t> order(map.lanes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return heights[a] < heights[b]; });
  for (const std::size_t i : order) svg += DrawLane(map.lanes[i], paper);
  for (const MapConnection& connection : map.connections) {
    if (connection.stop) svg += DrawStop(map.lanes[connection.from], paper);
  }
  for (const std::size_t i : order) svg += DrawName(map.lanes[i], paper);
  return svg + DrawRule(paper) + "</svg>\n";
}

}  // namespace rodeira::traffic_map
