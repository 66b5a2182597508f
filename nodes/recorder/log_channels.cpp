// SPDX-License-Identifier: Apache-2.0
#include "nodes/recorder/log_channels.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "common/runtime/launch/run_log_wire.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::nodes {
namespace {

using namespace std::chrono_literals;

base::Result<record::ChannelId> AddChannel(record::McapWriter& writer, std::string_view topic) {
  const idl::TopicInfo* info = idl::FindTopic(topic);
  RODEIRA_ASSERT(info != nullptr);
  const auto schema = writer.AddSchema(info->type, "omgidl", idl::IdlTextOf(info->subject));
  if (!schema) return schema.error();
  return writer.AddChannel(topic, schema.value(), "cdr", {{"source", "clock"}});
}

}  // namespace

LogChannels::LogChannels(std::unique_ptr<launch::RunLogReceiver> log, std::int64_t base_step_ns)
    : log_(std::move(log)), base_step_ns_(base_step_ns) {}

base::Status LogChannels::Begin(record::McapWriter& writer) {
  if (log_ == nullptr) return {};
  const auto wall = AddChannel(writer, idl::topics::kWallTime);
  if (!wall) return wall.error();
  wall_ = wall.value();
  const auto remarks = AddChannel(writer, idl::topics::kRemarks);
  if (!remarks) return remarks.error();
  remarks_ = remarks.value();
  return {};
}

void LogChannels::Remember(const record::Channel& channel, const record::Message& message) {
  if (log_ == nullptr) return;
  if (channel.topic == idl::topics::kRemarks) last_remark_ = std::max(last_remark_, message.sequence);
  if (channel.topic != idl::topics::kWallTime) return;
  const auto wall = idl::Decode<msg::WallTime>(message.data);
  if (!wall) return;
  last_wall_ = std::max<lockstep::Step>(last_wall_, wall.value().through_step());
  log_->BeginAt(message.sequence);
}

std::uint64_t LogChannels::TimeOf(lockstep::Step step) const {
  return static_cast<std::uint64_t>(std::max<lockstep::Step>(step, 0) * base_step_ns_);
}

base::Status LogChannels::Write(record::McapWriter& writer) {
  if (log_ == nullptr) return {};
  for (const lockstep::LogBatch& batch : log_->Take()) {
    for (const lockstep::WallTime& wall : batch.walls) {
      if (wall.through <= last_wall_) continue;
      last_wall_ = wall.through;
      const std::uint64_t time_ns = TimeOf(wall.through);
      if (auto status = writer.Write(wall_, static_cast<std::uint32_t>(batch.number), time_ns, time_ns,
                                     idl::Encode(launch::ToWire(wall)));
          !status)
        return status;
    }
    for (const lockstep::Remark& remark : batch.remarks) {
      if (remark.number <= last_remark_) continue;
      last_remark_ = remark.number;
      const std::uint64_t time_ns = TimeOf(remark.step);
      if (auto status = writer.Write(remarks_, remark.number, time_ns, time_ns,
                                     idl::Encode(launch::ToWire(remark, base_step_ns_)));
          !status)
        return status;
    }
  }
  return {};
}

bool LogChannels::AwaitEnd(bool complete) { return log_ == nullptr || log_->AwaitEnd(complete ? 2000ms : 300ms); }

}  // namespace rodeira::nodes
