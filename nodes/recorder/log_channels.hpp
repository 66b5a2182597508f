// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "common/core/base/result.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "common/runtime/launch/run_log_border.hpp"

namespace rodeira::nodes {

// The clock's log in a recording: one message of rodeira/wall_time a grant, one of rodeira/remarks a remark. Their log
// time is the simulated time of their step, so that they stand beside the samples; the wall's times are in the
// messages, and the sequence number of a wall's message is that of its batch. A run without a log gets no such
// channels.
class LogChannels {
 public:
  LogChannels(std::unique_ptr<launch::RunLogReceiver> log, std::int64_t base_step_ns);
  // Adds the channels to the recording, before the first message.
  base::Status Begin(record::McapWriter& writer);
  // A message of these channels that an earlier incarnation of the recorder has written: it is not written again.
  void Remember(const record::Channel& channel, const record::Message& message);
  // What has come so far.
  base::Status Write(record::McapWriter& writer);
  // Waits for the rest, longer where the run went well; false where not all of it has come. The run does not fail by
  // that.
  bool AwaitEnd(bool complete);

 private:
  std::uint64_t TimeOf(lockstep::Step step) const;

  std::unique_ptr<launch::RunLogReceiver> log_;
  std::int64_t base_step_ns_;
  record::ChannelId wall_ = 0;
  record::ChannelId remarks_ = 0;
  lockstep::Step last_wall_ = -1;  // through_step of the newest that is written
  std::uint32_t last_remark_ = 0;  // its number
};

}  // namespace rodeira::nodes
