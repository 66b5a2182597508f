// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/hash.hpp"
#include "common/world/road/world_spec.hpp"

namespace rodeira::road {

// Of every number in the spec that can change an answer, in a fixed order; not of names.
base::Digest ContentHash(const WorldSpec& spec);

}  // namespace rodeira::road
