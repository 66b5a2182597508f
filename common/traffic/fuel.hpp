#pragma once

#include "common/traffic/traffic_settings.hpp"

namespace rodeira::traffic {

// Fuel of a petrol car (Euro 4) in mg/s: f0 + f1 v + f3 v² + f4 v³ + (f2 + f5 v + f6 v²) a, as the coefficients of the Handbook of
// Emission Factors are given in polynomial form (HBEFA 4); never below 0. Idling takes 2.4 l/h, 50 km/h 6.5 l/100 km. In overrun (rolling at
// 1.5 m/s and more, slowing down harder than rolling and air resistance do) it is exactly 0.
double FuelFlow_mgps(double speed_mps, double acceleration_mps2);
// The same for cars and vans; lorries and buses burn diesel by Willans' line, 24 g/h a rated kW and 239 g/h a kW that the engine gives
// against inertia, rolling resistance and air, and nothing in overrun.
double FuelFlow_mgps(const AgentTraits& traits, double speed_mps, double acceleration_mps2);

constexpr double kFuelDensity_mgpl = 742e3;  // petrol

}  // namespace rodeira::traffic
