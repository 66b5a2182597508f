// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/plot/curves.hpp"
#include "common/core/plot/table.hpp"
#include "common/vehicle/dynamics/vehicle_model.hpp"

namespace rodeira::manoeuvres {

// A car with joints (VehicleModel::has_joint_forces) that is driven as itself and writes down the forces in its joints
// and springs each 10 ms, from its last Initialise on.
class ForceTrace final : public dynamics::VehicleModel {
 public:
  // The car outlives it.
  explicit ForceTrace(dynamics::VehicleModel& car) : car_(&car) {}

  base::Status Initialise(const dynamics::InitialCondition& initial, ground::Ground& ground) override;
  void Step(const dynamics::Controls& controls, ground::Ground& ground, double dt_s) override;
  const dynamics::VehicleState& state() const override { return car_->state(); }
  const dynamics::VehicleDimensions& dimensions() const override { return car_->dimensions(); }
  void Save(base::StateWriter& writer) const override { car_->Save(writer); }
  void Restore(base::StateReader& reader) override { car_->Restore(reader); }
  std::vector<std::string> output_names() const override { return car_->output_names(); }
  std::vector<double> Outputs() const override { return car_->Outputs(); }
  base::Status problem() const override { return car_->problem(); }

  // time_s, then of each joint BODY_POINT_x_N, _y_N, _z_N (in B), of each spring NAME_N and NAME_damper_N.
  plot::Table ForceTable() const;
  // Sizes of the forces over time: a diagram a body, one of the springs and one of their dampers.
  std::vector<plot::Diagram> Diagrams() const;

 private:
  void Write();

  dynamics::VehicleModel* car_;
  double time_s_ = 0.0;
  std::vector<double> times_s_;
  std::vector<dynamics::JointForces> forces_;
};

}  // namespace rodeira::manoeuvres
