// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/driveline.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/vehicle/dynamics/friction.hpp"

namespace rodeira::dynamics {
namespace {

// The friction elements, and a give that keeps their matrix definite when all five stick (five ties on three rotors).
// It is put where it does not matter: a parked car held by its engine creeps by less than 1e-9 rad/s, a locked
// differential's shafts differ by less than 1e-6.
enum Element { kLeft = 0, kRight = 1, kClutch = 2, kEngineDrag = 3, kDifferential = 4 };
constexpr double kGive = 1e-6;

}  // namespace

double LockingTorque(const DifferentialSettings& differential, double sum_of_shafts_Nm) {
  const double locking = sum_of_shafts_Nm > 0.0 ? differential.locking_drive : differential.locking_overrun;
  return differential.preload_Nm + locking * std::fabs(sum_of_shafts_Nm);
}

double ClutchCapacity(const ClutchSettings& clutch, double pedal) {
  return clutch.capacity_Nm * (1.0 - std::clamp(pedal, 0.0, 1.0));
}

DrivelineMotion StepDriveline(const EngineSettings& settings, const Engine& engine, const DrivelineLoads& loads,
                              double dt_s) {
  using Rotors = Eigen::Vector3d;  // left wheel, right wheel, engine
  const Rotors inverse_inertia(1.0 / loads.wheel_inertia_kgm2, 1.0 / loads.wheel_inertia_kgm2,
                               1.0 / settings.inertia_kgm2);
  const Rotors before(loads.wheel_radps[0], loads.wheel_radps[1], engine.speed_radps());
  const Rotors torque(loads.road_torque_Nm[0], loads.road_torque_Nm[1], engine.driving_Nm());
  const Rotors free = before + dt_s * inverse_inertia.cwiseProduct(torque);

  Eigen::Matrix<double, kFrictionElements, 3> ties = Eigen::Matrix<double, kFrictionElements, 3>::Zero();
  ties(kLeft, 0) = 1.0;
  ties(kRight, 1) = 1.0;
  ties.row(kClutch) << -0.5 * loads.ratio, -0.5 * loads.ratio, 1.0;
  ties(kEngineDrag, 2) = 1.0;
  ties.row(kDifferential) << 0.5, -0.5, 0.0;
  FrictionMatrix a = ties * inverse_inertia.asDiagonal() * ties.transpose();
  for (const Element element : {kEngineDrag, kDifferential}) a(element, element) *= 1.0 + kGive;
  FrictionVector bound;
  bound << loads.friction_torque_Nm[0], loads.friction_torque_Nm[1],
      loads.ratio == 0.0 ? 0.0 : loads.clutch_capacity_Nm, engine.drag_Nm(), loads.locking_torque_Nm;
  bound *= dt_s;
  const FrictionVector impulse = SolveFriction(a, ties * free, bound);
  const Rotors after = free + inverse_inertia.cwiseProduct(ties.transpose() * impulse);

  DrivelineMotion motion;
  motion.engine_radps = after[2];
  for (std::size_t i = 0; i < 2; ++i) {
    motion.wheel_radps[i] = after[static_cast<int>(i)];
    motion.friction_torque_Nm[i] = impulse[static_cast<int>(i)] / dt_s;
    if (loads.loss_torque_Nm[i] > 0.0)
      motion.loss_torque_Nm[i] = motion.friction_torque_Nm[i] * loads.loss_torque_Nm[i] / loads.friction_torque_Nm[i];
  }
  motion.clutch_torque_Nm = -impulse[kClutch] / dt_s;
  motion.drive_torque_Nm = 0.5 * loads.ratio * motion.clutch_torque_Nm;
  motion.clutch_slip_radps = after[2] - 0.5 * loads.ratio * (after[0] + after[1]);
  const Rotors mean = 0.5 * (before + after);
  motion.clutch_in_W = motion.clutch_torque_Nm * mean[2];
  motion.clutch_out_W = motion.drive_torque_Nm * (mean[0] + mean[1]);
  motion.clutch_heat_W = motion.clutch_in_W - motion.clutch_out_W;
  motion.locking_torque_Nm = impulse[kDifferential] / dt_s;
  motion.locking_heat_W = -0.5 * motion.locking_torque_Nm * (mean[0] - mean[1]);
  return motion;
}

double StepFreeWheel(double wheel_radps, double inertia_kgm2, double road_torque_Nm, double& friction_Nm, double dt_s) {
  const double free = wheel_radps + dt_s * road_torque_Nm / inertia_kgm2;
  const double most = dt_s * friction_Nm / inertia_kgm2;
  if (std::fabs(free) <= most) {
    friction_Nm = -free * inertia_kgm2 / dt_s;
    return 0.0;
  }
  friction_Nm = free > 0.0 ? -friction_Nm : friction_Nm;
  return free > 0.0 ? free - most : free + most;
}

void DrivelineMotion::Save(base::StateWriter& writer) const {
  writer.Put("engine_radps", engine_radps);
  writer.Put("drive_torque_Nm", drive_torque_Nm);
  writer.Put("clutch_torque_Nm", clutch_torque_Nm);
  writer.Put("clutch_slip_radps", clutch_slip_radps);
  writer.Put("clutch_in_W", clutch_in_W);
  writer.Put("clutch_out_W", clutch_out_W);
  writer.Put("clutch_heat_W", clutch_heat_W);
  writer.Put("locking_torque_Nm", locking_torque_Nm);
  writer.Put("locking_heat_W", locking_heat_W);
  writer.Put("wheel_radps", std::span<const double>(wheel_radps));
  writer.Put("friction_torque_Nm", std::span<const double>(friction_torque_Nm));
  writer.Put("loss_torque_Nm", std::span<const double>(loss_torque_Nm));
}

void DrivelineMotion::Restore(base::StateReader& reader) {
  reader.Get("engine_radps", engine_radps);
  reader.Get("drive_torque_Nm", drive_torque_Nm);
  reader.Get("clutch_torque_Nm", clutch_torque_Nm);
  reader.Get("clutch_slip_radps", clutch_slip_radps);
  reader.Get("clutch_in_W", clutch_in_W);
  reader.Get("clutch_out_W", clutch_out_W);
  reader.Get("clutch_heat_W", clutch_heat_W);
  reader.Get("locking_torque_Nm", locking_torque_Nm);
  reader.Get("locking_heat_W", locking_heat_W);
  reader.Get("wheel_radps", std::span<double>(wheel_radps));
  reader.Get("friction_torque_Nm", std::span<double>(friction_torque_Nm));
  reader.Get("loss_torque_Nm", std::span<double>(loss_torque_Nm));
}

}  // namespace rodeira::dynamics
