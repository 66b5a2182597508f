// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/core/base/thread_pool.hpp"
#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/bicycle_car.hpp"
#include "common/vehicle/dynamics/controls.hpp"

namespace rodeira::dynamics {

// Many cars of model `bicycle`, each with the bits that BicycleModel gives it alone, whatever else is in the array:
// four wheels with suspension and tyres on SUELO's planes, engine, clutch, gears. Arrays of one kind of value each, one
// element a car.
class CarArray {
 public:
  // Adds a kind of car; returns its index. Wrong input if its wheels envelop the ground, which needs more queries
  // than an array makes.
  base::Result<std::uint32_t> AddKind(const BicycleSettings& settings);
  // INI of one more car; its index. Refused as by BicycleModel::Initialise; the array is then as before.
  base::Result<std::size_t> Add(std::uint32_t kind, const InitialCondition& initial, ground::Ground& ground);

  // Sets the number of places; new ones are empty: without ground queries and motion. Cars may be placed and removed
  // while others drive.
  void Resize(std::size_t places);
  // INI of a car at a place, replacing the car there. If it fails, the place is unchanged.
  base::Status Place(std::size_t i, std::uint32_t kind, const InitialCondition& initial, ground::Ground& ground);
  // Removes the car of a place.
  void Clear(std::size_t i) { present_[i] = 0; }
  bool present(std::size_t i) const { return present_[i] != 0; }

  // Steps all cars by dt_s (above 0, at most 0.1 s) with constant controls, one per place. The ground is queried once,
  // in one batch of all wheels in the order of the cars (law L4); then each car is integrated in substeps of at most 1
  // ms on these planes. The number of threads changes no bit.
  void Step(std::span<const Controls> controls, ground::Ground& ground, double dt_s, base::ThreadPool* pool = nullptr);

  std::size_t size() const { return cars_.size(); }
  // Preconditions of these: i is below size(); for the chassis and the position, a car has been placed there.
  const BicycleCar& car(std::size_t i) const { return cars_[i]; }
  const BicycleChassis& chassis(std::size_t i) const { return *chassis_[kinds_[i]]; }
  // Steer angles, forces and torques of its last substep.
  const BicycleFindings& findings(std::size_t i) const { return findings_[i]; }
  // B's origin in W.
  Eigen::Vector3d p_WB_W(std::size_t i) const { return cars_[i].p_WB_W(chassis(i)); }
  // Along the car.
  double speed_mps(std::size_t i) const { return (cars_[i].body.q_WG.conjugate() * cars_[i].body.v_WG_W).x(); }

  // Which places hold a car, of which kind, and its motion; Restore is meant for an array with the same kinds and as
  // many places.
  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  void QueryGround(ground::Ground& ground);
  void StepRange(std::span<const Controls> controls, double dt_s, std::size_t from, std::size_t to);

  std::vector<std::shared_ptr<const BicycleChassis>> chassis_;  // by kind
  std::vector<std::uint32_t> kinds_;
  std::vector<std::uint32_t> present_;  // 0: the place is empty
  std::vector<BicycleCar> cars_;
  std::vector<BicycleFindings> findings_;
  std::vector<ground::GroundQuery> queries_;  // scratch
  std::vector<ground::GroundPoint> points_;
};

}  // namespace rodeira::dynamics
