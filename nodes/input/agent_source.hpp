// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// What a program outside the run wants of the car, from the next activation on. Written between activations.
struct AgentControls {
  dynamics::Controls controls;
  input_devices::Signals signals;
};

// `source: agent`: each activation publishes `wanted` as it is then, clamped. `rodeira env` makes it.
std::unique_ptr<Source> MakeAgentSource(std::shared_ptr<const AgentControls> wanted);

}  // namespace rodeira::nodes
