// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/replay/splice.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <map>
#include <system_error>
#include <vector>

#include "common/core/base/put_in_place.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "common/data/record/text_number.hpp"
#include "idl/aliases.hpp"
#include "idl/topics.hpp"

namespace rodeira::replay {
namespace {

namespace fs = std::filesystem;
using lockstep::SampleHeader;

class Splicer {
 public:
  Splicer(const RecordedRun& parent, const record::McapReader& branch, lockstep::Step at, record::McapWriter& writer,
          const std::function<bool()>& stop_requested)
      : parent_(parent), branch_(branch), at_(at), writer_(writer), stop_requested_(stop_requested) {}

  base::Status Write(const record::TextMap& about) {
    for (const auto& info : branch_.metadata()) {
      if (info.name == "rodeira.end") continue;
      const auto metadata = branch_.ReadMetadata(info);
      if (!metadata) return metadata.error();
      if (auto status = writer_.AddMetadata(info.name, metadata.value().entries); !status) return status;
    }
    if (auto status = writer_.AddMetadata(kBranchMetadata, about); !status) return status;
    for (const auto& info : branch_.attachments()) {
      const auto attachment = branch_.ReadAttachment(info);
      if (!attachment) return attachment.error();
      if (auto status = writer_.AddAttachment(info.name, info.media_type, attachment.value().data, 0, 0); !status)
        return status;
    }
    if (auto status = AddChannels(); !status) return status;
    if (auto status = CopyParent(); !status) return status;
    if (auto status = CopyBranch(); !status) return status;
    const auto end = branch_.FindMetadata("rodeira.end");
    if (!end) return end.error();
    if (end.value()) {
      if (auto status = writer_.AddMetadata("rodeira.end", WithAllCounted(end.value()->entries)); !status)
        return status;
    }
    return writer_.Close();
  }

 private:
  base::Status AddChannels() {
    for (const auto& [id, channel] : branch_.channels()) {
      const record::Schema& schema = branch_.schemas().at(channel.schema);
      const auto new_schema = writer_.AddSchema(schema.name, schema.encoding, schema.text);
      if (!new_schema) return new_schema.error();
      const auto made =
          writer_.AddChannel(channel.topic, new_schema.value(), channel.message_encoding, channel.metadata);
      if (!made) return made.error();
      of_branch_[id] = made.value();
      const auto number = channel.metadata.find("source_number");
      if (number != channel.metadata.end()) of_source_[number->second] = made.value();
    }
    return {};
  }
  // What the parent says of the wall's clock, its operator's marks among it, has no place in the order of samples. A
  // grant across the branch's first step belongs to it: it covers the parent's last steps.
  base::Status LoadParentsLog() {
    const record::McapReader& reader = parent_.reader();
    std::map<record::ChannelId, record::ChannelId> of_parent;
    for (const auto& [id, channel] : reader.channels()) {
      if (channel.metadata.contains("source_number")) continue;
      for (const auto& [own, same] : branch_.channels()) {
        if (same.topic == idl::Aliases().Topic(channel.topic) && !same.metadata.contains("source_number"))
          of_parent[id] = of_branch_.at(own);
      }
    }
    if (of_parent.empty()) return {};
    record::Query query;
    query.channels.emplace();
    for (const auto& [id, channel] : of_parent) query.channels->insert(id);
    const auto at_ns = static_cast<std::uint64_t>(at_ * parent_.roster().base_step_ns());
    bool covered = false;
    auto cursor = reader.Messages(query);
    for (;;) {
      const auto message = cursor.Next();
      if (!message) return message.error();
      if (!message.value()) return {};
      const record::Message& in = *message.value();
      const bool is_wall = idl::Aliases().Topic(reader.channels().at(in.channel).topic) == idl::topics::kWallTime;
      if (in.log_time_ns > at_ns && !is_wall) continue;
      if (covered && is_wall) return {};
      covered = covered || (is_wall && in.log_time_ns >= at_ns);
      parents_log_.push_back({of_parent.at(in.channel), in.sequence, in.log_time_ns, in.publish_time_ns,
                              base::Bytes(in.data.begin(), in.data.end())});
    }
  }
  base::Status CopyParentsLogThrough(std::uint64_t time_ns) {
    for (; next_in_log_ < parents_log_.size() && parents_log_[next_in_log_].log_time_ns <= time_ns; ++next_in_log_) {
      const Logged& entry = parents_log_[next_in_log_];
      if (auto status =
              writer_.Write(entry.channel, entry.sequence, entry.log_time_ns, entry.publish_time_ns, entry.data);
          !status)
        return status;
    }
    return {};
  }
  base::Status CopyParent() {
    if (auto status = LoadParentsLog(); !status) return status;
    SampleStream samples = parent_.Samples();
    for (;;) {
      const auto sample = samples.Next();
      if (!sample) return sample.error();
      if (stopped()) return Stopped();
      const bool is_over = !sample.value() || sample.value()->valid() > at_;
      const std::uint64_t until_ns = is_over ? std::numeric_limits<std::uint64_t>::max()
                                             : static_cast<std::uint64_t>(sample.value()->header.time_ns);
      if (auto status = CopyParentsLogThrough(until_ns); !status) return status;
      if (is_over) return {};
      const auto& source = parent_.roster().source(sample.value()->source());
      if (source.topic == lockstep::kSnapshotTopic && sample.value()->valid() == at_) continue;
      const auto channel = of_source_.find(std::to_string(sample.value()->source()));
      if (channel == of_source_.end()) continue;
      const auto time_ns = static_cast<std::uint64_t>(sample.value()->header.time_ns);
      const auto sequence = static_cast<std::uint32_t>(sample.value()->valid() / source.period);
      if (auto status = writer_.Write(channel->second, sequence, time_ns, time_ns, *sample.value()->payload); !status)
        return status;
      ++written_[channel->second];
    }
  }
  base::Status CopyBranch() {
    auto cursor = branch_.Messages();
    for (;;) {
      const auto message = cursor.Next();
      if (!message) return message.error();
      if (stopped()) return Stopped();
      if (!message.value()) return {};
      const record::Message& in = *message.value();
      const record::Channel& channel = branch_.channels().at(in.channel);
      if (channel.metadata.contains("source_number") && SampleHeader::HasHeader(in.data)) {
        const lockstep::Step valid = SampleHeader::Read(in.data).step;
        if (valid < at_ || (valid == at_ && channel.topic != lockstep::kSnapshotTopic)) continue;
      }
      if (auto status =
              writer_.Write(of_branch_.at(in.channel), in.sequence, in.log_time_ns, in.publish_time_ns, in.data);
          !status)
        return status;
      ++written_[of_branch_.at(in.channel)];
    }
  }

