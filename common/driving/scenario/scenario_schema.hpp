// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::scenario {

// The keys of `rodeira: scenario/1`.
const config::Schema& ScenarioSchema();

}  // namespace rodeira::scenario
