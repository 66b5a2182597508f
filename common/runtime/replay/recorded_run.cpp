// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/replay/recorded_run.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <limits>
#include <set>
#include <system_error>

#include "common/core/base/mathematics.hpp"
#include "common/data/record/compress.hpp"
#include "common/data/record/text_number.hpp"
#include "common/runtime/launch/files_of.hpp"
#include "common/runtime/replay/splice.hpp"
#include "idl/aliases.hpp"
#include "idl/topic_types.hpp"

namespace rodeira::replay {
namespace {

namespace fs = std::filesystem;
using lockstep::Step;
constexpr std::uint64_t kMaxFileBytes = 256u << 20;
constexpr const char* kCompressed = "application/x-rodeira-zstd";

std::string Entry(const record::TextMap& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? std::string() : found->second;
}

base::Result<base::Bytes> Unpacked(const record::Attachment& attachment) {
  if (attachment.media_type != kCompressed) return base::Bytes(attachment.data.begin(), attachment.data.end());
  base::ByteReader in(attachment.data);
  const auto size = in.Get<std::uint64_t>();
  if (!in.ok() || size > kMaxFileBytes)
    return base::WrongInput("recording.damaged", fmt::format("the embedded file '{}' is damaged", attachment.name));
  return record::ZstdDecompress(in.GetRaw(in.remaining()), size);
}

}  // namespace

base::Result<lockstep::SampleHeader> HeaderOf(std::span<const std::byte> payload, lockstep::SourceIndex source) {
  if (!lockstep::SampleHeader::HasHeader(payload))
    return base::WrongInput("recording.wrong_sample",
                            fmt::format("a sample of {} bytes was found, which has no header", payload.size()));
  const auto header = lockstep::SampleHeader::Read(payload);
  if (header.source != source)
    return base::WrongInput(
        "recording.wrong_sample",
        fmt::format("a sample of source {} was found on the channel of source {}", header.source, source));
  return header;
}

base::Result<std::optional<lockstep::Sample>> SampleStream::Next() {
  for (;;) {
    auto message = cursor_.Next();
    if (!message) return message.error();
    if (!message.value()) return std::optional<lockstep::Sample>();
    const auto source = sources_.find(message.value()->channel);
    if (source == sources_.end()) continue;  // a channel of its own: wall times, remarks
    const auto data = message.value()->data;
    const auto header = HeaderOf(data, source->second);
    if (!header) return header.error();
    if (header.value().step > last_) continue;
    return std::optional(
        lockstep::Sample{header.value(), std::make_shared<const base::Bytes>(data.begin(), data.end())});
  }
}

base::Result<RecordedRun> RecordedRun::Open(const fs::path& path, const launch::Overrides& extra) {
  auto reader = record::McapReader::Open(path);
  if (!reader) return reader.error();
  if (!reader.value().condition().whole) {
    const auto& findings = reader.value().condition().findings;
    return base::WrongInput("recording.not_whole",
                            fmt::format("the recording is not whole{}; `rodeira repair` saves what can be saved",
                                        findings.empty() ? "" : " (" + findings.front() + ")"),
                            path.string());
  }
  auto folder = base::TemporaryFolder::Make("replay");
  if (!folder) return folder.error();
  RecordedRun run(std::move(reader).value(), std::move(folder).value());
  run.path_ = path;
  if (auto status = run.Read(extra); !status) return run.Named(status.error());
  return run;
}

base::Error RecordedRun::Named(const base::Error& error) const {
  const std::string text = error.context == path_.string() ? error.message : error.Text();
  return error.WithMessage(launch::WithNames(text, folder_.path())).WithContext(path_.string());
}

base::Result<std::vector<launch::NamedFile>> RecordedRun::Files(const record::TextMap& about) const {
  std::vector<launch::NamedFile> files;
  bool has_launch = false;
  for (const record::AttachmentInfo& info : reader_.attachments()) {
    const bool is_launch = info.name == "launch.yaml";
    if (!is_launch && !info.name.starts_with("files/")) continue;
    const auto attachment = reader_.ReadAttachment(info);
    if (!attachment) return attachment.error();
    auto bytes = Unpacked(attachment.value());
    if (!bytes) return bytes.error();
    const std::string launch_file = Entry(about, "launch_file");
    if (is_launch) {
      has_launch = true;
      files.insert(files.begin(), {launch_file.empty() ? "launch.yaml" : launch_file, std::move(bytes).value()});
    } else {
      files.push_back({info.name.substr(6), std::move(bytes).value()});
    }
  }
  if (!has_launch)
    return base::WrongInput("recording.file_missing",
                            "the embedded file 'launch.yaml' is missing; it names the nodes of the run");
  return files;
}

base::Status RecordedRun::Read(const launch::Overrides& extra) {
  const auto metadata = reader_.FindMetadata("rodeira");
  if (!metadata) return metadata.error();
  if (!metadata.value())
    return base::WrongInput("recording.not_of_rodeira",
                            "this is no recording of Rodeira: its metadata 'rodeira' is missing");
  const record::TextMap& about = metadata.value()->entries;
  mathematics_ = Entry(about, "mathematics_hash");
  version_ = Entry(about, "version");
  world_hash_ = Entry(about, "world_hash");
  commit_ = Entry(about, "commit");
  const auto files = Files(about);
  if (!files) return files.error();
  const auto launch_file = launch::LayOut(files.value(), folder_.path());
  if (!launch_file) return launch_file.error();
  launch::Overrides overrides;
  for (const record::AttachmentInfo& info : reader_.attachments()) {
    if (info.name != "override") continue;
    const auto attachment = reader_.ReadAttachment(info);
    if (!attachment) return attachment.error();
    const std::string line(reinterpret_cast<const char*>(attachment.value().data.data()),
                           attachment.value().data.size());
    const auto equals = line.find('=');
    if (equals == std::string::npos)
      return base::WrongInput("recording.contradiction",
                              fmt::format("the recorded override '{}' is no KEY=VALUE", line.substr(0, 100)));
    overrides.emplace_back(line.substr(0, equals), launch::LaidOut(line.substr(equals + 1), launch_file.value()));
  }
  // The run as it was: its roster must be the recorded one, whatever is changed afterwards.
  auto recorded = launch::Launch::Load(launch_file.value(), overrides);
  if (!recorded) return recorded.error();
  if (base::Hex(recorded.value().roster().hash()) != Entry(about, "roster_hash")) {
    return base::WrongInput("recording.contradiction",
                            fmt::format("the recorded launch file gives the roster {}, the recording says {}",
                                        base::Hex(recorded.value().roster().hash()), Entry(about, "roster_hash")));
  }
  const auto said = [&about](const char* key, const std::string& expected) -> base::Status {
    if (Entry(about, key).empty() || Entry(about, key) == expected) return {};
    return base::WrongInput(
        "recording.contradiction",
        fmt::format("the recording says {} {}, but its launch file {}; it was changed after it was written", key,
                    Entry(about, key), expected));
  };
  if (auto status = said("seed", std::to_string(recorded.value().seed())); !status) return status;
  if (auto status = said("base_step_ns", std::to_string(recorded.value().roster().base_step_ns())); !status)
    return status;
  overrides.insert(overrides.end(), extra.begin(), extra.end());
  if (!extra.empty()) {
    const base::Digest roster = recorded.value().roster().hash();
    recorded = launch::Launch::Load(launch_file.value(), overrides);
    if (!recorded) return recorded.error();
    if (recorded.value().roster().hash() != roster) {
      return base::WrongInput(
          "replay.other_roster",
          "the changes give another roster (other nodes, periods or wires); a branch has its parent's");
    }
  }
  launch_ = std::make_shared<launch::Launch>(std::move(recorded).value());
  for (const launch::LaunchNode& node : launch_->nodes()) {
    const std::string key = fmt::format("nodes.{}.library", node.name);
    if (std::ranges::any_of(extra, [&](const auto& change) { return change.first == key; }))
      with_library_.insert(node.name);
  }

  for (const auto& [id, channel] : reader_.channels()) {
    const auto number = record::WholeNumber(channel.metadata, "source_number");
    if (!number) continue;
    if (*number < 0 || static_cast<std::size_t>(*number) >= roster().sources().size() ||
        roster().source(static_cast<lockstep::SourceIndex>(*number)).topic != idl::Aliases().Topic(channel.topic)) {
      return base::WrongInput("recording.contradiction",
                              fmt::format("the channel '{}' says that it is source {}, which the roster does not know",
                                          channel.topic, *number));
    }
    sources_[id] = static_cast<lockstep::SourceIndex>(*number);
  }
  if (auto status = CheckChannels(); !status) return status;
  const auto branch = reader_.FindMetadata(kBranchMetadata);
  if (!branch) return branch.error();
  if (branch.value()) {
    const auto at = record::WholeNumber(branch.value()->entries, "step");
    if (!at || *at < 0)
      return base::WrongInput("recording.contradiction", "the recording does not say at which step it left its parent");
    branched_at_ = *at;
    parent_ = Entry(branch.value()->entries, "parent");
  }
  const auto end = reader_.FindMetadata("rodeira.end");
  if (!end) return end.error();
  const auto last = end.value() ? record::WholeNumber(end.value()->entries, "last_step") : std::nullopt;
  if (!last || *last < 0)
    return base::WrongInput(
        "recording.contradiction",
        "the recording does not say at which step the run ended; not even its first samples are there");
  if (*last > std::numeric_limits<std::int64_t>::max() / 4 / roster().base_step_ns()) {
    return base::WrongInput("recording.contradiction",
                            fmt::format("the recording says that the run ended at step {}, which cannot be", *last));
  }
  last_step_ = *last;
  complete_ = Entry(end.value()->entries, "complete") == "true";
  return {};
}

base::Status RecordedRun::CheckTypes(const std::set<std::string_view>& topics) const {
  std::string differences;
  std::set<std::pair<std::string, record::SchemaId>> compared;
  for (const auto& [id, channel] : reader_.channels()) {
    const std::string topic(idl::Aliases().Topic(channel.topic));
    if (!topics.contains(topic) || !compared.insert({topic, channel.schema}).second) continue;
    const auto schema = reader_.schemas().find(channel.schema);
    const auto difference =
        schema == reader_.schemas().end()
            ? std::optional<std::string>("it has no type in the recording")
            : launch_->topics().RecordedTypeDifference(topic, {schema->second.text, schema->second.name});
    if (difference) differences += fmt::format("{}topic {}: {}", differences.empty() ? "" : "; ", topic, *difference);
  }
  if (differences.empty()) return {};
  return base::WrongInput(
      "replay.other_types",
      fmt::format("the recording's types are not this program's: {}; it was recorded by version {}, "
                  "commit {}: use that version",
                  differences, version_, commit_),
      path_.string());
}

base::Status RecordedRun::CheckTypes() const {
  std::set<std::string_view> topics;
  for (const auto& [channel, source] : sources_) topics.insert(roster().source(source).topic);
  return CheckTypes(topics);
}

std::vector<record::ChannelId> RecordedRun::ChannelsOf(std::string_view topic) const {
  std::vector<record::ChannelId> channels;
  for (const auto& [id, channel] : reader_.channels()) {
    if (idl::Aliases().Topic(channel.topic) == topic) channels.push_back(id);
  }
  return channels;
}

// What the recorder listened to has a channel each: where one is missing, all samples of its source went with it.
base::Status RecordedRun::CheckChannels() const {
  std::set<lockstep::SourceIndex> known;
  for (const auto& [channel, source] : sources_) known.insert(source);
  for (lockstep::NodeIndex n = 0; n < roster().nodes().size(); ++n) {
    if (launch_->node(n).kind->name != "recorder") continue;
    for (const lockstep::Port& port : roster().node(n).inputs) {
      for (const lockstep::SourceIndex source : port.sources) {
        if (known.contains(source)) continue;
        return base::WrongInput(
            "recording.sample_missing",
            fmt::format(
                "the recording holds nothing that node '{}' said on topic {}; it was lost with what was damaged",
                roster().node(roster().source(source).node).name, port.topic));
      }
    }
  }
  return {};
}

base::Status RecordedRun::CheckBytes() const {
  const std::vector<std::string> findings = reader_.Verify();
  if (findings.empty()) return {};
  return base::WrongInput(
      "recording.damaged",
      fmt::format("the recording was changed or damaged after it was written ({})", findings.front()), path_.string());
}

base::Status RecordedRun::CheckMathematics() const {
  const std::string own = base::Hex(base::MathLibraryFingerprint());
  if (mathematics_ == own) return {};
  return base::WrongInput(
      "replay.other_mathematics",
      fmt::format(
          "the recording's mathematics hash is {}, this program's is {}: its mathematics library computes other bits",
          mathematics_, own),
      path_.string());
}

bool RecordedRun::is_substituted(lockstep::NodeIndex node) const {
  const launch::LaunchNode& known = launch().node(node);
  return known.is_live() || (known.is_external() && !with_library_.contains(known.name));
}

std::optional<record::ChannelId> RecordedRun::ChannelOf(lockstep::SourceIndex source) const {
  for (const auto& [channel, recorded] : sources_) {
    if (recorded == source) return channel;
  }
  return std::nullopt;
}

SampleStream RecordedRun::Samples(Step from) const {
  record::Query query;
  query.from_ns = static_cast<std::uint64_t>(from * roster().base_step_ns());
  return SampleStream(reader_.Messages(query), sources_, last_step_);
}

base::Result<std::vector<lockstep::NodeIndex>> RecordedRun::WithoutState() const {
  std::vector<lockstep::NodeIndex> without;
  std::size_t missing = 0;  // first snapshots that have not been seen
  for (const lockstep::RosterNode& node : roster().nodes()) missing += node.snapshots.has_value() ? 1U : 0U;
  if (missing == 0) return without;
  std::vector<bool> seen(roster().nodes().size(), false);
  SampleStream samples = Samples(branched_at_);
  while (missing > 0) {
    const auto sample = samples.Next();
    if (!sample) return sample.error();
    if (!sample.value()) break;
    const lockstep::NodeIndex n = roster().source(sample.value()->source()).node;
    if (roster().node(n).snapshots != sample.value()->source() || seen[n]) continue;
    seen[n] = true;
    --missing;
    const auto snapshot = lockstep::Snapshot::FromSample(*sample.value()->payload);
    if (!snapshot) return snapshot.error();
    if (!snapshot.value().has_state && !is_substituted(n)) without.push_back(n);
  }
  return without;
}

base::Result<Step> RecordedRun::SnapshotAtOrBefore(Step step) const {
  const auto without = WithoutState();
  if (!without) return without.error();
  if (!without.value().empty()) {
    if (branched_at_ == 0) return Step{0};
    return base::WrongInput("replay.node_without_state",
                            fmt::format("node '{}' cannot save its state, and up to step {} its parent's nodes "
                                        "computed: the branch cannot be computed again",
                                        roster().node(without.value().front()).name, branched_at_),
                            path_.string());
  }
  for (const lockstep::RosterNode& node : roster().nodes()) {
    if (!node.snapshots) continue;
    const Step period = roster().source(*node.snapshots).period;
    const Step own = lockstep::CeilTo(branched_at_, period);
    if (own > last_step_)
      return base::WrongInput("replay.no_snapshot",
                              "the branch is shorter than the distance of two snapshots; it holds none of its own",
                              path_.string());
    return std::max(own, lockstep::FloorTo(std::min(step, last_step_), period));
  }
  return Step{0};
}

// A node would wait for one that is missing, for ever.
base::Status RecordedRun::CheckSamples(const lockstep::Snapshot& snapshot) const {
  const lockstep::RosterNode& spec = roster().node(snapshot.node);
  for (const lockstep::SourceIndex source : spec.outputs) {
    const Step newest = std::min(last_step_, lockstep::CeilTo(snapshot.at, spec.period) - spec.period + spec.delay);
    for (Step valid = lockstep::CeilTo(roster().OldestNeeded(source, snapshot.at), spec.period); valid <= newest;
         valid += spec.period) {
      const auto is_it = [&](const lockstep::Sample& sample) {
        return sample.source() == source && sample.valid() == valid;
      };
      if (std::ranges::count_if(snapshot.samples, is_it) == 1) continue;
      return base::WrongInput(
          "recording.sample_missing",
          fmt::format("one sample of {} valid at step {} was expected, which the run goes on with from step {}",
                      roster().SourceName(source), valid, snapshot.at),
          path_.string());
    }
  }
  return {};
}

base::Result<std::vector<lockstep::Snapshot>> RecordedRun::Snapshots(Step at) const {
  std::vector<lockstep::Snapshot> snapshots(roster().nodes().size());
  std::vector<bool> found(snapshots.size(), false);
  for (lockstep::NodeIndex n = 0; n < snapshots.size(); ++n) {
    snapshots[n].node = n;
    snapshots[n].at = at;
  }
  // From the oldest sample that a node may still need, to the newest that was there before the snapshot.
  Step oldest = at;
  for (lockstep::SourceIndex s = 0; s < roster().sources().size(); ++s)
    oldest = std::min(oldest, roster().OldestNeeded(s, at));
  Step newest = at;
  for (const lockstep::RosterNode& node : roster().nodes()) newest = std::max(newest, at - node.period + node.delay);
  SampleStream samples = Samples(oldest);
  for (;;) {
    auto sample = samples.Next();
    if (!sample) return sample.error();
    if (!sample.value() || sample.value()->valid() > newest) break;
    const auto source = sample.value()->source();
    const Step valid = sample.value()->valid();
    const lockstep::NodeIndex n = roster().source(source).node;
    const lockstep::RosterNode& spec = roster().node(n);
    if (spec.snapshots == source) {
      if (valid != at) continue;
      auto snapshot = lockstep::Snapshot::FromSample(*sample.value()->payload);
      if (!snapshot) return snapshot.error();
      if (snapshot.value().node != n || snapshot.value().at != at) {
        return base::WrongInput(
            "recording.snapshot_missing",
            fmt::format("the snapshot of node '{}' at step {} says that it is of node number {} at step {}", spec.name,
                        at, snapshot.value().node, snapshot.value().at),
            path_.string());
      }
      auto samples_so_far = std::move(snapshots[n].samples);
      snapshots[n] = std::move(snapshot).value();
      snapshots[n].samples = std::move(samples_so_far);
      found[n] = true;
    } else if (valid >= roster().OldestNeeded(source, at) &&
               valid <= lockstep::CeilTo(at, spec.period) - spec.period + spec.delay) {
      snapshots[n].samples.push_back(std::move(*sample.value()));
    }
  }
  for (lockstep::NodeIndex n = 0; n < snapshots.size(); ++n) {
    if (auto status = CheckSamples(snapshots[n]); !status) return status.error();
    if (roster().node(n).snapshots && !found[n]) {
      return base::WrongInput("recording.snapshot_missing",
                              fmt::format("the snapshot of node '{}' at step {} is missing", roster().node(n).name, at),
                              path_.string());
    }
  }
  return snapshots;
}

}  // namespace rodeira::replay
