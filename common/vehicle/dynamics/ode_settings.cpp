// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/ode_settings.hpp"

#include "common/core/base/constants.hpp"
#include "common/core/config/declared.hpp"
#include "common/vehicle/dynamics/parts_file.hpp"
#include "common/vehicle/dynamics/vehicle_schema.hpp"
#include "common/vehicle/dynamics/vehicle_state.hpp"

namespace rodeira::dynamics {
double LoadAtRest(const BicycleSettings& car, std::size_t wheel) {
  const double rear_share = car.body.cg_to_front_axle_m / car.body.wheelbase_m;
  return 0.5 * car.body.mass_kg * base::kGravity_mps2 * (wheel < kRearLeft ? 1.0 - rear_share : rear_share);
}

Eigen::Vector3d HubAtRest_B(const BicycleSettings& car, std::size_t wheel) {
  const bool front = wheel < kRearLeft;
  const double half_track = 0.5 * (front ? car.dimensions.track_front_m : car.dimensions.track_rear_m);
  const double sunk = LoadAtRest(car, wheel) / car.wheel.vertical_Npm;
  return {(front ? 0.5 : -0.5) * car.body.wheelbase_m, wheel % 2 == 0 ? half_track : -half_track,
          car.wheel.radius_m - sunk};
}

OdeChassis ChassisOf(const OdeSettings& settings) {
  const BodySettings& body = settings.car.body;
  const Eigen::Vector3d p_BT_B(0.5 * body.wheelbase_m - body.cg_to_front_axle_m, 0.0,
                               body.cg_height_m);  // of the whole car
  OdeChassis chassis;
  chassis.mass_kg = body.mass_kg - 4.0 * settings.wheel_mass_kg;
  chassis.p_BG_B = body.mass_kg * p_BT_B;
  for (std::size_t i = 0; i < kWheels; ++i) chassis.p_BG_B -= settings.wheel_mass_kg * HubAtRest_B(settings.car, i);
  chassis.p_BG_B /= chassis.mass_kg;
  const auto steiner = [&](double mass_kg, const Eigen::Vector3d& p_B) -> Eigen::Vector3d {
    const Eigen::Vector3d r = p_B - p_BT_B;
    return mass_kg * (r.squaredNorm() * Eigen::Vector3d::Ones() - r.cwiseAbs2());
  };
  const double across = settings.wheel_across_kgm2;
  chassis.inertia_kgm2 = {body.roll_inertia_kgm2, body.pitch_inertia_kgm2, body.yaw_inertia_kgm2};
  for (std::size_t i = 0; i < kWheels; ++i) {
    chassis.inertia_kgm2 -= steiner(settings.wheel_mass_kg, HubAtRest_B(settings.car, i)) +
                            Eigen::Vector3d(across, settings.car.wheel.inertia_kgm2, across);
  }
  chassis.inertia_kgm2 -= steiner(chassis.mass_kg, chassis.p_BG_B);
  return chassis;
}

OdeSettings ReadOde(const config::Map& root) {
  OdeSettings ode;
  ode.car = ReadBicycle(root);
  const config::DeclaredMap map(root.Child("ode"), OdeKeys());
  ode.wheel_mass_kg = map.Number("wheel_mass_kg");
  ode.wheel_across_kgm2 = map.Number("wheel_across_kgm2");
  ode.tyre_damping_Nspm = map.Number("tyre_damping_Nspm");
  ode.stop_Npm = map.Number("stop_Npm");
  ode.clearance_m = map.Number("clearance_m");
  ode.body_friction = map.Number("body_friction");
  ode.longest_substep_s = map.Number("longest_substep_s");
  for (TyreSettings& tyre : ode.car.tyre) LimitDamping(ode.car.wheel, ode.longest_substep_s, tyre);
  // Numbers that are wrong by themselves have been told of: what follows needs sound ones.
  if (!(ode.car.body.mass_kg > 0.0 && ode.wheel_mass_kg > 0.0 && ode.car.body.wheelbase_m > 0.0 &&
        ode.car.wheel.vertical_Npm > 0.0))
    return ode;
  const OdeChassis chassis = ChassisOf(ode);
  if (!(chassis.mass_kg > 0.0)) {
    map.map().Problem("wheel_mass_kg", "config.wrong_order",
                      "four times 'ode.wheel_mass_kg' is not below 'body.mass_kg', the whole car's");
  } else if (!(chassis.inertia_kgm2.minCoeff() > 0.0)) {
    map.map().Problem(
        "wheel_mass_kg",
        "the wheels alone have more inertia about the car's centre of gravity than 'body' says of the whole car");
  }
  if (ode.clearance_m >= ode.car.dimensions.height_m)
    map.map().Problem("clearance_m", "config.wrong_order", "'ode.clearance_m' is not below 'dimensions.height_m'");
  return ode;
}

}  // namespace rodeira::dynamics
