// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::design {

// The keys of a world file that ReadDesign reads.
const std::vector<config::Key>& DesignKeys();

// The keys of an included file.
const config::Schema& IncludeSchema();
// The keys of one item: of `roads`, of `junctions`, of `objects`; of `section`, and of a template without `template`.
const config::Schema& RoadSchema();
const config::Schema& JunctionSchema();
const config::Schema& ObjectSchema();
const config::Schema& SectionSchema();

}  // namespace rodeira::design
