// SPDX-License-Identifier: Apache-2.0
#include "common/world/network/junction_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/core/base/bytes.hpp"

namespace rodeira::network {
namespace {

using Pair = std::array<double, 2>;

// The squares between two rows: from the first line of them on the right to the last one on the left.
std::pair<int, int> LinesBetween(const JunctionGridRow& a, const JunctionGridRow& b) {
  return {-static_cast<int>(std::min(a.right_m.size(), b.right_m.size())),
          static_cast<int>(std::min(a.left_m.size(), b.left_m.size()))};
}

// Slopes of the cubic through f(-1), f(0), f(1), f(2) at 0 and 1.
Pair CubicSlopes(double before, double first, double second, double behind) {
  return {(-2.0 * before - 3.0 * first + 6.0 * second - behind) / 6.0,
          (before - 6.0 * first + 3.0 * second + 2.0 * behind) / 6.0};
}

// Of a cubic between 0 and 1 by values and slopes there: what each counts at x, and how that changes.
struct Hermite {
  Pair value, slope, value_rate, slope_rate;

  explicit Hermite(double x)
      : value{1.0 - x * x * (3.0 - 2.0 * x), x * x * (3.0 - 2.0 * x)},
        slope{x * (1.0 - x) * (1.0 - x), x * x * (x - 1.0)},
        value_rate{-6.0 * x * (1.0 - x), 6.0 * x * (1.0 - x)},
        slope_rate{(1.0 - x) * (1.0 - 3.0 * x), x * (3.0 * x - 2.0)} {}
};

// Held between 0 and 1, and whether it was there: beyond, nothing changes any more.
double Hold(double& x) {
  const double held = std::clamp(x, 0.0, 1.0);
  const double moves = held == x ? 1.0 : 0.0;
  x = held;
  return moves;
}

}  // namespace

std::optional<JunctionGrid> JunctionGrid::Make(geometry::PlanAxis line, double start_m, double spacing_m,
                                               std::vector<JunctionGridRow> rows) {
  if (!(spacing_m > 0.0) || rows.size() < 2) return std::nullopt;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const auto [low, high] = LinesBetween(rows[i], rows[i + 1]);
    if (low == high) return std::nullopt;
  }
  return JunctionGrid(std::move(line), start_m, spacing_m, std::move(rows));
}

base::Digest JunctionGrid::Digest() const {
  base::ByteWriter out;
  const auto put = [&out](const auto& numbers) {
    out.Put(static_cast<std::uint64_t>(numbers.size()));
    for (const double number : numbers) out.Put(number + 0.0);  // -0 is 0
  };
  put(std::array<double, 2>{start_m_, spacing_m_});
  for (const geometry::PlanElement& element : line_.elements()) {
    put(std::array<double, 8>{element.s_m, element.length_m, element.start_W.x(), element.start_W.y(),
                              element.heading_rad, element.curvature_start_1pm, element.curvature_end_1pm,
                              element.p_end});
    put(element.u), put(element.v);
  }
  for (const JunctionGridRow& row : rows_) put(std::array<double, 1>{row.centre_m}), put(row.left_m), put(row.right_m);
  return base::Hash(out.bytes());
}

JunctionGrid::Spot JunctionGrid::Find(const Eigen::Vector2d& p_W) const {
  const auto& panels = line_.panels();
  double best_m = std::numeric_limits<double>::infinity(), s = 0.0, t = 0.0, pace = 1.0;
  Eigen::Vector2d tangent = Eigen::Vector2d::UnitX();
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const geometry::AxisFoot foot = line_.Foot(panels[i], p_W);
    const bool goes_on = (i == 0 && foot.beyond_m < 0.0) ||
                         (i + 1 == panels.size() && foot.beyond_m > 0.0);  // straight, beyond both ends
    const double distance = goes_on ? std::fabs(foot.t_m) : std::hypot(foot.t_m, foot.beyond_m);
    if (distance >= best_m) continue;
    best_m = distance;
    s = panels[i].middle_s_m + foot.u_m + (goes_on ? foot.beyond_m : 0.0);
    t = foot.t_m;
    pace = goes_on ? 1.0 : 1.0 - foot.at.curvature_1pm * foot.t_m;
    tangent = foot.at.tangent_W;
  }
  return {(s - start_m_) / spacing_m_, t / spacing_m_, 1.0 / (spacing_m_ * std::max(pace, 1e-3)), tangent};
}

