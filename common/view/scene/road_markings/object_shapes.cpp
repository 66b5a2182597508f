// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_markings/object_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/view/scene/ground_materials/colours.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;

constexpr double kLongestMitre = 4.0;  // of the width

Vector2d LeftOf(const Vector2d& from, const Vector2d& to) {
  const Vector2d way = to - from;
  return way.squaredNorm() > 0.0 ? Vector2d(Vector2d(-way.y(), way.x()).normalized()) : Vector2d(Vector2d::Zero());
}

// From a corner to the line at distance 1 on the left of both of its sides.
Vector2d Mitre(const Vector2d& left_before, const Vector2d& left_after) {
  const Vector2d sum = left_before + left_after;
  const double square = sum.squaredNorm();
  if (square == 0.0) return left_after;
  const Vector2d mitre = 2.0 / square * sum;
  return mitre.norm() <= kLongestMitre ? mitre : Vector2d(kLongestMitre * mitre.normalized());
}

}  // namespace

std::optional<Colour> FillColour(std::string_view fill) {
  using ground::Surface;
  if (fill == "grass") return SurfaceColour(Surface::kGrass);
  if (fill == "concrete") return SurfaceColour(Surface::kConcrete);
  if (fill == "asphalt") return SurfaceColour(Surface::kAsphalt);
  if (fill == "gravel") return SurfaceColour(Surface::kGravel);
  if (fill == "soil") return SurfaceColour(Surface::kSoil);
  if (fill == "cobble") return Colour::Of(0x7d766c);
  if (fill == "pavement") return Colour::Of(0xa7a49c);
  if (fill == "paint") return SurfaceColour(Surface::kRoadMark);
  return std::nullopt;
}

Colour BorderColour(std::string_view type) {
  return type == "curb" ? Colour::Of(0xbab7b0) : SurfaceColour(ground::Surface::kConcrete);
}

std::vector<FramePiece> FrameOf(std::span<const Vector2d> outline, bool closed, std::span<const std::size_t> along,
                                double width_m) {
  const std::size_t count = outline.size();
  if (count < 2) return {};
  double area = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    area += geometry::Cross(Vector2d(outline[i] - outline[0]), Vector2d(outline[(i + 1) % count] - outline[0]));
  std::vector<std::size_t> path(along.begin(), along.end());
  const bool ring = path.empty() && closed && count > 2;
  if (path.empty()) {
    for (std::size_t i = 0; i < count; ++i) path.push_back(i);
  }
  if (path.size() < 2) return {};
  // What lies within is on the left where the path runs counter-clockwise: as the outline does, or against it.
  const bool as_outline = 2 * ((path[1] + count - path[0]) % count) <= count;
  const double inward = closed && (area < 0.0) == as_outline ? -1.0 : 1.0;
  const std::size_t sides = ring ? path.size() : path.size() - 1;
  const auto corner = [&](std::size_t k) -> const Vector2d& { return outline[path[k % path.size()]]; };
  const auto left = [&](std::size_t side) { return LeftOf(corner(side), corner(side + 1)); };
  const auto mitre = [&](std::size_t k) {  // at the path's corner k
    if (!ring && k == 0) return left(0);
    if (!ring && k == sides) return left(sides - 1);
    return Mitre(left((k + path.size() - 1) % path.size()), left(k % path.size()));
  };
  const double outer_m = closed ? 0.0 : -0.5 * width_m, inner_m = closed ? inward * width_m : 0.5 * width_m;
  std::vector<FramePiece> pieces;
  for (std::size_t k = 0; k < sides; ++k) {
    const std::size_t from = path[k], to = path[(k + 1) % path.size()];
    if ((outline[to] - outline[from]).squaredNorm() == 0.0) continue;
    const Vector2d at_from = mitre(k), at_to = mitre(k + 1);
    FramePiece piece{{outline[from] + outer_m * at_from, outline[to] + outer_m * at_to, outline[to] + inner_m * at_to,
                      outline[from] + inner_m * at_from},
                     from,
                     to};
    if (inward < 0.0) {
      std::swap(piece.corners[0], piece.corners[1]), std::swap(piece.corners[2], piece.corners[3]);
      std::swap(piece.from, piece.to);
    }
    pieces.push_back(piece);
  }
  return pieces;
}

std::vector<std::size_t> CornersOf(const network::Object& object, const network::ObjectBorder& border) {
  const auto& corners = object.outlines[border.outline].corners;
  std::vector<std::size_t> found;
  for (const std::string& id : border.corners) {
    const auto at =
        std::find_if(corners.begin(), corners.end(), [&](const network::Corner& corner) { return corner.id == id; });
    if (at != corners.end()) found.push_back(static_cast<std::size_t>(at - corners.begin()));
  }
  return found;
}

}  // namespace rodeira::scene
