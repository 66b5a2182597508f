#pragma once

#include "common/traffic/traffic_settings.hpp"

namespace rodeira::traffic {

// What pedals, gear and engine do while a car moves as the planar model says.
struct Driving {
  double throttle = 0.0;  // 0 … 1
  double brake = 0.0;     // 0 … 1; 1 brakes at 8 m/s²
  double clutch = 0.0;    // 0 engaged … 1 disengaged
  double engine_radps = 0.0;
  int gear = 1;           // 1 … n
};

// The engine's torque that moves mass_kg with this speed and acceleration on this grade (rise over plan distance), against rolling
// resistance and ½ ρ c_d A v², through the highest gear in which the engine neither labours nor is too weak; below idle speed the
// clutch slips in the first gear. What the closed throttle does not slow down by, the brake does; who stands has his foot on it.
// Cars and vans have the engine and the gears of MOTORS, its torque in proportion to the mass; lorries and buses a diesel of 17.5 kW a tonne.
Driving DrivingFor(const AgentTraits& traits, double speed_mps, double acceleration_mps2, double grade);

}  // namespace rodeira::traffic
