// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/traffic/motion/drivetrain.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "common/vehicle/dynamics/bicycle_settings.hpp"

namespace rodeira::traffic {

// The car of the vehicle library that an agent of this body drives. Cars and vans have the engine and the gears of
// MOTORS (appendix A.19 and A.22), its torque in proportion to the mass; lorries and buses a diesel of 17.5 kW a tonne
// (at 11 t 1100 N m from 1200 to 1600 rpm). Tyres by the source's slip curve, springs by the natural frequency, brakes
// that slow down by 9 m/s² with the pedal to the floor; all else by length, width and mass.
dynamics::BicycleSettings CarOf(const AgentTraits& traits);

// The same by AgentTraits::body, made once.
const dynamics::BicycleSettings& CarOfBody(std::uint32_t body);
// The planar car of those settings.
const PlanarCar& PlanarCarOfBody(std::uint32_t body);

// The least g track / (2 height of the centre of mass) of all bodies that there may be any of: so much sideways tips
// one over on stiff springs.
double TipsAt_mps2(const TrafficSettings& settings);

}  // namespace rodeira::traffic
