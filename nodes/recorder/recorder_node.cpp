// SPDX-License-Identifier: Apache-2.0
#include "nodes/recorder/recorder_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <system_error>
#include <utility>

#include "common/core/base/mathematics.hpp"
#include "common/core/base/version.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "idl/topic_types.hpp"
#include "idl/topics.hpp"
#include "nodes/recorder/embed.hpp"
#include "nodes/recorder/log_channels.hpp"
#include "nodes/recorder/program.hpp"
#include "nodes/recorder/written_samples.hpp"

namespace rodeira::nodes {
namespace {

constexpr const char* kProfile = "rodeira/1";
// With the window by which nodes run ahead and the recorder's own period: at most a second is lost with its process.
constexpr std::uint64_t kChunkSpanNs = 800'000'000;

class RecorderNode final : public lockstep::Node {
 public:
  RecorderNode(std::filesystem::path file, const lockstep::Roster& roster, launch::NodeContext& context)
      : file_(std::move(file)),
        roster_(roster),
        log_(context.RunLog(), roster.base_step_ns()),
        written_(roster, context.index()) {}
  // Of a run that never began no recording is left: only what this recorder has made is removed. What is no plain file
  // (a device, a pipe) was not made here.
  ~RecorderNode() override {
    std::error_code problem;
    if (writer_ && !complete_ && !has_samples_ && std::filesystem::is_regular_file(file_, problem))
      std::filesystem::remove(file_, problem);
  }

  // A file of its own, or that of an earlier incarnation.
  base::Status Open(launch::NodeContext& context, const record::TextMap& meta) {
    if (auto status = OpenFile(context, meta); !status) return status;
    bytes_when_told_ = writer_->written_bytes();
    return {};
  }

  base::Status OpenFile(launch::NodeContext& context, const record::TextMap& meta) {
    if (auto status = AskForTheWorld(context); !status) return status;
    record::WriterSettings settings;
    settings.profile = kProfile;
    settings.chunk_span_ns = kChunkSpanNs;
    tell_safe_ = context.RecordedStepReporter();
    if (context.is_restarted() && std::filesystem::exists(file_)) {
      const auto gone_on = ContinueFile(context, settings);
      if (!gone_on) return gone_on.error();
      if (gone_on.value()) {
        has_samples_ = true;
        if (auto status = AddChannels(context.launch().topics(), context.index()); !status) return status;
        context.BeginBehind(last_step_ - 1);
        written_.BeginBehind(last_step_, last_source_);
        if (tell_safe_) tell_safe_(last_step_ - 1);
        return {};
      }
      settings.overwrite = true;  // it has no chunk yet, and nothing of it was said to be safe
    }
    auto writer = record::McapWriter::Open(file_, settings);
    if (!writer) return writer.error();
    writer_.emplace(std::move(writer).value());
    if (auto status = Begin(context.launch(), meta); !status) return status;
    return AddChannels(context.launch().topics(), context.index());
  }

  base::Status AskForTheWorld(launch::NodeContext& context) {
    const auto& nodes = context.launch().nodes();
    if (std::none_of(nodes.begin(), nodes.end(), [](const auto& node) { return node.kind->name == "road"; })) return {};
    const auto world = context.World();
    if (!world) return world.error();
    world_hash_ = world.value().content_hash;
    return {};
  }

