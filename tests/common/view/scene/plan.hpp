// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::scene {

// Many meshes seen from above: which triangles lie over a point, and how high.
class Plan {
 public:
  void Add(const Mesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k) triangle.p[k] = mesh.PositionW(mesh.triangles[3 * t + k]);
      const Eigen::Vector3d across = (triangle.p[1] - triangle.p[0]).cross(triangle.p[2] - triangle.p[0]);
      area_m2_ += 0.5 * across.z();
      if (across.z() < 0.0) ++downward_;
      Eigen::Vector3d low = triangle.p[0].cwiseMin(triangle.p[1]).cwiseMin(triangle.p[2]),
                      high = triangle.p[0].cwiseMax(triangle.p[1]).cwiseMax(triangle.p[2]);
      for (long c = Bin(low.x()); c <= Bin(high.x()); ++c) {
        for (long r = Bin(low.y()); r <= Bin(high.y()); ++r) bins_[Key(c, r)].push_back(triangles_.size());
      }
      triangles_.push_back(triangle);
    }
  }

  // Heights of the triangles over (x, y), points within 1 mm of an edge counted as on it.
  std::vector<double> HeightsOver(double x, double y) const {
    std::vector<double> heights;
    const auto found = bins_.find(Key(Bin(x), Bin(y)));
    if (found == bins_.end()) return heights;
    for (const std::size_t i : found->second) {
      const auto& p = triangles_[i].p;
      const double whole = Side(p[0], p[1], p[2].x(), p[2].y());
      if (whole < 1e-9) continue;
      const double a = Side(p[1], p[2], x, y) / whole, b = Side(p[2], p[0], x, y) / whole, c = 1.0 - a - b;
      const double slack = 1e-9;
      if (a >= -slack && b >= -slack && c >= -slack) heights.push_back(a * p[0].z() + b * p[1].z() + c * p[2].z());
    }
    return heights;
  }

  double area_m2() const { return area_m2_; }
  std::size_t downward() const { return downward_; }

 private:
  struct Triangle {
    Eigen::Vector3d p[3];
  };
  static constexpr double kBin_m = 8.0;
  static long Bin(double x) { return static_cast<long>(std::floor(x / kBin_m)); }
  static std::uint64_t Key(long c, long r) {
    return (static_cast<std::uint64_t>(c) << 32) ^ (static_cast<std::uint64_t>(r) & 0xffffffffU);
  }
  static double Side(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
  }

  std::vector<Triangle> triangles_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> bins_;
  double area_m2_ = 0.0;
  std::size_t downward_ = 0;
};

}  // namespace rodeira::scene
