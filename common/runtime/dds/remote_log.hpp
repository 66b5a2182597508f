// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/core/base/bytes.hpp"
#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/launch/run_log_border.hpp"

namespace rodeira::dds {

// As msg::RunLog (CDR).
base::Bytes EncodeLog(std::uint64_t clock_id, std::int64_t base_step_ns, const lockstep::LogBatch& batch);

// A batch of the log, and the clock that sent it: a restarted clock has another id.
struct HeardLog {
  std::uint64_t clock_id = 0;
  lockstep::LogBatch batch;
};
// Wrong input where the payload is no such message.
base::Result<HeardLog> DecodeLog(const base::Bytes& payload);

// The clock's side: says each batch once, and again what is asked for.
class LogSpeaker {
 public:
  virtual ~LogSpeaker() = default;
  // Batches in ascending order. It does not wait for any reader.
  virtual void Say(const lockstep::LogBatch& batch) = 0;
};
// Readers of another roster are passed over.
base::Result<std::unique_ptr<LogSpeaker>> OpenLogSpeaker(Participant& participant, base::Digest roster_hash,
                                                         std::uint64_t clock_id, std::int64_t base_step_ns);

// The recorder's side, which asks for what it lacks.
base::Result<std::unique_ptr<launch::RunLogReceiver>> OpenLogReceiver(Participant& participant,
                                                                      base::Digest roster_hash);

}  // namespace rodeira::dds
