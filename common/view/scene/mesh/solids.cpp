// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/mesh/solids.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::scene {

using Eigen::Vector3d;

std::vector<std::array<std::size_t, 3>> Ears(std::span<const Vector3d> corners) {
  std::vector<std::size_t> left(corners.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
    return geometry::Cross(corners[b].head<2>() - corners[a].head<2>(), corners[c].head<2>() - corners[b].head<2>());
  };
  std::vector<std::array<std::size_t, 3>> ears;
  while (left.size() >= 3) {
    bool cut = false;
    for (std::size_t i = 0; i < left.size() && !cut; ++i) {
      const std::size_t a = left[(i + left.size() - 1) % left.size()], b = left[i], c = left[(i + 1) % left.size()];
      if (!(turn(a, b, c) > 0.0)) continue;
      const bool empty = std::none_of(left.begin(), left.end(), [&](std::size_t p) {
        return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
      });
      if (!empty) continue;
      ears.push_back({a, b, c});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      cut = true;
    }
    if (!cut) return left.size() <= 3 ? ears : std::vector<std::array<std::size_t, 3>>{};
  }
  return ears;
}

Stand Stand::At(const Vector3d& foot_W, double heading_rad) {
  return {foot_W, {std::cos(heading_rad), std::sin(heading_rad)}};
}

void AddPlaced(const Mesh& model, const Stand& stand, Mesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    mesh.Add(stand.ToWorld(model.PositionW(i)), stand.Turned(model.normals[i].cast<double>()), model.colours[i]);
  }
  for (const std::uint32_t index : model.triangles) mesh.triangles.push_back(first + index);
}

void AddFlat(Mesh& mesh, std::span<const Vector3d> corners, Colour colour) {
  const Vector3d across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  const Vector3d normal = across.norm() > 0.0 ? Vector3d(across.normalized()) : Vector3d::UnitZ();
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector3d& corner : corners) mesh.Add(corner, normal, colour);
  for (std::uint32_t i = 1; i + 1 < corners.size(); ++i) mesh.AddTriangle(first, first + i, first + i + 1);
}

Mesh Pole(double low_m, double high_m, double foot_m, double top_m, int sides, Colour colour) {
  Mesh mesh;
  mesh.material = Material::kMatt;
  std::vector<Vector3d> lid;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * base::kPi * k / sides;
    const Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    mesh.Add(foot_m * out + low_m * Vector3d::UnitZ(), out, colour);
    mesh.Add(top_m * out + high_m * Vector3d::UnitZ(), out, colour);
    lid.push_back(top_m * out + high_m * Vector3d::UnitZ());
  }
  for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(sides); ++k) {
    const std::uint32_t next = (k + 1) % static_cast<std::uint32_t>(sides);
    mesh.AddTriangle(2 * k, 2 * next, 2 * next + 1);
    mesh.AddTriangle(2 * k, 2 * next + 1, 2 * k + 1);
  }
  AddFlat(mesh, lid, colour);
  return mesh;
}

void AddBar(Mesh& mesh, const BarEnd& from, const BarEnd& to, bool round, int sides, const Eigen::Vector2d& across_W,
            Colour colour) {
  const Vector3d way = to.p_W - from.p_W;
  if (!(way.norm() > 0.0)) return;
  const Vector3d along = way.normalized();
  Vector3d wide(across_W.x(), across_W.y(), 0.0);
  wide -= wide.dot(along) * along;
  if (wide.norm() < 1e-3) {
    wide = Vector3d(across_W.y(), -across_W.x(), 0.0);
    wide -= wide.dot(along) * along;
  }
  wide.normalize();
  const Vector3d high = along.cross(wide);
  std::vector<Vector3d> begin, end;
  const int count = round ? sides : 4;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * base::kPi * (k + (round ? 0.0 : 0.5)) / count;
    const double scale = round ? 1.0 : std::sqrt(2.0);  // to the corners of the rectangle
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    begin.push_back(from.p_W + from.wide_m * c * wide + from.high_m * s * high);
    end.push_back(to.p_W + to.wide_m * c * wide + to.high_m * s * high);
  }
  for (std::size_t k = 0; k < begin.size(); ++k) {
    const std::size_t next = (k + 1) % begin.size();
    AddFlat(mesh, std::array<Vector3d, 4>{begin[k], begin[next], end[next], end[k]}, colour);
  }
  AddFlat(mesh, end, colour);
  std::reverse(begin.begin(), begin.end());
  AddFlat(mesh, begin, colour);
}

