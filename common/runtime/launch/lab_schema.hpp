// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::launch {

// The keys of `rodeira: lab/1`.
const config::Schema& LabSchema();

}  // namespace rodeira::launch
