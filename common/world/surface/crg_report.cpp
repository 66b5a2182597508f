// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/crg_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "common/world/surface/value_range.hpp"

namespace rodeira::surface {
namespace {

std::string_view FormatName(CrgFormat format) {
  switch (format) {
    case CrgFormat::kText10:
      return "LRFI, text of 10 characters a number";
    case CrgFormat::kText20:
      return "LDFI, text of 20 characters a number";
    case CrgFormat::kFloat:
      return "KRBI, big-endian floats";
    case CrgFormat::kDouble:
      return "KDBI, big-endian doubles";
    case CrgFormat::kNone:
      break;
  }
  return "none";
}

std::string_view BorderName(CrgBorder border) {
  switch (border) {
    case CrgBorder::kNone:
      return "no ground";
    case CrgBorder::kZero:
      return "zero";
    case CrgBorder::kKeep:
      return "the last height";
    case CrgBorder::kRepeat:
      return "repeated";
    case CrgBorder::kReflect:
      return "reflected";
  }
  return "";
}

std::string DescribeLine(const CrgShape& shape) {
  const std::vector<Eigen::Vector2d>& points = shape.line.points_W();
  double sharpest = 0.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Eigen::Vector2d before = points[i - 1] - points[i - 2], after = points[i] - points[i - 1];
    sharpest =
        std::max(sharpest, std::fabs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after))) /
                               shape.line.step_m());
  }
  const auto degrees = [](const Eigen::Vector2d& direction) {
    return std::atan2(direction.y(), direction.x()) * 180.0 / geometry::kPi;
  };
  std::string text = fmt::format(
      "line             from ({:.3f}, {:.3f}) heading {:.2f} degrees to ({:.3f}, {:.3f}) heading {:.2f} degrees, ",
      points.front().x(), points.front().y(), degrees(points[1] - points[0]), points.back().x(), points.back().y(),
      degrees(points.back() - points[points.size() - 2]));
  text += sharpest > 1e-9 ? fmt::format("radius at least {:.3g} m\n", 1.0 / sharpest) : "straight\n";
  ValueRange z, banking;
  for (const double value : shape.line_z_m) z.Add(value);
  for (const double value : shape.banking) banking.Add(value);
  return text + fmt::format("line's height    {:.4g} m to {:.4g} m, banking {:.4g} to {:.4g}\n", z.low, z.high,
                            banking.low, banking.high);
}

}  // namespace

std::string DescribeCrg(const CrgFile& file) {
  const CrgShape& shape = file.surface->shape();
  std::string text = fmt::format("numbers          {}\n", FormatName(file.header.format));
  text += fmt::format("rows             {}, u from {} m to {} m every {} m\n", file.surface->rows(),
                      shape.line.begin_u_m(), shape.line.end_u_m(), shape.line.step_m());
  text +=
      fmt::format("sections         {}, v from {} m to {} m\n", shape.v_m.size(), shape.v_m.front(), shape.v_m.back());
  text += DescribeLine(shape);
  ValueRange z;
  double sum = 0.0, squares = 0.0;
  std::size_t there = 0;
  for (const double height : shape.heights) {
    if (std::isnan(height)) continue;
    z.Add(height);
    sum += height;
    squares += height * height;
    ++there;
  }
  if (there > 0) {
    const double count = static_cast<double>(there), mean = sum / count;
    text += fmt::format("heights          {:.5g} m to {:.5g} m, mean {:.5g} m, standard deviation {:.4g} m\n", z.low,
                        z.high, mean, std::sqrt(std::max(squares / count - mean * mean, 0.0)));
  }
  text += fmt::format("missing heights  {} of {}\n", shape.heights.size() - there, shape.heights.size());
  text += fmt::format("beyond           along u {}, across v {}{}\n", BorderName(shape.options.border_u),
                      BorderName(shape.options.border_v), file.surface->closed() ? ", the track is closed" : "");
  for (const std::string& warning : file.warnings) text += fmt::format("warning          {}\n", warning);
  return text;
}

}  // namespace rodeira::surface
