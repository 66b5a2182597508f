// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/dynamics/multibody_settings.hpp"
#include "common/vehicle/multibody/system.hpp"

namespace rodeira::dynamics {

// A wheel at one position of its suspension, in the axes of the drawing: x forward, y left, z up. Signs of angles are
// those of ISO 8855.
struct WheelPosition {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d contact_m = Eigen::Vector3d::Zero();  // the lowest point of the wheel as a thin disc
  double steer_rad = 0.0;                               // of the wheel's plane about z, left positive
  double toe_in_rad = 0.0;
  double camber_rad = 0.0;  // positive: the top leans outward
  double spring_m = 0.0;    // length of the suspension's distance
  double spring_N = 0.0;    // in it at rest; tension positive
};

// What follows from the wheel's motion near a position. Left and right wheels move alike.
struct SuspensionFigures {
  double bump_steer_radpm = 0.0;   // change of toe-in over travel, upward positive
  double camber_gain_radpm = 0.0;  // change of camber over travel
  double lateral_share = 0.0;      // outward way of the contact over travel
  double forward_share = 0.0;      // forward way of the contact over travel
  double roll_centre_m = 0.0;      // height above the ground, from the directions in which the contacts move
  double spring_share = 0.0;       // shortening of the spring over travel
  double wheel_rate_Npm = 0.0;     // vertical stiffness at the wheel, springs alone, both wheels of the axle alike
  struct SteeringAxis {
    double caster_rad = 0.0;       // positive: the top leans backward
    double inclination_rad = 0.0;  // positive: the top leans inward
    double scrub_radius_m = 0.0;   // contact outward of where the axis meets the ground
    double trail_m = 0.0;          // contact behind where the axis meets the ground
  };
  std::optional<SteeringAxis> steering_axis;  // of wheels that the steering turns
};

// What a force on one wheel changes while the steering wheel and the height of every wheel are held. Joints are rigid:
// only the steering column gives way, so all is 0 at a wheel that the steering does not turn.
struct WheelCompliance {
  struct Change {
    double toe_in_rad = 0.0, camber_rad = 0.0;
  };
  Change lateral;       // by a newton outward at the contact
  Change longitudinal;  // by a newton forward at the contact, the wheel held by its brake
  Change aligning;      // by a newton metre about z, towards toe-in
};

// A multibody car's suspensions on a bench: the chassis is held where it is drawn, the wheels are moved, without a
// tyre, a weight or friction. A value of positions; one thread.
class SuspensionRig {
 public:
  // Wrong input (`vehicle.loose_suspension`) where wheels or steering do not hold the mechanism: more than the four
  // distances and the steering angle can move.
  static base::Result<SuspensionRig> Make(const MultibodySettings& car);

  // Puts each wheel's centre `travel_m` above where it is drawn, the steering wheel at `steering_rad`, left positive.
  // Wrong input (`vehicle.travel_out_of_reach`), naming the wheel, where the suspension does not reach it; the rig then
  // stays where it was.
  base::Status MoveTo(const std::array<double, kWheels>& travel_m, double steering_rad);

  // `wheel`: kFrontLeft …
  WheelPosition wheel(std::size_t wheel) const;
  // At this travel of all wheels, steering straight ahead; by central differences over 1 mm and 0.05 rad. The rig is
  // there afterwards. Wrong input as of MoveTo.
  base::Result<SuspensionFigures> Figures(std::size_t wheel, double travel_m);
  // At this travel of all wheels, steering straight ahead: by virtual work, with central differences over 0.05 rad. The
  // rig is there afterwards. Wrong input as of MoveTo.
  base::Result<WheelCompliance> Compliance(std::size_t wheel, double travel_m);

 private:
  SuspensionRig(const MultibodySettings& car, std::unique_ptr<multibody::System> system);
  // Assembles it with these lengths.
  base::Status Hold(const std::array<double, kWheels>& lengths_m, double steering_rad);
  // One part of a way, short enough for Newton's method.
  base::Status Reach(const std::array<double, kWheels>& travel_m, double steering_rad);
  Eigen::Vector3d At(int entity) const;
  double TravelNow(std::size_t wheel) const { return At(wheels_[wheel].centre).z() - drawn_z_m_[wheel]; }
  double SpringEnergy(std::size_t wheel) const;
  // The carrier against where it is drawn.
  Eigen::Isometry3d CarrierPose(std::size_t wheel) const;
  std::optional<SuspensionFigures::SteeringAxis> FindSteeringAxis(std::size_t wheel);

  std::array<MultibodyWheelSettings, kWheels> wheels_;
  int steering_ = 0;
  double column_Nmprad_ = 0.0;
  double radius_m_ = 0.0;
  std::unique_ptr<multibody::System> system_;
  std::array<double, kWheels> drawn_z_m_{};
  std::array<double, kWheels> lengths_m_{};  // of the springs now
  std::array<double, kWheels> travel_m_{};
  double steering_rad_ = 0.0;
};

}  // namespace rodeira::dynamics
