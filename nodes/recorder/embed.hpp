// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/result.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "common/runtime/launch/launch.hpp"

namespace rodeira::nodes {

// Puts into a recording what the run was made of (docs/reference/recordings.md): the launch file as 'launch.yaml',
// every file that it names as 'files/NAME', each --set as 'override'. Larger files are compressed and say so by their
// media type.
base::Status EmbedFiles(const launch::Launch& launch, record::McapWriter& writer);

}  // namespace rodeira::nodes
