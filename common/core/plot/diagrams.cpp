// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/append_format.hpp"
#include "common/core/base/xml_text.hpp"
#include "common/core/plot/table.hpp"

namespace rodeira::plot {
namespace {

constexpr int kWidth = 720, kHeight = 120, kLeft = 110, kTop = 44, kGap = 26;
constexpr std::size_t kMaxDiagrams = 24;
constexpr std::size_t kMaxPoints = 800;  // along the axis; between two of them the extremes are kept

struct Extent {
  double low = 0.0;
  double high = 0.0;
};

Extent ExtentOf(const Table& table, std::size_t column) {
  Extent extent{table.At(0, column), table.At(0, column)};
  for (std::size_t row = 1; row < table.rows(); ++row) {
    extent.low = std::min(extent.low, table.At(row, column));
    extent.high = std::max(extent.high, table.At(row, column));
  }
  const double spread = extent.high - extent.low;
  const bool constant = spread <= 1e-9 * std::max(std::fabs(extent.high), std::fabs(extent.low));
  const double room = constant ? std::max(0.1 * std::fabs(extent.high), 1e-3) : 0.05 * spread;
  return {extent.low - room, extent.high + room};
}

// 1, 2 or 5 times a power of ten, so that at most ten of them fit into a length.
double TickOf(double length) {
  double tick = std::pow(10.0, std::floor(std::log10(length / 10.0)));
  for (const double factor : {2.0, 2.5, 2.0}) {
    if (length / tick <= 10.0) break;
    tick *= factor;
  }
  return tick;
}

void AddLine(const Table& table, std::size_t column, int top, const Extent& extent, std::string& svg) {
  const double from = table.At(0, 0), to = table.At(table.rows() - 1, 0);
  const auto x = [&](double t) { return kLeft + (to > from ? (t - from) / (to - from) : 0.0) * kWidth; };
  const auto y = [&](double v) { return top + kHeight * (extent.high - v) / (extent.high - extent.low); };
  svg += "<polyline fill='none' stroke='#1f5f8b' stroke-width='1.2' points='";
  const std::size_t stride = std::max<std::size_t>(1, 2 * table.rows() / kMaxPoints);
  for (std::size_t row = 0; row < table.rows(); row += stride) {
    std::size_t low = row, high = row;
    for (std::size_t i = row; i < std::min(row + stride, table.rows()); ++i) {
      if (table.At(i, column) < table.At(low, column)) low = i;
      if (table.At(i, column) > table.At(high, column)) high = i;
    }
    for (const std::size_t i : {std::min(low, high), std::max(low, high)}) {
      base::AppendFormat(svg, "{:.1f},{:.1f} ", x(table.At(i, 0)), y(table.At(i, column)));
    }
  }
  svg += "'/>\n";
}

}  // namespace

std::string ToSvg(const Table& table, const std::string& title) {
  const std::size_t diagrams = std::min(kMaxDiagrams, table.names.size() - 1);
  const int height = kTop + static_cast<int>(diagrams) * (kHeight + kGap) + 20;
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}' font-family='sans-serif' "
      "font-size='11'>\n"
      "<rect width='{0}' height='{1}' fill='white'/>\n<text x='{2}' y='20' font-size='14'>{3}</text>\n",
      kLeft + kWidth + 20, height, kLeft, base::XmlText(title));
  if (table.rows() == 0) return svg + "</svg>\n";
  const double from = table.At(0, 0), to = table.At(table.rows() - 1, 0);
  for (std::size_t k = 0; k < diagrams; ++k) {
    const int top = kTop + static_cast<int>(k) * (kHeight + kGap);
    const Extent extent = ExtentOf(table, k + 1);
    svg += fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#bbb'/>\n", kLeft, top, kWidth,
                       kHeight);
    svg += fmt::format("<text x='{}' y='{}' fill='#1f5f8b'>{}</text>\n", kLeft, top - 4,
                       base::XmlText(table.names[k + 1]));
    svg += fmt::format(
        "<text x='{0}' y='{1}' text-anchor='end'>{2:.5g}</text><text x='{0}' y='{3}' "
        "text-anchor='end'>{4:.5g}</text>\n",
        kLeft - 6, top + 10, extent.high, top + kHeight, extent.low);
    const double tick = to > from ? TickOf(to - from) : 1.0;
    for (long n = std::lround(std::ceil(from / tick - 1e-9)); static_cast<double>(n) * tick <= to + 1e-9 * tick; ++n) {
      const double x = kLeft + (to > from ? kWidth * (static_cast<double>(n) * tick - from) / (to - from) : 0.0);
      svg += fmt::format("<line x1='{0:.1f}' y1='{1}' x2='{0:.1f}' y2='{2}' stroke='#eee'/>\n", x, top, top + kHeight);
      if (k + 1 == diagrams)
        svg += fmt::format("<text x='{:.1f}' y='{}' text-anchor='middle'>{:.6g}</text>\n", x, top + kHeight + 14,
                           static_cast<double>(n) * tick);
    }
    AddLine(table, k + 1, top, extent, svg);
  }
  svg += fmt::format("<text x='{}' y='{}' text-anchor='end'>{}</text>\n</svg>\n", kLeft - 6, height - 20 + 8,
                     base::XmlText(table.names[0]));
  return svg;
}

}  // namespace rodeira::plot
