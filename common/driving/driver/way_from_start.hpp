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

// The lane in which the world's start lies, or another lane of the same road, from its beginning 20 km straight on.
// Wrong input where there is no such lane; `place`: what names it, for the sentence.
base::Result<WayAndLights> WayFromStart(const road::World& world, std::optional<int> wanted_lane,
                                        const std::string& place);

}  // namespace rodeira::driver
