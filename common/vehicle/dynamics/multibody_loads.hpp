// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/vehicle/dynamics/disc_contact.hpp"
#include "common/vehicle/dynamics/magic_formula.hpp"
#include "common/vehicle/multibody/body.hpp"
#include "common/vehicle/multibody/load.hpp"

namespace rodeira::dynamics {

// What acts on a wheel's carrier: the tyre on the plane under it, the brake's reaction, the wheel's spin. The vertical
// force follows the motion within a step; the tangential ones are set before it.
class WheelLoad final : public multibody::Load {
 public:
  // `centre` and `axle` are entities: the hub's point, and the unit vector along the axle.
  struct Settings {
    multibody::Frame carrier;
    int centre = 0;
    int axle = 0;
    double radius_m = 0.3;
    double vertical_Npm = 2e5;
    double damping_Nspm = 0.0;
    double bottom_m = 0.15;  // deflection at which the rim bears; the load grows no further
    double spin_inertia_kgm2 = 1.0;
  };
  // Where wheel and plane meet; the deflection at most as far as the rim.
  struct Contact : DiscContact {
    double load_N = 0.0;
  };
  explicit WheelLoad(const Settings& settings) : settings_(settings) {}

  // The ground under the wheel: a point of it and its upward unit normal, in W.
  void SetPlane(const Eigen::Vector3d& point_W, const Eigen::Vector3d& normal_W) {
    plane_W_ = point_W;
    normal_W_ = normal_W;
  }
  // Of the tyre at its pressure, vertically; over 0.
  void SetStiffness(double vertical_Npm) { settings_.vertical_Npm = vertical_Npm; }
  // Forces along and across with the aligning moment, torque of the brake on the wheel about the axle, spin.
  void SetStep(const TyreForces& forces, double brake_on_wheel_Nm, double spin_radps);
  // INI, until SetStep: stiff springs hold the hub over this point, beside the forces that are set; locked, or free to
  // roll.
  void Anchor(const Eigen::Vector3d& hub_W, double stiffness_Npm, bool locked);

  // Without a load where the wheel is off the plane.
  Contact ContactAt(const multibody::Motion& motion) const;
  // Tangential forces now: those set and the anchor's.
  Eigen::Vector2d Tangential(const multibody::Motion& motion, const Contact& contact) const;

  std::vector<int> Stiffens() const override { return {settings_.centre}; }
  void Add(const multibody::Motion& motion, multibody::Sink& sink) const override;
  double Force(const multibody::Motion& motion) const override { return ContactAt(motion).load_N; }

 private:
  Settings settings_;
  Eigen::Vector3d plane_W_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_W_ = Eigen::Vector3d::UnitZ();
  TyreForces forces_;
  double brake_on_wheel_Nm_ = 0.0;
  double spin_radps_ = 0.0;
  bool locked_ = false;
  bool anchored_ = false;
  Eigen::Vector3d anchor_W_ = Eigen::Vector3d::Zero();
  double anchor_Npm_ = 0.0;
};

// Air drag and the drive shafts' reaction on the chassis.
class ChassisLoad final : public multibody::Load {
 public:
  // drag_point: where the drag acts. half_rho_area_kgpm: half the air's density times C_d A.
  ChassisLoad(const multibody::Frame& chassis, multibody::Form drag_point, double half_rho_area_kgpm)
      : chassis_(chassis), drag_point_(std::move(drag_point)), half_rho_area_kgpm_(half_rho_area_kgpm) {}
  // For the coming step: the sum of all drive shafts' torques on the wheels, positive forward.
  void SetDrive(double torque_on_wheels_Nm) { torque_on_wheels_Nm_ = torque_on_wheels_Nm; }
  // INI: what the air meets beside the motion, as if the car went that fast.
  void SetHeadway(const Eigen::Vector3d& v_W) { headway_W_ = v_W; }
  void Add(const multibody::Motion& motion, multibody::Sink& sink) const override;
  double Force(const multibody::Motion& motion) const override;  // the drag

 private:
  multibody::Frame chassis_;
  multibody::Form drag_point_;
  double half_rho_area_kgpm_;
  double torque_on_wheels_Nm_ = 0.0;
  Eigen::Vector3d headway_W_ = Eigen::Vector3d::Zero();
};

// The driver's hands turn the column through a spring and a damper.
class ColumnLoad final : public multibody::Load {
 public:
  ColumnLoad(int angle, double stiffness_Nmprad, double damping_Nmsprad)
      : angle_(angle), stiffness_Nmprad_(stiffness_Nmprad), damping_Nmsprad_(damping_Nmsprad) {}
  // The steering wheel as the driver holds it, positive to the left.
  void SetHands(double angle_rad, double rate_radps) {
    hands_rad_ = angle_rad;
    hands_radps_ = rate_radps;
  }
  std::vector<int> Stiffens() const override { return {angle_}; }
  void Add(const multibody::Motion& motion, multibody::Sink& sink) const override;
  double Force(const multibody::Motion& motion) const override;  // torque on the column's lower end

 private:
  int angle_;
  double stiffness_Nmprad_;
  double damping_Nmsprad_;
  double hands_rad_ = 0.0;
  double hands_radps_ = 0.0;
};

}  // namespace rodeira::dynamics
