#pragma once

#include <memory>

#include "common/launch/node_context.hpp"
#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// A steering wheel with pedals, or any other joystick, as a wheel file says (docs/formats.md). A device that is missing at
// the start is wrong input; one that is unplugged during the run is told of, its pedals are released, the run goes on.
base::Result<std::unique_ptr<Source>> MakeJoystickSource(const config::Map& config, launch::NodeContext& context);

}  // namespace rodeira::nodes
