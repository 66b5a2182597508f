// SPDX-License-Identifier: Apache-2.0
#include "common/core/plot/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/core/base/append_format.hpp"

namespace rodeira::plot {
namespace {

constexpr int kPlotWidth = 420, kPlotHeight = 280;
constexpr int kMarginLeft = 78, kMarginTop = 34, kMarginRight = 150, kMarginBottom = 48, kTitleHeight = 40;
constexpr std::array kColours = {"#1f5f8b", "#c1440e", "#2e7d32", "#7b3fa0", "#b8860b", "#444444", "#00838f"};

std::string SvgText(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

struct Axis {
  double low = 0.0, high = 1.0, tick = 0.2;
};

// Ends on ticks of 1, 2 or 5 times a power of ten, about six of them.
Axis AxisOf(double low, double high) {
  if (!(low <= high)) return {};
  if (high - low <= 1e-12 * std::max(std::fabs(low), std::fabs(high)) || high == low) {
    low -= 0.5;
    high += 0.5;
  }
  const double raw = (high - low) / 6.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double tick = power * (raw / power <= 1.0 ? 1.0 : raw / power <= 2.0 ? 2.0 : raw / power <= 5.0 ? 5.0 : 10.0);
  return {std::floor(low / tick + 1e-9) * tick, std::ceil(high / tick - 1e-9) * tick, tick};
}

bool IsDrawn(const std::pair<double, double>& point) {
  return std::isfinite(point.first) && std::isfinite(point.second);
}

struct Frame {
  int left, top;
  Axis x, y;
  double X(double value) const { return left + (value - x.low) / (x.high - x.low) * kPlotWidth; }
  double Y(double value) const { return top + (y.high - value) / (y.high - y.low) * kPlotHeight; }
};

Frame FrameOf(const Diagram& diagram, int left, int top) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double x_low = kInfinity, x_high = -kInfinity, y_low = kInfinity, y_high = -kInfinity;
  for (const Curve& curve : diagram.curves) {
    for (const auto& point : curve.points) {
      if (!IsDrawn(point)) continue;
      x_low = std::min(x_low, point.first), x_high = std::max(x_high, point.first);
      y_low = std::min(y_low, point.second), y_high = std::max(y_high, point.second);
    }
  }
  for (const double x : diagram.shown_x) x_low = std::min(x_low, x), x_high = std::max(x_high, x);
  return {left, top, AxisOf(x_low, x_high), AxisOf(y_low, y_high)};
}

void AddAxes(const Diagram& diagram, const Frame& frame, std::string& svg) {
  const int bottom = frame.top + kPlotHeight, right = frame.left + kPlotWidth;
  const auto number = [](double value, double tick) { return std::fabs(value) < 1e-9 * tick ? 0.0 : value; };
  for (long i = std::lround(frame.x.low / frame.x.tick); i <= std::lround(frame.x.high / frame.x.tick); ++i) {
    const double value = static_cast<double>(i) * frame.x.tick;
    base::AppendFormat(svg,
                       "<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' stroke='{3}'/><text x='{0:.1f}' y='{4}' "
                       "text-anchor='middle'>{5:.6g}</text>\n",
                       frame.X(value), frame.top, bottom, i == 0 ? "#999" : "#e6e6e6", bottom + 15,
                       number(value, frame.x.tick));
  }
  for (long i = std::lround(frame.y.low / frame.y.tick); i <= std::lround(frame.y.high / frame.y.tick); ++i) {
    const double value = static_cast<double>(i) * frame.y.tick;
    base::AppendFormat(svg,
                       "<line x1='{0}' y1='{1:.1f}' x2='{2}' y2='{1:.1f}' stroke='{3}'/><text x='{4}' y='{5:.1f}' "
                       "text-anchor='end'>{6:.6g}</text>\n",
                       frame.left, frame.Y(value), right, i == 0 ? "#999" : "#e6e6e6", frame.left - 5,
                       frame.Y(value) + 4.0, number(value, frame.y.tick));
  }
  base::AppendFormat(svg, "<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>\n", frame.left,
                     frame.top, kPlotWidth, kPlotHeight);
  base::AppendFormat(svg, "<text x='{}' y='{}' font-size='13'>{}</text>\n", frame.left, frame.top - 10,
                     SvgText(diagram.title));
  base::AppendFormat(svg, "<text x='{}' y='{}' text-anchor='middle'>{}</text>\n", frame.left + kPlotWidth / 2,
                     bottom + 32, SvgText(diagram.x_name));
  base::AppendFormat(svg, "<text transform='translate({},{}) rotate(-90)' text-anchor='middle'>{}</text>\n",
                     frame.left - 58, frame.top + kPlotHeight / 2, SvgText(diagram.y_name));
}

void AddMarks(const Diagram& diagram, const Frame& frame, std::string& svg) {
  for (const auto& [x, name] : diagram.marks) {
    if (!(x >= frame.x.low && x <= frame.x.high)) continue;
    base::AppendFormat(
        svg,
        "<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' stroke='#b8860b' stroke-dasharray='4 3'/><text "
        "transform='translate({3:.1f},{4}) rotate(90)' font-size='9' fill='#7a5a00'>{5}</text>\n",
        frame.X(x), frame.top, frame.top + kPlotHeight, frame.X(x) + 3.0, frame.top + 4, SvgText(name));
  }
}

void AddCurves(const Diagram& diagram, const Frame& frame, std::string& svg) {
  int row = 0;
  for (const Curve& curve : diagram.curves) {
    const char* colour = kColours[static_cast<std::size_t>(row) % kColours.size()];
    base::AppendFormat(svg, "<polyline fill='none' stroke='{}' stroke-width='1.4' points='", colour);
    bool begun = false, interrupted = false;
    for (const auto& point : curve.points) {
      if (IsDrawn(point)) {
        if (interrupted)
          base::AppendFormat(svg, "'/>\n<polyline fill='none' stroke='{}' stroke-width='1.4' points='", colour);
        base::AppendFormat(svg, "{:.1f},{:.1f} ", frame.X(point.first), frame.Y(point.second));
        begun = true;
        interrupted = false;
      } else {
        interrupted = begun;
      }
    }
    svg += "'/>\n";
    const int y = frame.top + 12 + 15 * row, x = frame.left + kPlotWidth + 12;
    base::AppendFormat(svg,
                       "<line x1='{}' y1='{}' x2='{}' y2='{}' stroke='{}' stroke-width='2'/><text x='{}' y='{}'>{}"
                       "</text>\n",
                       x, y - 4, x + 18, y - 4, colour, x + 23, y, SvgText(curve.name));
    ++row;
  }
}

}  // namespace

std::string ToSvg(const std::vector<Diagram>& diagrams, const std::string& title, int columns) {
  const int cell_width = kMarginLeft + kPlotWidth + kMarginRight,
            cell_height = kMarginTop + kPlotHeight + kMarginBottom;
  const int count = static_cast<int>(diagrams.size());
  const int rows = (count + columns - 1) / columns;
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}' font-family='sans-serif' "
      "font-size='11'>\n<rect width='{0}' height='{1}' fill='white'/>\n<text x='{2}' y='26' "
      "font-size='16'>{3}</text>\n",
      cell_width * std::min(columns, std::max(1, count)), kTitleHeight + rows * cell_height, kMarginLeft,
      SvgText(title));
  for (int i = 0; i < count; ++i) {
    const Diagram& diagram = diagrams[static_cast<std::size_t>(i)];
    const Frame frame =
        FrameOf(diagram, i % columns * cell_width + kMarginLeft, kTitleHeight + i / columns * cell_height + kMarginTop);
    AddAxes(diagram, frame, svg);
    AddMarks(diagram, frame, svg);
    AddCurves(diagram, frame, svg);
  }
  return svg + "</svg>\n";
}

}  // namespace rodeira::plot
