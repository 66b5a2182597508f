// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/config/schema.hpp"

namespace rodeira::launch {

// The keys of `rodeira: node/1`, the manifest of a node outside Rodeira.
const config::Schema& ManifestSchema();

}  // namespace rodeira::launch
