// SPDX-License-Identifier: Apache-2.0
// Traffic on the map, and the heat map that it leaves.
#include <SDL_opengl.h>

#include "common/view/scene/heat_map/heat_map.hpp"
#include "nodes/editor/map_painter.hpp"

namespace rodeira::nodes {

void MapPainter::DrawHeat(const std::vector<editor::HeatPatch>& patches) {
  constexpr auto kOpacity = static_cast<std::uint8_t>(255.0 * scene::kHeatShare);
  Vertices triangles;
  for (const editor::HeatPatch& patch : patches) {
    const scene::Colour colour = scene::HeatColour(patch.share);
    shapes_.AddRectangle(triangles, patch.p_W, patch.ahead_W, 0.5 * patch.length_m, 0.5 * patch.width_m,
                         {colour.red, colour.green, colour.blue, kOpacity});
  }
  DrawVertices(triangles, GL_TRIANGLES);
}

void MapPainter::DrawVehicles(const traffic::TrafficModel& model) {
  Vertices triangles;
  for (const traffic::AgentPose& pose : model.poses()) {
    const traffic::AgentTraits& traits = model.traits(pose.id);
    const Eigen::Vector2d ahead = (pose.q_WB * Eigen::Vector3d::UnitX()).head<2>().normalized(),
                          middle = pose.p_WB_W.head<2>();
    const Colour paint = {static_cast<std::uint8_t>(traits.colour_rgb >> 16),
                          static_cast<std::uint8_t>(traits.colour_rgb >> 8),
                          static_cast<std::uint8_t>(traits.colour_rgb), 255};
    shapes_.AddRectangle(triangles, middle, ahead, 0.5 * traits.length_m + 0.15, 0.5 * traits.width_m + 0.15,
                         {10, 10, 10, 255});
    shapes_.AddRectangle(triangles, middle, ahead, 0.5 * traits.length_m, 0.5 * traits.width_m, paint);
    shapes_.AddRectangle(triangles, middle + 0.15 * traits.length_m * ahead, ahead, 0.12 * traits.length_m,
                         0.4 * traits.width_m, {30, 40, 50, 255});
  }
  DrawVertices(triangles, GL_TRIANGLES);
}

}  // namespace rodeira::nodes
