// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::multibody {

// The keys of `rodeira: mechanism/1`; all of them but `rodeira`, for files with a mechanism in them.
const config::Schema& MechanismSchema();
const std::vector<config::Key>& MechanismKeys();

}  // namespace rodeira::multibody
