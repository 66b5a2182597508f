// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/runtime/launch/launch.hpp"
#include "idl/topic_types.hpp"

namespace rodeira::launch {

// The topics that a node of the launch publishes or reads: its ports, the protocol of the lockstep, and what its kind
// uses besides. Every process computes the same set for a node.
idl::TopicSet UsedTopics(const Launch& launch, lockstep::NodeIndex node);

}  // namespace rodeira::launch
