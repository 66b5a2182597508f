// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::nodes {

// Shows the run: a window where there is a display, PNG frames of given steps with or without one. A sink: it has no
// outputs. Frames are drawn beside the run, from values; it waits for them at its end, or where several are due at
// once. Configuration: `width_px`, `height_px`, `camera` (scene::CameraNames()), `follow` (name of a vehicle node),
// `window` (auto, always, never), `instruments` (true, false), `frames: {times_s: [...], folder: PATH}`. A frame of
// time t shows every car at its sample valid exactly then, and the traffic at its newest one.
base::Result<std::unique_ptr<lockstep::Node>> MakeViewNode(launch::NodeContext& context);

}  // namespace rodeira::nodes
