// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/dds/participant.hpp"
#include "common/runtime/launch/live_requests.hpp"

namespace rodeira::dds {

// The border of common/runtime/launch/live_requests.hpp between processes: best effort, so that no window ever slows a
// run.
base::Result<std::unique_ptr<launch::LiveRequestsSender>> OpenRequestsSender(Participant& participant);
// Both fail as Participant::MakeWriter and MakeReader do; the participant outlives them.
base::Result<std::unique_ptr<launch::LiveRequestsReceiver>> OpenRequestsReceiver(Participant& participant);

}  // namespace rodeira::dds
