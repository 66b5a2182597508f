// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"

namespace rodeira::traffic {

// Points of a measurement, or a line of a theory, for a picture.
struct PlotCurve {
  std::string name, colour;
  std::vector<std::pair<double, double>> points;
  bool line = false;
};

// All of them over the same axes, from 0 on; a tick every so many units. A curve without a name has no row among the
// names.
inline std::string PlotSvg(const std::string& title, const std::string& across, const std::string& up, double tick_x,
                           double tick_y, const std::vector<PlotCurve>& curves) {
  constexpr double kWide = 560.0, kHigh = 300.0, kLeft = 70.0, kRow = 16.0;
  const auto named =
      std::count_if(curves.begin(), curves.end(), [](const PlotCurve& curve) { return !curve.name.empty(); });
  const double top =
      36.0 + kRow * static_cast<double>(named);  // their names stand above the axes, where they hide nothing
  double most_x = tick_x, most_y = tick_y;
  for (const PlotCurve& curve : curves) {
    for (const auto& [x, y] : curve.points) most_x = std::max(most_x, x), most_y = std::max(most_y, y);
  }
  most_x = tick_x * std::ceil(most_x / tick_x), most_y = tick_y * std::ceil(most_y / tick_y);
  const auto x_of = [&](double x) { return kLeft + kWide * x / most_x; };
  const auto y_of = [&](double y) { return top + kHigh * (1.0 - y / most_y); };
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}' font-family='sans-serif' "
      "font-size='12'>\n"
      "<rect width='{0}' height='{1}' fill='white'/>\n<text x='{2}' y='22' font-size='14'>{3}</text>\n",
      kLeft + kWide + 30.0, top + kHigh + 60.0, kLeft, title);
  const auto into = std::back_inserter(svg);
  for (double x = 0.0; x <= most_x + 1e-9; x += tick_x) {
    fmt::format_to(into,
                   "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}' stroke='#ddd'/><text x='{0:.1f}' y='{3}' "
                   "text-anchor='middle'>{4:g}</text>\n",
                   x_of(x), top, top + kHigh, top + kHigh + 18.0, x);
  }
  for (double y = 0.0; y <= most_y + 1e-9; y += tick_y) {
    fmt::format_to(into,
                   "<line x1='{0}' x2='{1}' y1='{2:.1f}' y2='{2:.1f}' stroke='#ddd'/><text x='{3}' y='{4:.1f}' "
                   "text-anchor='end'>{5:g}</text>\n",
                   kLeft, kLeft + kWide, y_of(y), kLeft - 6.0, y_of(y) + 4.0, y);
  }
  fmt::format_to(into,
                 "<text x='{}' y='{}' text-anchor='middle'>{}</text>\n<text x='16' y='{}' transform='rotate(-90 16 "
                 "{})' text-anchor='middle'>{}</text>\n",
                 kLeft + 0.5 * kWide, top + kHigh + 42.0, across, top + 0.5 * kHigh, top + 0.5 * kHigh, up);
  double row = 38.0;
  for (const PlotCurve& curve : curves) {
    if (curve.line) {
      fmt::format_to(into, "<polyline fill='none' stroke='{}' stroke-width='1.5' points='", curve.colour);
      for (const auto& [x, y] : curve.points) fmt::format_to(into, "{:.1f},{:.1f} ", x_of(x), y_of(y));
      svg += "'/>\n";
    } else {
      for (const auto& [x, y] : curve.points)
        fmt::format_to(into, "<circle cx='{:.1f}' cy='{:.1f}' r='4' fill='{}'/>\n", x_of(x), y_of(y), curve.colour);
    }
    if (curve.name.empty()) continue;
    fmt::format_to(into, "<text x='{}' y='{}' fill='{}'>{} {}</text>\n", kLeft, row, curve.colour,
                   curve.line ? "—" : "●", curve.name);
    row += kRow;
  }
  return svg + "</svg>\n";
}

// Into the folder that RODEIRA_PICTURES names, where pictures are wanted; whether that went well.
inline bool WritePicture(const std::string& name, const std::string& svg) {
  const char* folder = std::getenv("RODEIRA_PICTURES");
  return folder == nullptr || base::WriteWhole(std::filesystem::path(folder) / name, svg).ok();
}

}  // namespace rodeira::traffic
