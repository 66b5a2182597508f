#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/editor/preview.hpp"
#include "common/editor/selection.hpp"
#include "common/editor/viewport.hpp"

namespace rodeira::desk {

// Red, green, blue, opacity.
using Colour = std::array<std::uint8_t, 4>;

// Draws a map with OpenGL: ground of lanes, borders, connections, handles; what is chosen; traffic. What does not change from picture to picture is
// worked out once.
class MapPainter {
 public:
  // Sets the projection for the canvas; `left_px`, `below_px` are its corner in the window.
  void Begin(const editor::Viewport& view, int left_px, int below_px);
  void DrawMap(const editor::Document& document, std::uint64_t state, bool handles);
  void DrawChosen(const editor::Document& document, const editor::Selection& selection);
  void DrawProposals(const editor::Document& document, std::uint64_t state);
  void DrawHeat(const std::vector<editor::HeatPatch>& patches);
  void DrawVehicles(const traffic::TrafficModel& model);

  const std::vector<std::pair<std::int32_t, std::int32_t>>& proposals() const { return proposals_; }

 private:
  struct Vertex {
    float x, y;
    Colour colour;
  };
  using Vertices = std::vector<Vertex>;

  int PiecesOf(const map::Cubic& cubic) const;
  Vertex At(const Eigen::Vector2d& p_W, const Colour& colour) const;
  void AddLine(Vertices& lines, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Colour& colour) const;
  void AddGround(Vertices& triangles, const editor::Borders& borders, const Colour& colour) const;
  void AddCurve(Vertices& lines, const map::Cubic& cubic, const Colour& colour, bool dashed = false) const;
  void AddLink(Vertices& lines, const map::Cubic& from, const map::Cubic& to, const Colour& colour) const;
  void AddRectangle(Vertices& triangles, const Eigen::Vector2d& middle, const Eigen::Vector2d& ahead, double half_length_m, double half_width_m, const Colour& colour) const;
  void AddBars(const editor::Document& document, const map::NumberIndex& lanes);
  void Build(const editor::Document& document);
  static void Draw(const Vertices& vertices, unsigned mode);

  editor::Viewport view_;
  Eigen::Vector2d origin_W_ = Eigen::Vector2d::Zero();  // vertices are counted from here
  std::optional<std::pair<std::uint64_t, int>> built_;  // document's state and fineness
  Vertices grounds_, curves_, links_, bars_, handle_lines_, handles_;
  std::optional<std::uint64_t> proposed_state_;
  std::vector<std::pair<std::int32_t, std::int32_t>> proposals_;
};

}  // namespace rodeira::desk
