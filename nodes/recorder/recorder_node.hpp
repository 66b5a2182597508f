// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/launch/node_context.hpp"

namespace rodeira::nodes {

// Writes every sample that it is wired to, as it was serialised, into an MCAP file, with the IDL as schemas and the
// launch file as an attachment (docs/reference/recordings.md). Lossless: it is a sink that the run waits for, and a
// failed write stops the run. The clock's log goes into channels of its own. Configuration: `file`, and `meta`, a
// mapping of texts that is written down.
base::Result<std::unique_ptr<lockstep::Node>> MakeRecorderNode(launch::NodeContext& context);

}  // namespace rodeira::nodes
