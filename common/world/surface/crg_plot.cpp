// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/world/surface/crg_report.hpp"
#include "common/world/surface/value_range.hpp"

namespace rodeira::surface {
namespace {

constexpr double kWidth = 900.0;  // of each diagram, in SVG units
constexpr double kLeft = 70.0;
constexpr double kPlanHeight = 260.0;
constexpr double kRasterHeight = 180.0;
constexpr double kTrackHeight = 160.0;
constexpr int kColumns = 225;
constexpr int kRows = 45;
constexpr int kTrackPoints = 900;

// At least this much, so that what is level can be drawn.
double Size(const ValueRange& range) { return std::max(range.size(), 1e-9); }

std::string Frame(double top, double height, std::string_view title) {
  return fmt::format(
      "<text x='{}' y='{}' font-size='13'>{}</text>\n<rect x='{}' y='{}' width='{}' height='{}' fill='none' "
      "stroke='#999'/>\n",
      kLeft, top - 6, title, kLeft, top, kWidth, height);
}

// Numbers under a diagram, from low to high.
std::string Ticks(double top, double low, double high) {
  std::string svg;
  for (int i = 0; i <= 10; ++i) {
    svg += fmt::format("<text x='{:.0f}' y='{:.0f}' text-anchor='middle'>{:.4g}</text>\n", kLeft + kWidth * i / 10.0,
                       top + 13, low + (high - low) * i / 10.0);
  }
  return svg;
}

// Both sides and the reference line, seen from above.
std::string Plan(const CrgSurface& surface, double top) {
  const CrgShape& shape = surface.shape();
  const std::size_t every = std::max<std::size_t>(1, surface.rows() / 600);
  std::array<std::vector<Eigen::Vector2d>, 3> lines;
  ValueRange x, y;
  for (std::size_t row = 0; row < surface.rows();
       row = row + 1 == surface.rows() ? row + 1 : std::min(row + every, surface.rows() - 1)) {
    const double u = shape.line.begin_u_m() + static_cast<double>(row) * shape.line.step_m();
    const std::array<double, 3> v = {shape.v_m.front(), 0.0, shape.v_m.back()};
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d p = shape.line.Position(u, v[i]);
      lines[i].push_back(p);
      x.Add(p.x()), y.Add(p.y());
    }
  }
  const double scale = std::min((kWidth - 20.0) / Size(x), (kPlanHeight - 20.0) / Size(y));
  const double mx = 0.5 * (x.low + x.high), my = 0.5 * (y.low + y.high);
  std::string svg =
      Frame(top, kPlanHeight,
            fmt::format("from above: x {:.2f} to {:.2f} m, y {:.2f} to {:.2f} m; the dot is the beginning", x.low,
                        x.high, y.low, y.high));
  const auto at = [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(kLeft + 0.5 * kWidth + (p.x() - mx) * scale, top + 0.5 * kPlanHeight - (p.y() - my) * scale);
  };
  const auto path = [&](const std::vector<Eigen::Vector2d>& line, std::string_view begin) {
    std::string text(begin);
    for (const Eigen::Vector2d& p : line) {
      text += fmt::format("{}{:.1f} {:.1f}", &p == &line.front() ? "" : "L", at(p).x(), at(p).y());
    }
    return text;
  };
  std::vector<Eigen::Vector2d> back(lines[2].rbegin(), lines[2].rend());
  svg += fmt::format("<path d='{}{}Z' fill='#d8dde3' stroke='#333'/>\n", path(lines[0], "M"), path(back, "L"));
  svg += fmt::format("<path d='{}' fill='none' stroke='#c02020' stroke-dasharray='8 4'/>\n", path(lines[1], "M"));
  return svg + fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='#c02020'/>\n", at(lines[1].front()).x(),
                           at(lines[1].front()).y());
}

