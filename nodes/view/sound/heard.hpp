// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "common/view/sound/synth.hpp"

namespace rodeira::nodes {

// What is heard in the body that the picture goes with (one of the moment's cars or, numbered behind them, of its
// traffic; none: silence): a driver's car from inside; of the traffic the four nearest within 80 m, fainter with the
// distance, from the side where they are. The engines of the traffic are guessed from its speed; no node publishes
// them.
sound::Heard HeardBy(const scene::SceneSnapshot& moment, std::size_t followed, double volume);

}  // namespace rodeira::nodes