  // The branch's recorder has counted its own samples only; one a period was expected from each source, from step 0.
  record::TextMap WithAllCounted(record::TextMap end) const {
    const auto last_step = record::WholeNumber(end, "last_step");
    if (!last_step || !end.contains("samples")) return end;
    std::int64_t samples = 0, missing = 0;
    for (const auto& [id, channel] : branch_.channels()) {
      const auto period = record::WholeNumber(channel.metadata, "period_steps");
      if (!period || *period <= 0) continue;
      const auto counted = written_.find(of_branch_.at(id));
      const std::int64_t found = counted == written_.end() ? 0 : counted->second;
      samples += found;
      missing += std::max<std::int64_t>(*last_step / *period + 1 - found, 0);
    }
    end["samples"] = std::to_string(samples);
    end["missing"] = std::to_string(missing);
    return end;
  }

  bool stopped() const { return stop_requested_ && stop_requested_(); }
  base::Error Stopped() const {
    return base::Failed("run.interrupted", "interrupted while the branch was written; there is no new file",
                        parent_.path().string());
  }

  struct Logged {
    record::ChannelId channel = 0;  // the new file's
    std::uint32_t sequence = 0;
    std::uint64_t log_time_ns = 0;
    std::uint64_t publish_time_ns = 0;
    base::Bytes data;
  };

  const RecordedRun& parent_;
  const record::McapReader& branch_;
  lockstep::Step at_;
  record::McapWriter& writer_;
  const std::function<bool()>& stop_requested_;
  std::map<record::ChannelId, record::ChannelId> of_branch_;
  std::map<std::string, record::ChannelId> of_source_;
  std::map<record::ChannelId, std::int64_t> written_;  // messages
  std::vector<Logged> parents_log_;                    // up to at_, by log time
  std::size_t next_in_log_ = 0;
};

}  // namespace

base::Status CheckNewRecording(const fs::path& target) {
  std::error_code problem;
  if (!fs::exists(target, problem)) return {};
  return base::WrongInput("file.exists", "the file exists; a recording is never overwritten", target.string());
}

base::Status Splice(const RecordedRun& parent, const fs::path& branch, lockstep::Step at, const record::TextMap& about,
                    const fs::path& target, const std::function<bool()>& stop_requested) {
  std::error_code problem;
  if (auto status = CheckNewRecording(target); !status) return status;
  const auto reader = record::McapReader::Open(branch);
  if (!reader) return reader.error();
  const fs::path part = target.string() + fmt::format(".{}.part", ::getpid());
  record::WriterSettings settings;
  settings.profile = reader.value().header().profile;
  auto writer = record::McapWriter::Open(part, settings);
  if (!writer) return writer.error().WithContext(target.string());
  auto status = Splicer(parent, reader.value(), at, writer.value(), stop_requested).Write(about);
  if (status.ok()) {
    status = base::PutInPlace(part, target);
    if (status.ok()) return {};
  }
  fs::remove(part, problem);
  return status;
}

}  // namespace rodeira::replay
