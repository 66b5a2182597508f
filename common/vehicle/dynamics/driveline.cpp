// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/driveline.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "common/vehicle/dynamics/friction.hpp"

namespace rodeira::dynamics {
namespace {

// A give that keeps the elements' matrix definite when all of them stick, which ties more than the rotors can turn. It
// is put where it does not matter: a parked car held by its engine creeps by less than 1e-9 rad/s, a locked
// differential's shafts differ by less than 1e-6.
constexpr double kGive = 1e-6;

// Friction elements of a number of driven axles: of each wheel, then of clutch and engine, then of each differential.
template <int kAxles>
DrivelineMotion StepAxles(const EngineSettings& settings, const Engine& engine, const DrivelineLoads& loads,
                          double dt_s) {
  constexpr int kDriven = 2 * kAxles, kEngine = kDriven, kRotors = kDriven + 1;
  constexpr int kClutch = kDriven, kEngineDrag = kClutch + 1, kAxleDifferential = kEngineDrag + 1;
  constexpr int kCentre = kAxleDifferential + kAxles, kElements = kCentre + kAxles - 1;
  using Rotors = Eigen::Matrix<double, kRotors, 1>;  // left and right wheel of each axle, engine
  const auto axle = [&](int i) -> const AxleLoads& {
    return i == 0 ? static_cast<const AxleLoads&>(loads) : loads.rear;
  };
  const std::array<double, 2> shares{loads.front_share, 1.0 - loads.front_share};

  Rotors inverse_inertia = Rotors::Constant(1.0 / loads.wheel_inertia_kgm2), before, torque;
  inverse_inertia[kEngine] = 1.0 / settings.inertia_kgm2;
  for (int i = 0; i < kDriven; ++i) {
    before[i] = axle(i / 2).wheel_radps[static_cast<std::size_t>(i % 2)];
    torque[i] = axle(i / 2).road_torque_Nm[static_cast<std::size_t>(i % 2)];
  }
  before[kEngine] = engine.speed_radps();
  torque[kEngine] = engine.driving_Nm();
  const Rotors free = before + dt_s * inverse_inertia.cwiseProduct(torque);

  Eigen::Matrix<double, kElements, kRotors> ties = Eigen::Matrix<double, kElements, kRotors>::Zero();
  FrictionVector<kElements> bound;
  for (int i = 0; i < kDriven; ++i) {
    ties(i, i) = 1.0;
    bound[i] = axle(i / 2).friction_torque_Nm[static_cast<std::size_t>(i % 2)];
    ties(kClutch, i) = -0.5 * loads.ratio * shares[static_cast<std::size_t>(i / 2)];
    ties(kAxleDifferential + i / 2, i) = i % 2 == 0 ? 0.5 : -0.5;
    if constexpr (kAxles == 2) ties(kCentre, i) = i / 2 == 0 ? 0.25 : -0.25;
  }
  ties(kClutch, kEngine) = 1.0;
  ties(kEngineDrag, kEngine) = 1.0;
  bound[kClutch] = loads.ratio == 0.0 ? 0.0 : loads.clutch_capacity_Nm;
  bound[kEngineDrag] = engine.drag_Nm();
  for (int i = 0; i < kAxles; ++i) bound[kAxleDifferential + i] = axle(i).locking_torque_Nm;
  if constexpr (kAxles == 2) bound[kCentre] = loads.centre_locking_torque_Nm;
  bound *= dt_s;
  FrictionMatrix<kElements> a = ties * inverse_inertia.asDiagonal() * ties.transpose();
  for (int i = kEngineDrag; i < kElements; ++i) a(i, i) *= 1.0 + kGive;
  const FrictionVector<kElements> impulse = SolveFriction<kElements>(a, ties * free, bound);
  const Rotors after = free + inverse_inertia.cwiseProduct(ties.transpose() * impulse);

  DrivelineMotion motion;
  motion.engine_radps = after[kEngine];
  motion.clutch_torque_Nm = -impulse[kClutch] / dt_s;
  const Rotors mean = 0.5 * (before + after);
  // Sums begin with -0.0: of one axle they have its bits, the sign of a zero too.
  double turns_radps = -0.0;  // of the gearbox, over its ratio
  motion.clutch_out_W = motion.locking_heat_W = -0.0;
  for (int k = 0; k < kAxles; ++k) {
    AxleMotion& moved = k == 0 ? static_cast<AxleMotion&>(motion) : motion.rear;
    for (std::size_t i = 0; i < 2; ++i) {
      const int wheel = 2 * k + static_cast<int>(i);
      moved.wheel_radps[i] = after[wheel];
      moved.friction_torque_Nm[i] = impulse[wheel] / dt_s;
      if (axle(k).loss_torque_Nm[i] > 0.0)
        moved.loss_torque_Nm[i] =
            moved.friction_torque_Nm[i] * axle(k).loss_torque_Nm[i] / axle(k).friction_torque_Nm[i];
    }
    const double share = shares[static_cast<std::size_t>(k)];
    moved.drive_torque_Nm = 0.5 * loads.ratio * motion.clutch_torque_Nm * share;
    moved.locking_torque_Nm = impulse[kAxleDifferential + k] / dt_s;
    motion.clutch_out_W += moved.drive_torque_Nm * (mean[2 * k] + mean[2 * k + 1]);
    motion.locking_heat_W += -0.5 * moved.locking_torque_Nm * (mean[2 * k] - mean[2 * k + 1]);
    turns_radps += share * (after[2 * k] + after[2 * k + 1]);
  }
  motion.clutch_slip_radps = after[kEngine] - 0.5 * loads.ratio * turns_radps;
  motion.clutch_in_W = motion.clutch_torque_Nm * mean[kEngine];
  motion.clutch_heat_W = motion.clutch_in_W - motion.clutch_out_W;
  if constexpr (kAxles == 2) {
    motion.drives_all = true;
    motion.centre_locking_torque_Nm = impulse[kCentre] / dt_s;
    motion.locking_heat_W -= 0.25 * motion.centre_locking_torque_Nm * (mean[0] + mean[1] - mean[2] - mean[3]);
    motion.drive_torque_Nm += 0.25 * motion.centre_locking_torque_Nm;
    motion.rear.drive_torque_Nm -= 0.25 * motion.centre_locking_torque_Nm;
  }
  return motion;
}

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
  return loads.drives_all ? StepAxles<2>(settings, engine, loads, dt_s) : StepAxles<1>(settings, engine, loads, dt_s);
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

// The fields of cars with one driven axle, in the order that they have always had; those of a second axle follow only
// where it is driven.
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
  if (!drives_all) return;
  writer.Put("centre_locking_torque_Nm", centre_locking_torque_Nm);
  writer.Put("rear_drive_torque_Nm", rear.drive_torque_Nm);
  writer.Put("rear_locking_torque_Nm", rear.locking_torque_Nm);
  writer.Put("rear_wheel_radps", std::span<const double>(rear.wheel_radps));
  writer.Put("rear_friction_torque_Nm", std::span<const double>(rear.friction_torque_Nm));
  writer.Put("rear_loss_torque_Nm", std::span<const double>(rear.loss_torque_Nm));
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
  drives_all = reader.Has("centre_locking_torque_Nm");
  rear = {};
  centre_locking_torque_Nm = 0.0;
  if (!drives_all) return;
  reader.Get("centre_locking_torque_Nm", centre_locking_torque_Nm);
  reader.Get("rear_drive_torque_Nm", rear.drive_torque_Nm);
  reader.Get("rear_locking_torque_Nm", rear.locking_torque_Nm);
  reader.Get("rear_wheel_radps", std::span<double>(rear.wheel_radps));
  reader.Get("rear_friction_torque_Nm", std::span<double>(rear.friction_torque_Nm));
  reader.Get("rear_loss_torque_Nm", std::span<double>(rear.loss_torque_Nm));
}

}  // namespace rodeira::dynamics
