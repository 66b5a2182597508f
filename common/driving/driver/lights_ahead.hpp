// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/core/base/state.hpp"
#include "common/driving/driver/route_path.hpp"
#include "common/world/network/lights.hpp"

namespace rodeira::driver {

// The line of a light on a way.
struct LightLine {
  double d_m = 0.0;
  std::uint32_t controller = 0;  // index into the network's controllers
};

// The lines of the lights that hold for a route's lanes, in the order in which it comes to them.
std::vector<LightLine> LightLines(const network::Network& network, const RoutePath& route);

// A light on the way, and what it shows now.
struct LightAhead {
  double d_m = 0.0;  // of its line
  network::LightColour colour = network::LightColour::kGreen;
};

// How the driver meets traffic lights.
struct LightSettings {
  double before_line_m = 0.6;   // here the front stops
  double for_amber_mps2 = 2.8;  // a car that can stop by braking so hard stops at amber (docs/explanation/traffic.md)
  double braking_mps2 = 1.5;    // comfortable
  double max_deceleration_mps2 = 8.0;  // a car that could not stop even so goes on at red
  double tracking_s = 1.0;             // time in which a deviation from the braking is made good
};

// Stops at lights. At the first line ahead that does not show green it decides, once: a car that could no more stop
// after `anticipation_s` (which pedals take) goes on.
class LightStops {
 public:
  // The acceleration that it takes to stop, where it has to; nothing where it may go on. `lights` ascending.
  std::optional<double> Step(const LightSettings& settings, std::span<const LightAhead> lights, double front_m,
                             double speed_mps, double anticipation_s);

  void Save(base::StateWriter& writer) const;
  void Restore(base::StateReader& reader);

 private:
  static constexpr double kNone_m = -1.0;

  double decided_m_ = kNone_m;  // the line about which it has decided
  bool passes_ = false;
};

}  // namespace rodeira::driver
