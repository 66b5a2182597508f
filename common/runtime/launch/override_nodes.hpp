// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/result.hpp"
#include "common/core/config/config.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::launch {

// `nodes`: the mapping of the launch file with its overrides. Wrong input where an override names a key of a node that
// is not there, with the nearest name, or a key that stands one level lower, in the node's `config`.
base::Status CheckNodesOf(const Overrides& overrides, const config::Map& nodes);

}  // namespace rodeira::launch
