#include "nodes/recorder/recorder_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "common/base/mathematics.hpp"
#include "common/record/mcap_writer.hpp"
#include "idl/topics.hpp"
#include "nodes/recorder/embed.hpp"
#include "nodes/recorder/log_channels.hpp"

namespace rodeira::nodes {
namespace {

constexpr const char* kProfile = "rodeira/1";

class RecorderNode final : public lockstep::Node {
 public:
  RecorderNode(record::McapWriter writer, std::filesystem::path file, const lockstep::Roster& roster, std::unique_ptr<launch::RunLogReceiver> log)
      : writer_(std::move(writer)), file_(std::move(file)), roster_(roster), log_(std::move(log), roster.base_step_ns()) {}
  // Of a run that never began no recording is left. What is no plain file (a device, a pipe) was not made here.
  ~RecorderNode() override {
    std::error_code problem;
    if (!complete_ && !has_samples_ && std::filesystem::is_regular_file(file_, problem)) std::filesystem::remove(file_, problem);
  }

  base::Status Begin(const launch::Launch& launch, lockstep::NodeIndex self, const record::TextMap& meta) {
    const record::TextMap about{
        {"launch", launch.name()},
        {"launch_file", launch.path().filename().string()},
        {"roster_hash", base::Hex(roster_.hash())},
        {"protocol_hash", base::Hex(idl::ProtocolHash())},
        {"mathematics_hash", base::Hex(base::MathematicsDigest())},
        {"base_step_ns", std::to_string(roster_.base_step_ns())},
        {"seed", std::to_string(launch.seed())},
        {"version", "0.1.0"},
    };
    if (auto status = writer_.AddMetadata("rodeira", about); !status) return status;
    if (!meta.empty()) {
      if (auto status = writer_.AddMetadata("rodeira.meta", meta); !status) return status;
    }
    if (auto status = EmbedFiles(launch, writer_); !status) return status;
    channels_.assign(roster_.sources().size(), 0);
    for (const lockstep::Port& port : roster_.node(self).inputs) {
      const idl::TopicInfo* topic = idl::FindTopic(port.topic);
      RODEIRA_ASSERT(topic != nullptr);
      const auto schema = writer_.AddSchema(topic->type, "omgidl", idl::IdlTextOf(topic->subject));
      if (!schema) return schema.error();
      for (const lockstep::SourceIndex source : port.sources) {
        const auto& from = roster_.source(source);
        const record::TextMap metadata{{"source", roster_.node(from.node).name},
                                       {"source_number", std::to_string(source)},
                                       {"period_steps", std::to_string(from.period)},
                                       {"delay_steps", std::to_string(from.delay)}};
        const auto channel = writer_.AddChannel(port.topic, schema.value(), "cdr", metadata);
        if (!channel) return channel.error();
        channels_[source] = channel.value();
      }
    }
    return log_.Begin(writer_);
  }

  base::Status Initialise(lockstep::Outbox&) override { return {}; }
  base::Status Step(const lockstep::StepInfo&, const lockstep::Inbox& inbox, lockstep::Outbox&) override {
    if (auto status = WriteAll(inbox); !status) return status;
    return log_.Write(writer_);
  }
  base::Status Finish(const lockstep::Inbox& rest, lockstep::Step last_step, bool complete) override {
    complete_ = complete;
    if (auto status = WriteAll(rest); !status) return status;
    const bool log_complete = log_.AwaitEnd(complete);
    if (auto status = log_.Write(writer_); !status) return status;
    const record::TextMap end{{"last_step", std::to_string(last_step)},
                              {"complete", complete ? "true" : "false"},
                              {"log_complete", log_complete ? "true" : "false"}};
    if (auto status = writer_.AddMetadata("rodeira.end", end); !status) return status;
    return writer_.Close();
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
      if (auto status = Write(*sample); !status) return status;
    }
    return {};
  }
  base::Status Write(const lockstep::Sample& sample) {
    has_samples_ = true;
    payload_ = *sample.payload;
    std::memset(payload_.data() + lockstep::SampleHeader::kIncarnationAt, 0, 4);  // which life it was is no part of the run
    const auto time_ns = static_cast<std::uint64_t>(sample.header.time_ns);
    const auto sequence = static_cast<std::uint32_t>(sample.valid() / roster_.source(sample.source()).period);
    return writer_.Write(channels_[sample.source()], sequence, time_ns, time_ns, payload_);
  }

  record::McapWriter writer_;
  std::filesystem::path file_;
  bool complete_ = false;
  bool has_samples_ = false;
  const lockstep::Roster& roster_;
  LogChannels log_;
  std::vector<record::ChannelId> channels_;  // by source
  base::Bytes payload_;
};

}  // namespace

base::Result<std::unique_ptr<lockstep::Node>> MakeRecorderNode(launch::NodeContext& context) {
  const std::filesystem::path file = context.config().Path("file");
  const config::Map about = context.config().OptionalChild("meta");
  record::TextMap meta;
  for (const std::string& key : about.Keys()) meta[key] = about.Text(key);
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  record::WriterSettings settings;
  settings.profile = kProfile;
  auto writer = record::McapWriter::Open(file, settings);
  if (!writer) return writer.error();
  auto node = std::make_unique<RecorderNode>(std::move(writer).value(), file, context.roster(), context.RunLog());
  if (auto status = node->Begin(context.launch(), context.index(), meta); !status) return status.error();
  return std::unique_ptr<lockstep::Node>(std::move(node));
}

}  // namespace rodeira::nodes
