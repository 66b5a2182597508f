// SPDX-License-Identifier: Apache-2.0
#include "nodes/editor/shapes.hpp"

#include <SDL_opengl.h>

#include <algorithm>

namespace rodeira::nodes {
namespace {

constexpr int kMaxPieces = 24;
constexpr double kPiece_px = 12.0;

}  // namespace

int Shapes::PiecesOf(const traffic_map::Cubic& cubic) const {
  return std::clamp(static_cast<int>(cubic.PolygonLength() / metres_per_px / kPiece_px), 2, kMaxPieces);
}

Vertex Shapes::At(const Eigen::Vector2d& p_W, const Colour& colour) const {
  return {static_cast<float>(p_W.x() - origin_W.x()), static_cast<float>(p_W.y() - origin_W.y()), colour};
}

void Shapes::AddLine(Vertices& lines, const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Colour& colour) const {
  lines.push_back(At(a, colour));
  lines.push_back(At(b, colour));
}

void Shapes::AddGround(Vertices& triangles, const editor::Borders& borders, const Colour& colour) const {
  const int pieces = std::max(PiecesOf(borders.left), PiecesOf(borders.right));
  Eigen::Vector2d left = borders.left.At(0.0), right = borders.right.At(0.0);
  for (int i = 1; i <= pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const Eigen::Vector2d next_left = borders.left.At(t), next_right = borders.right.At(t);
    for (const auto& p : {left, right, next_right, left, next_right, next_left}) triangles.push_back(At(p, colour));
    left = next_left, right = next_right;
  }
}

void Shapes::AddCurve(Vertices& lines, const traffic_map::Cubic& cubic, const Colour& colour, bool dashed) const {
  const int pieces = dashed ? kMaxPieces : PiecesOf(cubic);
  Eigen::Vector2d before = cubic.At(0.0);
  for (int i = 1; i <= pieces; ++i) {
    const Eigen::Vector2d next = cubic.At(static_cast<double>(i) / pieces);
    if (!dashed || i % 2 == 1) AddLine(lines, before, next, colour);
    before = next;
  }
}

void Shapes::AddLink(Vertices& lines, const traffic_map::Cubic& from, const traffic_map::Cubic& to,
                     const Colour& colour) const {
  const Eigen::Vector2d a = from.At(0.85), b = from.At(1.0), c = to.At(0.0), d = to.At(0.15);
  AddLine(lines, a, b, colour);
  AddLine(lines, b, c, colour);
  AddLine(lines, c, d, colour);
  const Eigen::Vector2d ahead = (d - c).norm() > 0.0 ? Eigen::Vector2d((d - c).normalized()) : Eigen::Vector2d::UnitX();
  const Eigen::Vector2d across(-ahead.y(), ahead.x());
  AddLine(lines, d, d - 1.2 * ahead + 0.6 * across, colour);
  AddLine(lines, d, d - 1.2 * ahead - 0.6 * across, colour);
}

void Shapes::AddRectangle(Vertices& triangles, const Eigen::Vector2d& middle, const Eigen::Vector2d& ahead,
                          double half_length_m, double half_width_m, const Colour& colour) const {
  const Eigen::Vector2d along = half_length_m * ahead, across = half_width_m * Eigen::Vector2d(-ahead.y(), ahead.x());
  const Eigen::Vector2d a = middle + along + across, b = middle + along - across, c = middle - along - across,
                        d = middle - along + across;
  for (const auto& p : {a, b, c, a, c, d}) triangles.push_back(At(p, colour));
}

void Shapes::AddPolygon(Vertices& triangles, std::span<const Eigen::Vector2d> corners, const Eigen::Vector2d& place,
                        const Eigen::Vector2d& ahead, const Colour& colour) const {
  const auto at = [&](const Eigen::Vector2d& p) {
    return At(place + p.x() * ahead + p.y() * Eigen::Vector2d(-ahead.y(), ahead.x()), colour);
  };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    for (const std::size_t corner : {std::size_t{0}, i, i + 1}) triangles.push_back(at(corners[corner]));
  }
}

void DrawVertices(const Vertices& vertices, unsigned mode) {
  if (vertices.empty()) return;
  glEnableClientState(GL_VERTEX_ARRAY);
  glEnableClientState(GL_COLOR_ARRAY);
  glVertexPointer(2, GL_FLOAT, sizeof(Vertex), &vertices[0].x);
  glColorPointer(4, GL_UNSIGNED_BYTE, sizeof(Vertex), vertices[0].colour.data());
  glDrawArrays(mode, 0, static_cast<GLsizei>(vertices.size()));
  glDisableClientState(GL_COLOR_ARRAY);
  glDisableClientState(GL_VERTEX_ARRAY);
}

}  // namespace rodeira::nodes
