// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::traffic {

// The keys of `pedestrians`.
const std::vector<config::Key>& PedestrianKeys();

}  // namespace rodeira::traffic
