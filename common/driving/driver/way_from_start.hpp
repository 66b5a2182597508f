// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/driving/driver/lights_ahead.hpp"
#include "common/driving/driver/way.hpp"
#include "common/world/road/world.hpp"

namespace rodeira::driver {

// What an autopilot follows, and the lights on it.
struct WayAndLights {
  std::unique_ptr<const Way> way;  // the world must outlive it
  std::vector<LightLine> lines;
};

// The lane in which the world's start lies, or another one of that road; in a network 20 km straight on from there.
// Wrong input where there is no such lane; `place`: who asks, for the sentence.
base::Result<WayAndLights> WayFromStart(const road::World& world, std::optional<int> lane_wish,
                                        const std::string& place);

}  // namespace rodeira::driver
