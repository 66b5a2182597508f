// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/editor/preview.hpp"
#include "common/editor/selection.hpp"
#include "common/editor/viewport.hpp"
#include "nodes/editor/shapes.hpp"

namespace rodeira::nodes {

// Draws a map with OpenGL: ground of lanes, borders, connections, handles; what is chosen; traffic. What does not
// change from picture to picture is worked out once.
class MapPainter {
 public:
  // Sets the projection for the canvas; `left_px`, `below_px` are its corner in the window.
  void Begin(const editor::Viewport& view, int left_px, int below_px);
  // `state`: of the document; shapes are made anew where it changes. handles: whether they are drawn.
  void DrawMap(const editor::Document& document, std::uint64_t state, bool handles);
  // Over DrawMap.
  void DrawChosen(const editor::Document& document, const editor::Selection& selection);
  // Connections that could be made, as proposals() lists them.
  void DrawProposals(const editor::Document& document, std::uint64_t state);
  // Over DrawMap.
  void DrawHeat(const std::vector<editor::HeatPatch>& patches);
  // All vehicles on the road, after the model's last step.
  void DrawVehicles(const traffic::TrafficModel& model);

  const std::vector<std::pair<std::int32_t, std::int32_t>>& proposals() const { return proposals_; }

 private:
  void AddBars(const editor::Document& document, const traffic_map::NumberIndex& lanes);
  void AddLinesAcross(const editor::Document& document, const traffic_map::NumberIndex& lanes);
  void Build(const editor::Document& document);

  Shapes shapes_;
  std::optional<std::pair<std::uint64_t, int>> built_;  // document's state and fineness
  Vertices grounds_, paint_, curves_, links_, bars_, handle_lines_, handles_;
  std::optional<std::uint64_t> proposed_state_;
  std::vector<std::pair<std::int32_t, std::int32_t>> proposals_;
};

}  // namespace rodeira::nodes