  // Called while the writer is being opened: the samples of the file's end, which others may ask for. False where the
  // file holds none yet.
  base::Result<bool> ContinueFile(launch::NodeContext& context, const record::WriterSettings& settings) {
    const auto take = [&](const record::Channel& channel, const record::Message& message) -> base::Status {
      const auto number = channel.metadata.find("source_number");
      if (number == channel.metadata.end()) {
        log_.Remember(channel, message);
        return {};
      }
      if (!lockstep::SampleHeader::HasHeader(message.data))
        return base::WrongInput("run.wrong_sample", "a sample without a header was found", file_.string());
      const lockstep::Sample sample{lockstep::SampleHeader::Read(message.data),
                                    std::make_shared<const base::Bytes>(message.data.begin(), message.data.end())};
      last_step_ = sample.valid();
      last_source_ = sample.source();
      return context.Remember(sample);
    };
    const auto safe = context.LastRecordedStep();
    if (!safe) return safe.error();
    auto writer =
        record::McapWriter::Resume(file_, settings, {TailNs(), EndOfSafeNs(context.index(), safe.value()), take});
    if (!writer) return writer.error();
    if (!writer.value()) return false;
    writer_ = std::move(writer).value();
    return true;
  }
  // What is said to be safe ends with a sample of the fastest recorded source, at the latest.
  std::uint64_t EndOfSafeNs(lockstep::NodeIndex self, lockstep::Step safe) const {
    if (safe < 0) return 0;
    lockstep::Step period = safe + 1;
    for (const lockstep::Port& port : roster_.node(self).inputs) {
      for (const lockstep::SourceIndex source : port.sources) period = std::min(period, roster_.source(source).period);
    }
    return static_cast<std::uint64_t>(safe / period * period * roster_.base_step_ns());
  }
  // What a lost node goes on from is at most two snapshots old.
  std::uint64_t TailNs() const {
    lockstep::Step steps = 0;
    for (const lockstep::Source& source : roster_.sources()) steps = std::max(steps, 2 * source.period + source.delay);
    return static_cast<std::uint64_t>(steps * roster_.base_step_ns()) + 1'000'000'000;
  }

  base::Status Begin(const launch::Launch& launch, const record::TextMap& meta) {
    record::TextMap about{
        {"launch", launch.name()},
        {"launch_file", launch.path().filename().string()},
        {"roster_hash", base::Hex(roster_.hash())},
        {"protocol_hash", base::Hex(idl::ProtocolHash())},
        {"mathematics_hash", base::Hex(base::MathLibraryFingerprint())},
        {"base_step_ns", std::to_string(roster_.base_step_ns())},
        {"seed", std::to_string(launch.seed())},
        {"version", std::string(base::Version())},
        {"commit", std::string(ProgramCommit())},
    };
    if (world_hash_) about["world_hash"] = base::Hex(*world_hash_);
    if (auto status = writer_->AddMetadata("rodeira", about); !status) return status;
    if (!meta.empty()) {
      if (auto status = writer_->AddMetadata("rodeira.meta", meta); !status) return status;
    }
    return EmbedFiles(launch, *writer_);
  }

  base::Status AddChannels(const idl::TopicTable& topics, lockstep::NodeIndex self) {
    channels_.assign(roster_.sources().size(), 0);
    for (const lockstep::Port& port : roster_.node(self).inputs) {
      const auto topic = topics.SchemaOf(port.topic);
      RODEIRA_ASSERT(topic.has_value());
      const auto schema = writer_->AddSchema(topic->type, "omgidl", topic->idl);
      if (!schema) return schema.error();
      for (const lockstep::SourceIndex source : port.sources) {
        const auto& from = roster_.source(source);
        const record::TextMap metadata{{"source", roster_.node(from.node).name},
                                       {"source_number", std::to_string(source)},
                                       {"period_steps", std::to_string(from.period)},
                                       {"delay_steps", std::to_string(from.delay)}};
        const auto channel = writer_->AddChannel(port.topic, schema.value(), "cdr", metadata);
        if (!channel) return channel.error();
        channels_[source] = channel.value();
      }
    }
    return log_.Begin(*writer_);
  }

