// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/polyline_command.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "common/core/base/constants.hpp"
#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/geometry/polyline_offset.hpp"
#include "launch/rodeira/commands/world_axis.hpp"

namespace rodeira::cli {
namespace {

using geometry::Polyline;

Eigen::Vector3d Vector(const std::vector<double>& numbers, const Eigen::Vector3d& default_value) {
  if (numbers.empty()) return default_value;
  return {numbers[0], numbers[1], numbers.size() > 2 ? numbers[2] : default_value.z()};
}

base::Result<Polyline> OffsetOf(const Polyline& line, const PolylineOptions& options) {
  auto offset = geometry::Offset(line, options.left_m,
                                 options.keep_length ? geometry::Mitre::kKeepLength : geometry::Mitre::kKeepWidth);
  for (const geometry::OffsetFault& fault : offset.faults) {
    const base::Error error =
        base::WrongInput("polyline.wrong_shape", geometry::FaultText(fault, options.left_m), options.files[0]);
    if (!options.despite_faults) return error;
    fmt::print(stderr, "rodeira: warning: {}\n", error.Text());
  }
  return std::move(offset.line);
}

base::Result<Polyline> Made(const std::vector<Polyline>& lines, const PolylineOptions& options) {
  const Polyline& line = lines[0];
  const Eigen::Vector3d first = line.points_W.front();
  const bool z_wanted =
      options.by_m.size() > 2 || (options.command == "scale" && options.about_m.size() > 2) || options.z_factor > 0.0;
  if (z_wanted && !line.has_z)
    return base::WrongInput("polyline.no_heights", "the line has no heights (z_m) to be moved", options.files[0]);
  if (options.command == "join")
    return geometry::Joined(lines, options.files, {options.within_m, options.bridge, options.turn});
  if (options.command == "translate") return geometry::Translated(line, Vector(options.by_m, Eigen::Vector3d::Zero()));
  if (options.command == "rotate") {
    return geometry::Rotated(line, options.angle_deg * base::kPi / 180.0, Vector(options.about_m, first).head<2>());
  }
  if (options.command == "scale") {
    return geometry::Scaled(line, options.factor, options.z_factor > 0.0 ? options.z_factor : options.factor,
                            Vector(options.about_m, first));
  }
  return OffsetOf(line, options);
}

}  // namespace

int Polylines(const PolylineOptions& options) {
  std::vector<Polyline> lines;
  for (const std::string& file : options.files) {
    if (const auto axis = AxisNameOf(file)) {
      auto line = AxisOf(*axis, options.step_m);
      if (!line) return base::PrintError("rodeira", line.error());
      lines.push_back(std::move(line).value());
      continue;
    }
    const auto text = base::ReadText(file);
    if (!text) return base::PrintError("rodeira", text.error());
    auto line = geometry::ReadPolyline(text.value(), file);
    if (!line) return base::PrintError("rodeira", line.error());
    lines.push_back(std::move(line).value());
  }
  const auto made = Made(lines, options);
  if (!made) return base::PrintError("rodeira", made.error());
  if (const auto written = base::WriteWhole(options.out, geometry::PolylineCsv(made.value())); !written) {
    return base::PrintError("rodeira", written.error());
  }
  fmt::print("wrote {}: {} points, {:.3f} m in plan\n", options.out, made.value().points_W.size(),
             geometry::StationsOf(made.value()).back());
  return 0;
}

}  // namespace rodeira::cli
