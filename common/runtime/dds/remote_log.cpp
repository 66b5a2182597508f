// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/remote_log.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

#include "common/runtime/dds/wire.hpp"
#include "common/runtime/launch/run_log_wire.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;
namespace topics = idl::topics;

// In a nack, instead of a source's number: the run's log, with batches that are counted as steps are.
constexpr lockstep::SourceIndex kLogSource = std::numeric_limits<std::uint32_t>::max();

lockstep::RemarkKind KindOf(const std::string& name) {
  for (int k = 0; k <= static_cast<int>(lockstep::RemarkKind::kFault); ++k) {
    if (lockstep::RemarkName(static_cast<lockstep::RemarkKind>(k)) == name) return static_cast<lockstep::RemarkKind>(k);
  }
  return lockstep::RemarkKind::kMark;  // of a later version: it is kept
}

class Speaker final : public LogSpeaker {
 public:
  Speaker(base::Digest roster_hash, std::uint64_t clock_id, std::int64_t base_step_ns)
      : roster_hash_(roster_hash), clock_id_(clock_id), base_step_ns_(base_step_ns) {}
  base::Status Open(Participant& participant) {
    auto writer = participant.MakeWriter(topics::kRunLog, Delivery::kBestEffortRepeated);
    if (!writer) return writer.error();
    writer_ = std::move(writer).value();
    auto reader = participant.MakeReader(topics::kNack, Delivery::kBestEffortRepeated,
                                         [this](base::Bytes&& bytes) { OnNack(bytes); });
    if (!reader) return reader.error();
    reader_ = std::move(reader).value();
    return {};
  }
  void Say(const lockstep::LogBatch& batch) override {
    {
      const std::lock_guard lock(mutex_);
      kept_.Add(batch);
    }
    (void)writer_->Write(EncodeLog(clock_id_, base_step_ns_, batch));
  }

 private:
  void OnNack(const base::Bytes& bytes) {
    const auto ask = DecodeNack(roster_hash_, bytes);
    if (!ask || ask->gap.source != kLogSource) return;
    std::vector<lockstep::LogBatch> again;
    {
      const std::lock_guard lock(mutex_);
      again = kept_.From(static_cast<std::uint64_t>(std::max<lockstep::Step>(ask->gap.from, 0)));
    }
    for (const auto& batch : again) (void)writer_->Write(EncodeLog(clock_id_, base_step_ns_, batch));
  }

  base::Digest roster_hash_;
  std::uint64_t clock_id_;
  std::int64_t base_step_ns_;
  std::mutex mutex_;
  lockstep::KeptLog kept_;
  std::unique_ptr<Writer> writer_;
  std::unique_ptr<Reader> reader_;  // last: its callback uses the rest
};

class Receiver final : public launch::RunLogReceiver {
 public:
  explicit Receiver(base::Digest roster_hash) : roster_hash_(roster_hash) {}
  base::Status Open(Participant& participant) {
    auto writer = participant.MakeWriter(topics::kNack, Delivery::kBestEffortRepeated);
    if (!writer) return writer.error();
    nack_writer_ = std::move(writer).value();
    auto reader = participant.MakeReader(topics::kRunLog, Delivery::kBestEffortRepeated,
                                         [this](base::Bytes&& bytes) { Hear(bytes); });
    if (!reader) return reader.error();
    reader_ = std::move(reader).value();
    return {};
  }
  std::vector<lockstep::LogBatch> Take() override {
    if (const auto gap = inbox_.Gap()) SendNack(*gap);
    return inbox_.Take();
  }
  void BeginAt(std::uint64_t number) override { inbox_.BeginAt(number); }
  bool AwaitEnd(std::chrono::milliseconds limit) override {
    const auto until = std::chrono::steady_clock::now() + limit;
    while (!inbox_.AwaitEnd(10ms)) {
      if (std::chrono::steady_clock::now() > until) return false;
      SendNack(inbox_.next());
    }
    return true;
  }

 private:
  void SendNack(std::uint64_t from) {
    (void)nack_writer_->Write(EncodeNack(roster_hash_, {0, {kLogSource, static_cast<lockstep::Step>(from)}}));
  }
  void Hear(const base::Bytes& bytes) {
    auto heard = DecodeLog(bytes);
    if (!heard) return;
    const std::lock_guard lock(mutex_);
    if (clock_id_ == 0) clock_id_ = heard.value().clock_id;
    if (clock_id_ == heard.value().clock_id) inbox_.Deliver(std::move(heard).value().batch);
  }

  base::Digest roster_hash_;
  std::mutex mutex_;
  std::uint64_t clock_id_ = 0;  // one clock a run: the first
  lockstep::LogInbox inbox_;
  std::unique_ptr<Writer> nack_writer_;
  std::unique_ptr<Reader> reader_;  // last: its callback uses the rest
};

}  // namespace

base::Bytes EncodeLog(std::uint64_t clock_id, std::int64_t base_step_ns, const lockstep::LogBatch& batch) {
  msg::RunLog out;
  out.clock_id(clock_id);
  out.number(batch.number);
  out.last(batch.last ? 1 : 0);
  for (const lockstep::WallTime& wall : batch.walls) out.wall_times().push_back(launch::ToWire(wall));
  for (const lockstep::Remark& remark : batch.remarks) out.remarks().push_back(launch::ToWire(remark, base_step_ns));
  return idl::Encode(out);
}

base::Result<HeardLog> DecodeLog(const base::Bytes& payload) {
  const auto decoded = idl::Decode<msg::RunLog>(payload);
  if (!decoded) return decoded.error();
  const msg::RunLog& in = decoded.value();
  HeardLog heard{in.clock_id(), {in.number(), {}, {}, in.last() != 0}};
  for (const msg::WallTime& wall : in.wall_times()) {
    heard.batch.walls.push_back({wall.after_step(), wall.through_step(), wall.utc_ns(), wall.monotonic_ns(),
                                 wall.late_ns(), wall.pace(), wall.paused() != 0});
  }
  for (const msg::Remark& remark : in.remarks()) {
    heard.batch.remarks.push_back({remark.step(), remark.utc_ns(), remark.monotonic_ns(), remark.pace(),
                                   KindOf(remark.kind()), remark.text(), remark.number()});
  }
  return heard;
}

base::Result<std::unique_ptr<LogSpeaker>> OpenLogSpeaker(Participant& participant, base::Digest roster_hash,
                                                         std::uint64_t clock_id, std::int64_t base_step_ns) {
  auto speaker = std::make_unique<Speaker>(roster_hash, clock_id, base_step_ns);
  if (auto status = speaker->Open(participant); !status) return status.error();
  return std::unique_ptr<LogSpeaker>(std::move(speaker));
}

base::Result<std::unique_ptr<launch::RunLogReceiver>> OpenLogReceiver(Participant& participant,
                                                                      base::Digest roster_hash) {
  auto receiver = std::make_unique<Receiver>(roster_hash);
  if (auto status = receiver->Open(participant); !status) return status.error();
  return std::unique_ptr<launch::RunLogReceiver>(std::move(receiver));
}

}  // namespace rodeira::dds