// Dark blue, green, yellow: low, middle, high.
std::string Colour(double share) {
  constexpr std::array<std::array<double, 3>, 5> stops = {
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = std::clamp(share, 0.0, 1.0) * 4.0;
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
  const auto mix = [&](std::size_t k) {
    return static_cast<int>(stops[i][k] + (at - static_cast<double>(i)) * (stops[i + 1][k] - stops[i][k]));
  };
  return fmt::format("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2));
}

std::string Raster(const CrgSurface& surface, double top) {
  const CrgShape& shape = surface.shape();
  const double u0 = shape.line.begin_u_m(), v0 = shape.v_m.front(), width = shape.v_m.back() - v0;
  std::array<std::array<CrgPoint, kColumns>, kRows> points;
  ValueRange z;
  const auto point_at = [&](int row, int column) -> CrgPoint& {
    return points[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      CrgPoint& point = point_at(row, column);
      point = surface.At(u0 + surface.length_m() * (column + 0.5) / kColumns, v0 + width * (row + 0.5) / kRows);
      if (point.inside) z.Add(point.z_m);
    }
  }
  if (!(z.low <= z.high)) z = {0.0, 0.0};
  std::string svg = Frame(top, kRasterHeight,
                          fmt::format("heights from {:.4g} m (dark) to {:.4g} m (light); across u in m, upward v from "
                                      "{:.4g} to {:.4g} m; white: missing",
                                      z.low, z.high, v0, v0 + width));
  svg += "<g shape-rendering='crispEdges'>\n";
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns;) {
      const auto colour = [&](int c) {
        const CrgPoint& point = point_at(row, c);
        return point.inside ? Colour((point.z_m - z.low) / Size(z)) : std::string("#ffffff");
      };
      const std::string now = colour(column);
      int end = column + 1;
      while (end < kColumns && colour(end) == now) ++end;
      svg += fmt::format("<rect x='{:.0f}' y='{:.0f}' width='{:.0f}' height='{:.0f}' fill='{}'/>\n",
                         kLeft + kWidth * column / kColumns, top + kRasterHeight * (kRows - 1 - row) / kRows,
                         kWidth * (end - column) / kColumns, kRasterHeight / kRows, now);
      column = end;
    }
  }
  return svg + "</g>\n" + Ticks(top + kRasterHeight, u0, u0 + surface.length_m());
}

std::string Tracks(const CrgSurface& surface, double top) {
  const CrgShape& shape = surface.shape();
  const double u0 = shape.line.begin_u_m(), v0 = shape.v_m.front(), width = shape.v_m.back() - v0;
  const std::array<std::pair<double, const char*>, 3> tracks = {
      {{v0 + 0.25 * width, "#1f5f8b"}, {v0 + 0.5 * width, "#c02020"}, {v0 + 0.75 * width, "#2a8b3f"}}};
  ValueRange z;
  std::array<std::vector<CrgPoint>, 3> points;
  for (std::size_t k = 0; k < 3; ++k) {
    for (int i = 0; i <= kTrackPoints; ++i) {
      points[k].push_back(surface.At(u0 + surface.length_m() * i / kTrackPoints, tracks[k].first));
      if (points[k].back().inside) z.Add(points[k].back().z_m);
    }
  }
  if (!(z.low <= z.high)) z = {0.0, 0.0};
  std::string svg = Frame(top, kTrackHeight,
                          fmt::format("heights in m along v = {:.4g} m (blue), {:.4g} m (red), {:.4g} m (green)",
                                      tracks[0].first, tracks[1].first, tracks[2].first));
  svg += fmt::format(
      "<text x='{0}' y='{1}' text-anchor='end'>{2:.4g}</text><text x='{0}' y='{3}' text-anchor='end'>{4:.4g}</text>\n",
      kLeft - 5, top + 10, z.high, top + kTrackHeight, z.low);
  for (std::size_t k = 0; k < 3; ++k) {
    std::string path;
    bool drawing = false;
    for (int i = 0; i <= kTrackPoints; ++i) {
      const CrgPoint& point = points[k][static_cast<std::size_t>(i)];
      if (point.inside) {
        path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", kLeft + kWidth * i / kTrackPoints,
                            top + kTrackHeight * (0.95 - 0.9 * (point.z_m - z.low) / Size(z)));
      }
      drawing = point.inside;
    }
    svg += fmt::format("<path d='{}' fill='none' stroke='{}'/>\n", path, tracks[k].second);
  }
  return svg + Ticks(top + kTrackHeight, u0, u0 + surface.length_m());
}

}  // namespace

std::string PlotCrg(const CrgSurface& surface) {
  const double plan = 30.0, raster = plan + kPlanHeight + 30.0, tracks = raster + kRasterHeight + 45.0,
               height = tracks + kTrackHeight + 30.0;
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} {1:.0f}' "
      "font-family='sans-serif' font-size='11'>\n"
      "<rect width='100%' height='100%' fill='white'/>\n",
      kLeft + kWidth + 40.0, height);
  return svg + Plan(surface, plan) + Raster(surface, raster) + Tracks(surface, tracks) + "</svg>\n";
}

}  // namespace rodeira::surface