Mesh Block(const Vector3d& low, const Vector3d& high, Colour colour) {
  Mesh mesh;
  mesh.material = Material::kMatt;
  const std::array<Vector3d, 4> base = {Vector3d{low.x(), low.y(), low.z()},
                                        {high.x(), low.y(), low.z()},
                                        {high.x(), high.y(), low.z()},
                                        {low.x(), high.y(), low.z()}};
  const Vector3d up(0.0, 0.0, high.z() - low.z());
  std::array<Vector3d, 4> lid;
  for (std::size_t k = 0; k < 4; ++k) {
    const Vector3d &a = base[k], &b = base[(k + 1) % 4];
    AddFlat(mesh, std::array<Vector3d, 4>{a, b, b + up, a + up}, colour);
    lid[k] = a + up;
  }
  AddFlat(mesh, lid, colour);
  return mesh;
}

Mesh Gable(const Vector3d& low, const Vector3d& high, Colour slopes, Colour ends) {
  Mesh mesh;
  mesh.material = Material::kMatt;
  const double middle = 0.5 * (low.y() + high.y());
  const Vector3d a(low.x(), low.y(), low.z()), b(high.x(), low.y(), low.z()), c(high.x(), high.y(), low.z()),
      d(low.x(), high.y(), low.z());
  const Vector3d from(low.x(), middle, high.z()), to(high.x(), middle, high.z());
  AddFlat(mesh, std::array<Vector3d, 4>{a, b, to, from}, slopes);
  AddFlat(mesh, std::array<Vector3d, 4>{c, d, from, to}, slopes);
  AddFlat(mesh, std::array<Vector3d, 3>{b, c, to}, ends);
  AddFlat(mesh, std::array<Vector3d, 3>{d, a, from}, ends);
  return mesh;
}

void AddOutline(Mesh& mesh, std::span<const Vector3d> feet_W, std::span<const double> heights_m, bool closed,
                Colour walls, Colour roof) {
  const std::size_t count = feet_W.size();
  if (count < 2) return;
  double area = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    area += geometry::Cross(Eigen::Vector2d((feet_W[i] - feet_W[0]).head<2>()),
                            Eigen::Vector2d((feet_W[(i + 1) % count] - feet_W[0]).head<2>()));
  std::vector<Vector3d> feet(feet_W.begin(), feet_W.end()), tops;
  for (std::size_t i = 0; i < count; ++i) tops.push_back(feet[i] + heights_m[i] * Vector3d::UnitZ());
  if (closed && area < 0.0) std::reverse(feet.begin(), feet.end()), std::reverse(tops.begin(), tops.end());
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
    const std::size_t next = (i + 1) % count;
    if (tops[i].z() - feet[i].z() <= 0.0 && tops[next].z() - feet[next].z() <= 0.0) continue;
    AddFlat(mesh, std::array<Vector3d, 4>{feet[i], feet[next], tops[next], tops[i]}, walls);
    if (!closed) AddFlat(mesh, std::array<Vector3d, 4>{feet[next], feet[i], tops[i], tops[next]}, walls);
  }
  if (!closed) return;
  for (const auto& ear : Ears(tops))
    AddFlat(mesh, std::array<Vector3d, 3>{tops[ear[0]], tops[ear[1]], tops[ear[2]]}, roof);
}

}  // namespace rodeira::scene
