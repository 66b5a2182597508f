// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/geometry/angle.hpp"
#include "common/world/surface/crg_columns.hpp"

namespace rodeira::surface {
namespace {

constexpr double kSharpest_rad = 0.5 * geometry::kPi;
constexpr double kGapRefused = 1e-2;  // of the length
constexpr double kGapTold = 1e-4;

class Builder {
 public:
  Builder(const CrgHeader& header, const CrgTable& table, const CrgModifiers& modifiers, std::string_view name,
          std::vector<std::string>& warnings)
      : header_(header), road_(header.road), table_(table), modifiers_(modifiers), name_(name), warnings_(warnings) {}

  base::Result<CrgShape> Build(const CrgOptions& options) {
    if (!road_.increment_m)
      return Wrong("key 'REFERENCE_LINE_INCREMENT' is missing; the distance of two rows was expected");
    step_m_ = *road_.increment_m;
    auto columns = FindCrgColumns(header_, name_, warnings_);
    if (!columns) return columns.error();
    columns_ = std::move(columns).value();
    auto points = Line();
    if (!points) return points.error();
    auto line_z = LineHeights();
    if (!line_z) return line_z.error();
    std::vector<double> banking =
        RowValues(columns_.banking, road_.start_banking.value_or(0.0), modifiers_.scale_banking);
    if (const auto fine = Finite(banking, "banking"); !fine) return fine.error();
    CrgShape shape{
        CrgReferenceLine(road_.start_u_m.value_or(0.0), step_m_ * modifiers_.scale_length, std::move(points).value()),
        std::move(columns_.v_m),
        {},
        std::move(line_z).value(),
        std::move(banking),
        options};
    for (double& v : shape.v_m) v *= modifiers_.scale_width;
    shape.heights = Heights();
    return shape;
  }

 private:
  base::Error Wrong(std::string_view message) const { return base::WrongInput("surface.wrong_header", message, name_); }

  // A column, or the same number everywhere; times the scale.
  std::vector<double> RowValues(int column, double default_value, double scale) const {
    std::vector<double> values(table_.rows, default_value * scale);
    if (column < 0) return values;
    for (std::size_t row = 0; row < table_.rows; ++row)
      values[row] = scale * table_.At(row, static_cast<std::size_t>(column));
    return values;
  }

  // A value a row; the first row's may be missing where it is not used.
  base::Status Finite(const std::vector<double>& values, std::string_view what, std::size_t from = 0) const {
    for (std::size_t row = from; row < values.size(); ++row) {
      if (!(std::fabs(values[row]) <= 1e9)) {
        return Wrong(
            fmt::format("the reference line's {} in row {} is {}; a number was expected", what, row + 1, values[row]));
      }
    }
    return {};
  }

  // What is missing at the end of a sum, told or refused by its share of the length.
  base::Status Gap(double gap_m, std::string_view what) {
    const double length = step_m_ * static_cast<double>(table_.rows - 1);
    if (gap_m > kGapRefused * length) {
      return Wrong(fmt::format(
          "the reference line's {} ends {:.4g} m beside the end that the header names; at most {:.4g} m (1 % of the "
          "length) were expected",
          what, gap_m, kGapRefused * length));
    }
    if (gap_m > kGapTold * length) {
      warnings_.push_back(
          fmt::format("the reference line's {} ends {:.4g} m beside the end that the header names; the gap is shared "
                      "among the rows",
                      what, gap_m));
    }
    return {};
  }

  // The heading of the step that ends in each row, from row 1 on.
  base::Result<std::vector<double>> Headings() {
    std::vector<double> heading(table_.rows, road_.start_heading_rad.value_or(0.0));
    const bool ends = road_.start_x_m && road_.start_y_m && road_.end_x_m && road_.end_y_m;
    if (columns_.heading >= 0) {
      heading = RowValues(columns_.heading, 0.0, 1.0);
      if (const auto fine = Finite(heading, "heading", 1); !fine) return fine.error();
    } else if (columns_.x >= 0) {
      for (std::size_t row = 1; row < table_.rows; ++row) {
        const Eigen::Vector2d step = Point(row) - Point(row - 1);
        if (!(std::fabs(step.norm() - step_m_) <= kIncrementTolerance * step_m_)) {
          return Wrong(
              fmt::format("the reference line goes {:.6g} m from row {} to the next; REFERENCE_LINE_INCREMENT says {}",
                          step.norm(), row, step_m_));
        }
        heading[row] = std::atan2(step.y(), step.x());
      }
    } else if (!road_.start_heading_rad && ends) {
      heading.assign(table_.rows, std::atan2(*road_.end_y_m - *road_.start_y_m, *road_.end_x_m - *road_.start_x_m));
    }
    for (std::size_t row = 2; row < table_.rows; ++row) {
      const double turn = geometry::WrapAngle(heading[row] - heading[row - 1]);
      if (std::fabs(turn) >= kSharpest_rad) {
        return Wrong(fmt::format("the reference line turns by {:.3g} rad in row {}; less than 90 degrees were expected",
                                 turn, row));
      }
    }
    if (modifiers_.scale_curvature != 1.0) {
      double before = heading[1];
      for (std::size_t row = 2; row < table_.rows; ++row) {
        const double turn = geometry::WrapAngle(heading[row] - before);
        before = heading[row];
        heading[row] = heading[row - 1] + modifiers_.scale_curvature * turn;
        if (std::fabs(modifiers_.scale_curvature * turn) >= kSharpest_rad) {
          return Wrong(fmt::format("SCALE_CURVATURE bends the reference line by more than 90 degrees in row {}", row));
        }
      }
    }
    return heading;
  }