  base::Status Initialise(lockstep::Outbox&) override { return {}; }
  base::Status Step(const lockstep::StepInfo&, const lockstep::Inbox& inbox, lockstep::Outbox&) override {
    if (auto status = WriteAll(inbox); !status) return status;
    return log_.Write(*writer_);
  }
  base::Status Finish(const lockstep::Inbox& rest, lockstep::Step last_step, bool complete) override {
    complete_ = complete;
    if (auto status = WriteAll(rest); !status) return status;
    const bool log_complete = log_.AwaitEnd(complete);
    if (auto status = log_.Write(*writer_); !status) return status;
    record::TextMap end{{"last_step", std::to_string(last_step)},
                        {"complete", complete ? "true" : "false"},
                        {"log_complete", log_complete ? "true" : "false"}};
    end.merge(written_.Entries(last_step));
    if (auto status = writer_->AddMetadata("rodeira.end", end); !status) return status;
    return writer_->Close();
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

 private:
  // In the order of (step, source): the file is a function of the run alone.
  base::Status WriteAll(const lockstep::Inbox& inbox) {
    std::vector<const lockstep::Sample*> samples;
    for (const auto& port : inbox.ports()) {
      for (const lockstep::Sample& sample : port.samples) samples.push_back(&sample);
    }
    std::stable_sort(samples.begin(), samples.end(), [](const lockstep::Sample* a, const lockstep::Sample* b) {
      return a->valid() != b->valid() ? a->valid() < b->valid() : a->source() < b->source();
    });
    for (const lockstep::Sample* sample : samples) {
      if (IsWritten(*sample)) continue;
      if (auto status = Write(*sample); !status) return status;
    }
    return {};
  }
  base::Status Write(const lockstep::Sample& sample) {
    has_samples_ = true;
    payload_ = *sample.payload;
    std::memset(payload_.data() + lockstep::SampleHeader::kIncarnationAt, 0,
                4);  // which incarnation it was is no part of the run
    const auto time_ns = static_cast<std::uint64_t>(sample.header.time_ns);
    const auto sequence = static_cast<std::uint32_t>(sample.valid() / roster_.source(sample.source()).period);
    if (auto status = writer_->Write(channels_[sample.source()], sequence, time_ns, time_ns, payload_); !status)
      return status;
    written_.Note(sample.valid(), sample.source());
    TellSafe();
    newest_written_ = sample.valid();
    return {};
  }
  // Of the first sample since a chunk went to the file: those before it lie there. Messages of the log close chunks
  // too. A recorder that is started again finds the newest of them, and asks for the others of its step once more.
  void TellSafe() {
    const std::uint64_t bytes = writer_->written_bytes();
    if (tell_safe_ && bytes != bytes_when_told_ && newest_written_ > 0) tell_safe_(newest_written_ - 1);
    bytes_when_told_ = bytes;
  }
  // By an earlier incarnation: the file is in the order of (step, source).
  bool IsWritten(const lockstep::Sample& sample) const {
    return sample.valid() < last_step_ || (sample.valid() == last_step_ && sample.source() <= last_source_);
  }

  std::optional<record::McapWriter> writer_;
  std::filesystem::path file_;
  std::optional<base::Digest> world_hash_;  // none where the run has no world
  bool complete_ = false;
  bool has_samples_ = false;
  const lockstep::Roster& roster_;
  LogChannels log_;
  WrittenSamples written_;
  std::vector<record::ChannelId> channels_;  // by source
  base::Bytes payload_;
  std::function<void(lockstep::Step)> tell_safe_;
  std::uint64_t bytes_when_told_ = 0;
  lockstep::Step newest_written_ = -1;  // of this incarnation
  lockstep::Step last_step_ = -1;       // of an earlier incarnation's last sample
  lockstep::SourceIndex last_source_ = 0;
};

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeRecorderNode(launch::NodeContext& context) {
  const std::filesystem::path file = context.config().Path("file");
  const config::Map about = context.config().OptionalChild("meta");
  record::TextMap meta;
  for (const std::string& key : about.Keys()) meta[key] = about.Text(key);
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  auto node = std::make_unique<RecorderNode>(file, context.roster(), context);
  if (auto status = node->Open(context, meta); !status) return status.error();
  return std::unique_ptr<lockstep::Node>(std::move(node));
}

}  // namespace rodeira::nodes
