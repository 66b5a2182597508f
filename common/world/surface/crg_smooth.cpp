// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_smooth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/base/assert.hpp"

namespace rodeira::surface {
namespace {

// The means of a line of heights, each over as many neighbours on either side as both lie within reach. at_m: ascending
// places.
void SmoothLine(const std::vector<double>& at_m, double reach_m, std::vector<double>& heights) {
  const std::size_t count = heights.size();
  std::vector<double> sums(count + 1, 0.0), known(count + 1, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const bool there = !std::isnan(heights[i]);
    sums[i + 1] = sums[i] + (there ? heights[i] : 0.0);
    known[i + 1] = known[i] + (there ? 1.0 : 0.0);
  }
  std::vector<double> smooth(count, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(heights[i])) continue;
    std::size_t aside = 0;
    while (aside < i && i + aside + 1 < count && at_m[i] - at_m[i - aside - 1] <= reach_m &&
           at_m[i + aside + 1] - at_m[i] <= reach_m)
      ++aside;
    smooth[i] = (sums[i + aside + 1] - sums[i - aside]) / (known[i + aside + 1] - known[i - aside]);
  }
  heights = std::move(smooth);
}

}  // namespace

CrgSurface Smoothed(const CrgSurface& surface, double reach_m) {
  RODEIRA_ASSERT(reach_m > 0.0);
  CrgShape shape = surface.shape();
  const std::size_t rows = surface.rows(), sections = shape.v_m.size();
  std::vector<double> u_m(rows), line;
  for (std::size_t row = 0; row < rows; ++row) u_m[row] = static_cast<double>(row) * shape.line.step_m();
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t row = 0; row < rows; ++row) {
      const auto begin = shape.heights.begin() + static_cast<std::ptrdiff_t>(row * sections);
      line.assign(begin, begin + static_cast<std::ptrdiff_t>(sections));
      SmoothLine(shape.v_m, reach_m, line);
      std::copy(line.begin(), line.end(), begin);
    }
    line.resize(rows);
    for (std::size_t section = 0; section < sections; ++section) {
      for (std::size_t row = 0; row < rows; ++row) line[row] = shape.heights[row * sections + section];
      SmoothLine(u_m, reach_m, line);
      for (std::size_t row = 0; row < rows; ++row) shape.heights[row * sections + section] = line[row];
    }
  }
  return CrgSurface(std::move(shape));
}

}  // namespace rodeira::surface
