// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/junction_boundary.hpp"

namespace rodeira::opendrive {
namespace {

void Lay(const JunctionReading& reading, const Tolerance& tolerance, network::NetworkSpec& spec,
         network::Junction& junction, Findings& findings) {
  const auto wrong = [&](std::string rule, std::string message) {
    findings.errors.push_back({std::move(rule),
                               fmt::format("junction {}: {}", junction.id, message),
                               reading.line,
                               "",
                               {},
                               {},
                               {RepairKind::kGridIgnored, "its roads keep their own heights"}});
  };
  if (junction.type != "default" && !junction.type.empty()) {
    wrong("junctions.boundary.only_for_common_junctions",
          fmt::format("its type is '{}'; a boundary or heights of its own has only a common junction", junction.type));
    return;
  }
  const std::size_t errors_before = findings.errors.size();
  JunctionBoundary boundary = BoundaryOf(reading, spec.roads, tolerance, findings);
  if (!reading.has_grid) return;
  auto line = geometry::PlanAxis::Make(reading.elements);
  auto grid = line ? network::JunctionGrid::Make(std::move(*line), reading.grid_start_m, reading.grid_spacing_m,
                                                 reading.grid_rows)
                   : std::nullopt;
  if (!grid) {
    wrong("junctions.elevation_grid.squares",
          "its heights make no squares: two rows or more were expected, a positive spacing, and heights on one side of "
          "both of two neighbouring rows");
    return;
  }
  for (const Eigen::Vector2d& p : boundary.corners_W) {
    if (grid->Covers(p)) continue;
    wrong("junctions.elevation_grid.valid_for_entire_boundry",
          fmt::format("its heights do not reach to ({:.2f}, {:.2f}) on its boundary", p.x(), p.y()));
    return;
  }
  if (findings.errors.size() != errors_before) return;
  const auto ground = std::make_shared<const network::JunctionGround>(std::move(*grid), std::move(boundary.corners_W),
                                                                      std::move(boundary.mouths));
  junction.ground = ground;
  for (network::Road& road : spec.roads) {
    if (road.spec().junction != junction.id) continue;
    network::RoadSpec on_ground = road.spec();
    on_ground.ground = ground;
    road = network::Road(std::move(on_ground), road.axis());
  }
}

}  // namespace

void LayJunctionGrounds(std::span<const JunctionReading> junctions, const Tolerance& tolerance,
                        network::NetworkSpec& spec, Findings& findings) {
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    if (!junctions[i].boundary.empty() || junctions[i].has_grid)
      Lay(junctions[i], tolerance, spec, spec.junctions[i], findings);
  }
}

}  // namespace rodeira::opendrive