  Eigen::Vector2d Point(std::size_t row) const {
    return {table_.At(row, static_cast<std::size_t>(columns_.x)), table_.At(row, static_cast<std::size_t>(columns_.y))};
  }

  base::Result<std::vector<Eigen::Vector2d>> Line() {
    auto headings = Headings();
    if (!headings) return headings.error();
    Eigen::Vector2d begin(road_.start_x_m.value_or(0.0), road_.start_y_m.value_or(0.0));
    std::optional<Eigen::Vector2d> end;
    if (road_.end_x_m && road_.end_y_m) end = Eigen::Vector2d(*road_.end_x_m, *road_.end_y_m);
    if (columns_.heading < 0 && columns_.x >= 0) begin = Point(0), end = Point(table_.rows - 1);
    std::vector<Eigen::Vector2d> points = {begin};
    for (std::size_t row = 1; row < table_.rows; ++row) {
      const double heading = headings.value()[row];
      points.push_back(points.back() +
                       step_m_ * modifiers_.scale_length * Eigen::Vector2d(std::cos(heading), std::sin(heading)));
    }
    if (!end || modifiers_.scale_curvature != 1.0) return points;
    const Eigen::Vector2d gap = begin + modifiers_.scale_length * (*end - begin) - points.back();
    if (const auto fine = Gap(gap.norm() / modifiers_.scale_length, "plan"); !fine) return fine.error();
    for (std::size_t row = 1; row < table_.rows; ++row) {
      points[row] += (static_cast<double>(row) / static_cast<double>(table_.rows - 1)) * gap;
    }
    return points;
  }

  base::Result<std::vector<double>> LineHeights() {
    const std::vector<double> slope =
        RowValues(columns_.slope, road_.start_slope.value_or(0.0), modifiers_.scale_slope);
    if (const auto fine = Finite(slope, "slope", 1); !fine) return fine.error();
    const double begin = road_.start_z_m.value_or(0.0);
    std::vector<double> z = {begin};
    for (std::size_t row = 1; row < table_.rows; ++row)
      z.push_back(z.back() + step_m_ * modifiers_.scale_length * slope[row]);
    if (!road_.end_z_m || !road_.start_z_m) return z;
    const double scale = modifiers_.scale_slope * modifiers_.scale_length;
    const double gap = begin + scale * (*road_.end_z_m - begin) - z.back();
    if (const auto fine = Gap(std::fabs(gap) / std::max(std::fabs(scale), 1.0), "profile"); !fine) return fine.error();
    for (std::size_t row = 1; row < table_.rows; ++row) {
      z[row] += static_cast<double>(row) / static_cast<double>(table_.rows - 1) * gap;
    }
    return z;
  }

  std::vector<double> Heights() const {
    const std::size_t sections = columns_.heights.size();
    std::vector<double> heights(table_.rows * sections);
    for (std::size_t row = 0; row < table_.rows; ++row) {
      double* of_row = heights.data() + row * sections;
      for (std::size_t i = 0; i < sections; ++i)
        of_row[i] = modifiers_.scale_height * table_.At(row, columns_.heights[i]);
      const auto there = [](double z) { return !std::isnan(z); };
      double* first = std::find_if(of_row, of_row + sections, there);
      if (first == of_row + sections || modifiers_.missing == 0) continue;
      double* last = of_row + sections - 1;
      while (std::isnan(*last)) --last;
      const bool zero = modifiers_.missing == 1;
      const double right = (zero ? 0.0 : *first) + modifiers_.missing_offset_m,
                   left = (zero ? 0.0 : *last) + modifiers_.missing_offset_m;
      std::fill(of_row, first, right);
      std::fill(last + 1, of_row + sections, left);
    }
    return heights;
  }

  const CrgHeader& header_;
  const CrgRoadKeys& road_;
  const CrgTable& table_;
  const CrgModifiers& modifiers_;
  std::string_view name_;
  std::vector<std::string>& warnings_;
  double step_m_ = 0.0;
  CrgColumns columns_;
};

}  // namespace

base::Result<CrgShape> BuildCrgShape(const CrgHeader& header, const CrgTable& table, const CrgModifiers& modifiers,
                                     const CrgOptions& options, std::string_view name,
                                     std::vector<std::string>& warnings) {
  return Builder(header, table, modifiers, name, warnings).Build(options);
}

}  // namespace rodeira::surface
