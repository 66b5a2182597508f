// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>

#include "common/core/base/random.hpp"
#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/tyre.hpp"

namespace rodeira::dynamics {

// D_t of the Magic Formula's trail (Pacejka, 3rd ed., (4.E42)) with coefficients of the load alone, m.
inline double TrailAtNoSlip(const TyreSettings& tyre, double load_N) {
  const AligningSettings& a = tyre.aligning.value();
  const double dfz = load_N / tyre.formula.fnomin - 1.0;
  return load_N * (a.qdz1 + a.qdz2 * dfz) * a.unloaded_radius / tyre.formula.fnomin;
}

// Torque of the patch's twist of a tyre that rolls round a bend of this curvature: a dw/dt + |vx| w = a turn, steadily.
inline double TwistOnABend(const TyreSettings& tyre, double load_N, double curvature_pm) {
  const TurnedPatch patch = TurnedPatchOf(tyre, load_N, 1.0);
  return patch.stiffness_Nmprad * patch.half_length_m * curvature_pm;
}

// Seeded hills: three sines each way; amplitude and steepness by the seed. Optionally cut into terraces (vertical
// steps), with a world's edge, and with ice here and there. Counts the batches.
class HillGround final : public ground::Ground {
 public:
  struct Kind {
    double amplitude_m = 2.0;
    double wave_m = 60.0;
    double terrace_m = 0.0;  // 0: none
    double edge_m = std::numeric_limits<double>::infinity();
    bool ice = false;
  };
  HillGround(std::uint64_t seed, const Kind& kind) : seed_(seed), kind_(kind) {}

  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override {
    ++batches;
    for (std::size_t i = 0; i < queries.size(); ++i) points[i] = Point(queries[i].x_m, queries[i].y_m);
  }

  int batches = 0;

 private:
  ground::GroundPoint Point(double x, double y) const {
    if (std::hypot(x, y) > kind_.edge_m) return {};
    ground::GroundPoint point;
    double slope_x = 0.0, slope_y = 0.0;
    for (std::uint64_t k = 0; k < 3; ++k) {
      const double wave = kind_.wave_m * base::RandomUniform({seed_, k, 0}, 0.5, 1.5);
      const double direction = base::RandomUniform({seed_, k, 1}, 0.0, 6.28);
      const double phase = base::RandomUniform({seed_, k, 2}, 0.0, 6.28);
      const double number = 6.283185307179586 / wave;
      const double along = number * (x * std::cos(direction) + y * std::sin(direction)) + phase;
      point.z_m += kind_.amplitude_m / 3.0 * std::sin(along);
      slope_x += kind_.amplitude_m / 3.0 * number * std::cos(direction) * std::cos(along);
      slope_y += kind_.amplitude_m / 3.0 * number * std::sin(direction) * std::cos(along);
    }
    point.normal_W = Eigen::Vector3d(-slope_x, -slope_y, 1.0).normalized();
    if (kind_.terrace_m > 0.0) {
      point.z_m = kind_.terrace_m * std::floor(point.z_m / kind_.terrace_m);
      point.normal_W = Eigen::Vector3d::UnitZ();
    }
    point.friction = kind_.ice && std::sin(0.3 * x) > 0.0 ? 0.05 : 1.0;
    point.surface = ground::Surface::kAsphalt;
    point.inside = true;
    return point;
  }

  std::uint64_t seed_;
  Kind kind_;
};

}  // namespace rodeira::dynamics
