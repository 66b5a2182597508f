// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/core/ground/ground.hpp"

namespace rodeira::dynamics {

// Ground with a height that depends on x only, by straight pieces; a piece may be vertical.
class ProfileGround final : public ground::Ground {
 public:
  struct Corner {
    double x_m = 0.0, z_m = 0.0;
  };
  // Corners by x, not falling; level before the first and after the last one.
  explicit ProfileGround(std::vector<Corner> corners) : corners_(std::move(corners)) {}

  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override {
    for (std::size_t i = 0; i < queries.size(); ++i) points[i] = Point(queries[i].x_m);
  }
  double lowest_m() const { return std::ranges::min_element(corners_, {}, &Corner::z_m)->z_m; }

  // Ramps, edges that fall steeply, kerbs up and down, steps and plains, one after another from x = 10 m on.
  static std::vector<Corner> Random(std::uint64_t seed, int pieces) {
    std::uint64_t drawn = 0;
    const auto draw = [&](double low, double high) { return base::RandomUniform({seed, ++drawn, 4711}, low, high); };
    std::vector<Corner> corners{{10.0, 0.0}};
    const auto add = [&](double length_m, double rise_m) {
      corners.push_back({corners.back().x_m + length_m, corners.back().z_m + rise_m});
    };
    for (int piece = 0; piece < pieces; ++piece) {
      const double kind = draw(0.0, 1.0), length_m = draw(0.5, 6.0);
      if (kind < 0.35)
        add(length_m, draw(-0.35, 0.25) * length_m);  // a ramp
      else if (kind < 0.6)
        add(draw(0.01, 0.15), -draw(0.02, 1.0));  // an edge
      else if (kind < 0.8)
        add(0.0, draw(0.01, 0.12));  // a kerb
      else
        add(0.0, -draw(0.01, 0.6));  // a step down
      add(draw(0.2, 6.0), 0.0);
    }
    return corners;
  }

 private:
  ground::GroundPoint Point(double x_m) const {
    ground::GroundPoint point;
    point.friction = 1.0;
    point.surface = ground::Surface::kAsphalt;
    point.inside = true;
    point.z_m = corners_.front().z_m;
    for (std::size_t i = 0; i < corners_.size() && corners_[i].x_m <= x_m; ++i) {
      point.z_m = corners_[i].z_m;
      point.normal_W = Eigen::Vector3d::UnitZ();
      if (i + 1 == corners_.size() || corners_[i + 1].x_m <= x_m) continue;
      const double slope = (corners_[i + 1].z_m - corners_[i].z_m) / (corners_[i + 1].x_m - corners_[i].x_m);
      point.z_m += slope * (x_m - corners_[i].x_m);
      point.normal_W = Eigen::Vector3d(-slope, 0.0, 1.0).normalized();
    }
    return point;
  }

  std::vector<Corner> corners_;
};

}  // namespace rodeira::dynamics
