// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "nodes/input/source.hpp"

namespace rodeira::nodes {

// A person's controls, with the handbrake of a car that was left standing: it is pulled at the first activation if the
// car stands then, and let go with the first throttle, or when the person has pulled and let go of it. Without it a car
// that waits in gear for its driver rolls down the hill on which it stands.
std::unique_ptr<Source> ParkedSource(std::unique_ptr<Source> person);

}  // namespace rodeira::nodes
