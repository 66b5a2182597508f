// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rodeira::plot {

// A line through points (x, y) and its name in the key.
struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
};

// Several curves over the same axes. Names of axes end in their units.
struct Diagram {
  std::string title;
  std::string x_name, y_name;
  std::vector<Curve> curves;
  std::vector<std::pair<double, std::string>> marks{};  // vertical lines at x, each with its name
  std::vector<double> shown_x{};                        // lie on the axis of x, with all points
};

// The diagrams side by side, `columns` in a row, as SVG: axes with ticks, and a key of the curves beside each.
// A point that is not finite interrupts its curve. Marks beyond the axis of x are left out.
std::string ToSvg(const std::vector<Diagram>& diagrams, const std::string& title, int columns = 2);

}  // namespace rodeira::plot
