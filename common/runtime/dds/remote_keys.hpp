// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/runtime/dds/participant.hpp"
#include "common/runtime/launch/live_keys.hpp"

namespace rodeira::dds {

// The border of common/runtime/launch/live_keys.hpp between processes: best effort, so that no window ever slows a run.
base::Result<std::unique_ptr<launch::LiveKeysSender>> OpenKeysSender(Participant& participant);
// Both fail as Participant::MakeWriter and MakeReader do; the participant outlives them.
base::Result<std::unique_ptr<launch::LiveKeysReceiver>> OpenKeysReceiver(Participant& participant);

}  // namespace rodeira::dds
