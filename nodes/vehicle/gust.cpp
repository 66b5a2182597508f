// SPDX-License-Identifier: Apache-2.0
#include "nodes/vehicle/gust.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"

namespace rodeira::nodes {
namespace {

constexpr double kAir_kgpm3 = 1.2;
constexpr double kSideShare = 0.8;     // of length × height
constexpr double kPressureLead = 0.1;  // of the length, before the middle of the wheelbase

}  // namespace

dynamics::Wrench SideWind(const dynamics::VehicleState& car, const dynamics::VehicleDimensions& dimensions,
                          const Eigen::Vector2d& wind_W_mps) {
  const Eigen::Vector3d left = car.q_WB * Eigen::Vector3d::UnitY(), forward = car.q_WB * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d wind(wind_W_mps.x(), wind_W_mps.y(), 0.0);
  const auto pressure = [&](const Eigen::Vector3d& air) {
    return std::hypot(air.dot(forward), air.dot(left)) * air.dot(left);
  };
  const double length = dimensions.front_m + dimensions.rear_m;
  // The models' own drag is that of still air.
  const double force_N = 0.5 * kAir_kgpm3 * kSideShare * length * dimensions.height_m *
                         (pressure(wind - car.v_WB_W) - pressure(-car.v_WB_W));
  const Eigen::Vector3d acts_W =
      kPressureLead * length * forward + 0.5 * dimensions.height_m * (car.q_WB * Eigen::Vector3d::UnitZ());
  dynamics::Wrench wrench;
  wrench.force_W = force_N * left;
  wrench.moment_WB_W = acts_W.cross(wrench.force_W);
  return wrench;
}

void Gust::Begin(const scenario::GustChoice& gust, double peak_mps) {
  peak_mps_ = peak_mps;
  to_rad_ = (gust.from_deg + 180.0) * base::kPi / 180.0;
  for_s_ = gust.for_s;
  elapsed_s_ = 0.0;
}

Eigen::Vector2d Gust::Step(double dt_s) {
  if (!blows()) return Eigen::Vector2d::Zero();
  const double middle_s = std::min(elapsed_s_ + 0.5 * dt_s, for_s_);
  elapsed_s_ += dt_s;
  const double speed_mps = peak_mps_ * 0.5 * (1.0 - std::cos(2.0 * base::kPi * middle_s / for_s_));
  return speed_mps * Eigen::Vector2d(std::cos(to_rad_), std::sin(to_rad_));
}

void Gust::Save(base::StateWriter& writer) const {
  writer.Put("peak_mps", peak_mps_);
  writer.Put("to_rad", to_rad_);
  writer.Put("for_s", for_s_);
  writer.Put("elapsed_s", elapsed_s_);
}

void Gust::Restore(base::StateReader& reader) {
  reader.Get("peak_mps", peak_mps_);
  reader.Get("to_rad", to_rad_);
  reader.Get("for_s", for_s_);
  reader.Get("elapsed_s", elapsed_s_);
}

}  // namespace rodeira::nodes
