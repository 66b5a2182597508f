// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/editor/document.hpp"

namespace rodeira::nodes {

// Red, green, blue, opacity.
using Colour = std::array<std::uint8_t, 4>;

// x and y in metres, from Shapes::origin_W.
struct Vertex {
  float x, y;
  Colour colour;
};
using Vertices = std::vector<Vertex>;

// OpenGL draws them: mode is GL_TRIANGLES, GL_LINES or GL_POINTS.
void DrawVertices(const Vertices& vertices, unsigned mode);

// What a map is drawn of, added to lists of vertices.
struct Shapes {
  Eigen::Vector2d origin_W = Eigen::Vector2d::Zero();  // vertices are counted from here
  double metres_per_px = 0.1;                          // how fine curves must be

  // Straight pieces that a curve is drawn in; at least 2.
  int PiecesOf(const traffic_map::Cubic& cubic) const;
  Vertex At(const Eigen::Vector2d& p_W, const Colour& colour) const;
  // Points in W; two vertices a line.
  void AddLine(Vertices& lines, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Colour& colour) const;
  // The area between two borders.
  void AddGround(Vertices& triangles, const editor::Borders& borders, const Colour& colour) const;
  void AddCurve(Vertices& lines, const traffic_map::Cubic& cubic, const Colour& colour, bool dashed = false) const;
  // An arrow from the end of one lane's middle to the beginning of the next one's.
  void AddLink(Vertices& lines, const traffic_map::Cubic& from, const traffic_map::Cubic& to,
               const Colour& colour) const;
  // `ahead`: a unit vector along its length.
  void AddRectangle(Vertices& triangles, const Eigen::Vector2d& middle, const Eigen::Vector2d& ahead,
                    double half_length_m, double half_width_m, const Colour& colour) const;
  // Convex; laid at a place with its x axis ahead.
  void AddPolygon(Vertices& triangles, std::span<const Eigen::Vector2d> corners, const Eigen::Vector2d& place,
                  const Eigen::Vector2d& ahead, const Colour& colour) const;
};

}  // namespace rodeira::nodes
