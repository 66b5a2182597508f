// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "common/core/base/suggest.hpp"
#include "common/core/geometry/polyline.hpp"
#include "common/core/geometry/tolerances.hpp"

namespace rodeira::geometry {
namespace {

constexpr double kFarthest_m = 1e9;
const std::vector<std::string> kColumns = {"x_m", "y_m", "z_m"};

std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (cell.starts_with(' ') || cell.starts_with('\t')) cell.remove_prefix(1);
    while (cell.ends_with(' ') || cell.ends_with('\t')) cell.remove_suffix(1);
    cells.push_back(cell);
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

class CsvReader {
 public:
  explicit CsvReader(const std::string& name) : name_(name) {}

  base::Result<Polyline> Read(std::string_view text) {
    while (!text.empty()) {
      const auto end = text.find('\n');
      std::string_view line = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      ++line_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (line.find_first_not_of(" \t") == std::string_view::npos || line.starts_with('#')) continue;
      if (const auto status = columns_.empty() ? Header(line) : Point(line); !status) return status.error();
    }
    if (columns_.empty()) {
      return base::WrongInput("polyline.too_few_points",
                              "the file is empty; a line 'x_m,y_m,z_m' and a point a line were expected", name_);
    }
    if (line_of_.size() < 2) {
      return base::WrongInput("polyline.too_few_points",
                              fmt::format("the file has {} points; at least 2 were expected", line_of_.size()), name_);
    }
    return std::move(polyline_);
  }

 private:
  base::Error Wrong(std::string_view message) const {
    return base::WrongInput("polyline.wrong_line", message, fmt::format("{}:{}", name_, line_));
  }

  base::Status Header(std::string_view line) {
    std::array<bool, 3> there{};
    for (const std::string_view cell : Cells(line)) {
      const auto known = std::find(kColumns.begin(), kColumns.end(), cell);
      if (known == kColumns.end()) {
        return Wrong(fmt::format("column '{}' is unknown{}", cell.substr(0, 40),
                                 base::DidYouMean(cell.substr(0, 40), kColumns)));
      }
      const auto axis = static_cast<std::size_t>(known - kColumns.begin());
      if (there[axis]) return Wrong(fmt::format("column '{}' is there twice", cell));
      there[axis] = true;
      columns_.push_back(axis);
    }
    if (!there[0] || !there[1]) {
      return Wrong(fmt::format(
          "column '{}' is missing; the first line names the columns x_m, y_m and, if there are heights, z_m",
          there[0] ? "y_m" : "x_m"));
    }
    polyline_.has_z = there[2];
    return {};
  }

  base::Status Point(std::string_view line) {
    const auto cells = Cells(line);
    if (cells.size() != columns_.size()) {
      return Wrong(fmt::format("{} values were found; {} were expected", cells.size(), columns_.size()));
    }
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string_view text = cells[i].starts_with('+') ? cells[i].substr(1) : cells[i];
      double& value = p[static_cast<Eigen::Index>(columns_[i])];
      const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (problem != std::errc() || end != text.data() + text.size() || !(std::fabs(value) <= kFarthest_m)) {
        return Wrong(fmt::format("'{}' is '{}'; a number of at most 1e9 was expected", kColumns[columns_[i]],
                                 cells[i].substr(0, 40)));
      }
    }
    if (!line_of_.empty() && (p - polyline_.points_W.back()).head<2>().norm() <= kSamePoint_m) {
      return Wrong(fmt::format("the point ({}, {}) is that of line {}; no direction leads from one to the other", p.x(),
                               p.y(), line_of_.back()));
    }
    polyline_.points_W.push_back(p);
    line_of_.push_back(line_);
    return {};
  }

  const std::string& name_;
  int line_ = 0;
  std::vector<std::size_t> columns_;  // the axis of each
  std::vector<int> line_of_;          // of each point
  Polyline polyline_;
};

}  // namespace

base::Result<Polyline> ReadPolyline(std::string_view text, const std::string& name) {
  return CsvReader(name).Read(text);
}

std::string PolylineCsv(const Polyline& line) {
  std::string text = line.has_z ? "x_m,y_m,z_m\n" : "x_m,y_m\n";
  for (const Eigen::Vector3d& p : line.points_W) {
    text += line.has_z ? fmt::format("{},{},{}\n", p.x(), p.y(), p.z()) : fmt::format("{},{}\n", p.x(), p.y());
  }
  return text;
}

}  // namespace rodeira::geometry