const double* JunctionGrid::HeightAt(int row, int left) const {
  if (row < 0 || row >= static_cast<int>(rows_.size())) return nullptr;
  const JunctionGridRow& at = rows_[static_cast<std::size_t>(row)];
  if (left == 0) return &at.centre_m;
  const std::vector<double>& side = left > 0 ? at.left_m : at.right_m;
  const auto index = static_cast<std::size_t>(std::abs(left)) - 1;
  return index < side.size() ? &side[index] : nullptr;
}

// Slopes, a spacing, at both ends of the square's side that begins here and goes along the line, or to the left.
void JunctionGrid::Tangents(int row, int left, bool along, double& first, double& second) const {
  const auto at = [&](int n) { return along ? HeightAt(row + n, left) : HeightAt(row, left + n); };
  const double *before = at(-1), *behind = at(2);
  if (before == nullptr || behind == nullptr) {
    first = second = *at(1) - *at(0);
    return;
  }
  const Pair slopes = CubicSlopes(*before, *at(0), *at(1), *behind);
  first = slopes[0], second = slopes[1];
}

bool JunctionGrid::Covers(const Eigen::Vector2d& p_W) const {
  const Spot spot = Find(p_W);
  const double last = static_cast<double>(rows_.size() - 1);
  if (!(spot.row >= 0.0 && spot.row <= last)) return false;
  const auto row = static_cast<std::size_t>(std::min(spot.row, last - 1.0));
  const auto [low, high] = LinesBetween(rows_[row], rows_[row + 1]);
  return spot.left >= low && spot.left <= high;
}

GroundHeight JunctionGrid::At(const Eigen::Vector2d& p_W) const {
  const Spot spot = Find(p_W);
  const int row = static_cast<int>(std::clamp(std::floor(spot.row), 0.0, static_cast<double>(rows_.size() - 2)));
  const auto [low, high] = LinesBetween(rows_[static_cast<std::size_t>(row)], rows_[static_cast<std::size_t>(row) + 1]);
  const int left =
      static_cast<int>(std::clamp(std::floor(spot.left), static_cast<double>(low), static_cast<double>(high - 1)));
  double x = spot.row - row, y = spot.left - left;
  const double x_moves = Hold(x), y_moves = Hold(y);

  std::array<Pair, 2> z, by_row, by_left, by_both;  // [row][left], a spacing
  for (const int n : {0, 1}) {
    const auto at = static_cast<std::size_t>(n);
    Tangents(row, left + n, true, by_row[0][at], by_row[1][at]);
    Tangents(row + n, left, false, by_left[at][0], by_left[at][1]);
    for (const int m : {0, 1}) z[static_cast<std::size_t>(m)][at] = *HeightAt(row + m, left + n);
  }
  bool all = true;
  for (int m = -1; m <= 2; ++m) {
    for (int n = -1; n <= 2; ++n) all = all && HeightAt(row + m, left + n) != nullptr;
  }
  Pair before{}, behind{};  // slopes along the lines beside the square
  if (all) Tangents(row, left - 1, true, before[0], before[1]), Tangents(row, left + 2, true, behind[0], behind[1]);
  for (std::size_t m = 0; m < 2; ++m) {
    const double twist = by_row[m][1] - by_row[m][0];
    by_both[m] = all ? CubicSlopes(before[m], by_row[m][0], by_row[m][1], behind[m]) : Pair{twist, twist};
  }

  const Hermite along(x), across(y);
  GroundHeight height;
  double z_row = 0.0, z_left = 0.0;
  for (std::size_t m = 0; m < 2; ++m) {
    for (std::size_t n = 0; n < 2; ++n) {
      const double by_value = z[m][n] * across.value[n] + by_left[m][n] * across.slope[n];
      const double by_slope = by_row[m][n] * across.value[n] + by_both[m][n] * across.slope[n];
      height.z_m += along.value[m] * by_value + along.slope[m] * by_slope;
      z_row += along.value_rate[m] * by_value + along.slope_rate[m] * by_slope;
      z_left += along.value[m] * (z[m][n] * across.value_rate[n] + by_left[m][n] * across.slope_rate[n]) +
                along.slope[m] * (by_row[m][n] * across.value_rate[n] + by_both[m][n] * across.slope_rate[n]);
    }
  }
  const Eigen::Vector2d left_W(-spot.tangent_W.y(), spot.tangent_W.x());
  const Eigen::Vector2d slope =
      x_moves * z_row * spot.row_per_m * spot.tangent_W + y_moves * z_left / spacing_m_ * left_W;
  height.slope_x = slope.x(), height.slope_y = slope.y();
  return height;
}

}  // namespace rodeira::network
