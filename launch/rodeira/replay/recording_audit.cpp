// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/recording_audit.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/data/record/text_number.hpp"
#include "common/runtime/lockstep/sample.hpp"
#include "common/runtime/lockstep/snapshot.hpp"
#include "idl/aliases.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topic_types.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/replay/content_digest.hpp"

namespace rodeira::cli {
namespace {

// The entries of a metadata record; none where it is not there.
record::TextMap EntriesOf(const record::McapReader& reader, const char* name) {
  const auto metadata = reader.FindMetadata(name);
  return metadata && metadata.value() ? metadata.value()->entries : record::TextMap();
}

// Which steps the wall times cover. They come in the order of their steps.
class WallCover {
 public:
  void Add(const record::Message& message) {
    const auto wall = idl::Decode<msg::WallTime>(message.data);
    if (!wall) return;
    uncovered_ += std::max<std::int64_t>(wall.value().after_step() - covered_, 0);
    covered_ = std::max<std::int64_t>(covered_, wall.value().through_step());
  }
  std::int64_t UncoveredThrough(std::int64_t last_step) const {
    return uncovered_ + std::max<std::int64_t>(last_step - covered_, 0);
  }

 private:
  std::int64_t covered_ = -1;
  std::int64_t uncovered_ = 0;
};

}  // namespace

std::string RecordedSource::Verdict() const {
  if (!audit) return "";
  if (audit->count == 0) return "no sample";
  if (lossless()) return "lossless";
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (audit->first_step != 0) add(fmt::format("begins at step {}", audit->first_step));
  if (!audit->gaps.empty()) {
    add(fmt::format("{} missing, the first behind step {}", audit->missing, audit->gaps.front().after_step));
  }
  if (audit->repeated > 0) add(fmt::format("{} said twice", audit->repeated));
  if (audit->backward > 0) add(fmt::format("{} out of order", audit->backward));
  if (ends_early) add(fmt::format("ends at step {}", audit->last_step));
  return text;
}

bool RecordingAudit::has_every_sample() const {
  return std::ranges::all_of(sources, [](const RecordedSource& source) { return source.lossless(); });
}
bool RecordingAudit::lossless() const { return damages.empty() && has_every_sample(); }

RecordingAudit Audit(const record::McapReader& reader) {
  RecordingAudit result;
  result.damages = reader.condition().findings;
  if (result.damages.empty()) result.damages = reader.Verify();
  const record::TextMap end = EntriesOf(reader, "rodeira.end");
  result.last_step = record::WholeNumber(end, "last_step");
  const auto complete = end.find("complete");
  result.broken_off = complete != end.end() && complete->second != "true";
  const auto base_step_ns = record::WholeNumber(EntriesOf(reader, "rodeira"), "base_step_ns");
  record::StepAudit steps;
  std::map<record::ChannelId, RecordedSource> sources;
  std::map<record::ChannelId, std::uint64_t> periods;
  for (const auto& [id, channel] : reader.channels()) {
    RecordedSource& source = sources[id];
    source.topic = channel.topic;
    const auto name = channel.metadata.find("source");
    if (name != channel.metadata.end()) source.source = name->second;
    const auto schema = reader.schemas().find(channel.schema);
    if (schema != reader.schemas().end()) {
      source.type = schema->second.name;
      if (idl::FindTopic(idl::Aliases().Topic(channel.topic)) != nullptr) {
        source.type_difference =
            idl::RecordedTypeDifference(channel.topic, {schema->second.text, schema->second.name}).value_or("");
      }
    }
    const auto period = record::WholeNumber(channel.metadata, "period_steps");
    if (!period || *period <= 0) continue;
    periods[id] = static_cast<std::uint64_t>(*period);
    steps.Declare(channel.topic, id, periods[id]);
    if (!base_step_ns || *base_step_ns <= 0) continue;
    source.rate_hz = 1e9 / (static_cast<double>(*period) * static_cast<double>(*base_step_ns));
  }
  std::optional<WallCover> walls;
  ContentDigest content;
  record::Query query;
  query.order = record::Query::Order::kFile;
  auto cursor = reader.Messages(query);
  for (;;) {
    const auto message = cursor.Next();
    if (!message) {
      result.damages.push_back(message.error().Text());
      continue;
    }
    if (!message.value()) break;
    RecordedSource& source = sources[message.value()->channel];
    ++source.samples;
    source.bytes += message.value()->data.size();
    const bool readable = source.type_difference.empty();
    if (readable && idl::Aliases().Topic(source.topic) == idl::topics::kWallTime) {
      if (!walls) walls.emplace();
      walls->Add(*message.value());
    }
    if (readable && source.topic == lockstep::kSnapshotTopic && source.samples == 1) {
      const auto snapshot = lockstep::Snapshot::FromSample(message.value()->data);
      source.without_state = snapshot && !snapshot.value().has_state;
    }
    if (!periods.contains(message.value()->channel) || !lockstep::SampleHeader::HasHeader(message.value()->data))
      continue;
    content.Add(reader.channels().at(message.value()->channel), *message.value());
    const auto step = lockstep::SampleHeader::Read(message.value()->data).step;
    if (step >= 0) steps.Add(source.topic, message.value()->channel, static_cast<std::uint64_t>(step));
  }
  result.content = content.digest();
  if (result.last_step && *result.last_step < 0)
    result.damages.push_back(fmt::format("its last words say that the run ended at step {}", *result.last_step));
  for (const auto& [key, audit] : steps.Finish()) {
    RecordedSource& source = sources[static_cast<record::ChannelId>(key.second)];
    source.audit = audit;
    const auto period = static_cast<std::int64_t>(periods[static_cast<record::ChannelId>(key.second)]);
    const bool ended = result.last_step && !result.broken_off;
    const auto delay = static_cast<std::int64_t>(
        record::WholeNumber(reader.channels().at(static_cast<record::ChannelId>(key.second)).metadata, "delay_steps")
            .value_or(period));
    if (ended && *result.last_step >= 0 && audit.count > 0 &&
        static_cast<std::int64_t>(audit.last_step) > *result.last_step + delay) {
      result.damages.push_back(
          fmt::format("its last words say that the run ended at step {}, but node '{}' has samples through step {}",
                      *result.last_step, source.source, audit.last_step));
    }
    source.ends_early = ended && static_cast<std::int64_t>(audit.last_step) < *result.last_step / period * period;
  }
  if (walls) result.steps_without_wall_time = walls->UncoveredThrough(result.last_step.value_or(-1));
  for (auto& [id, source] : sources) result.sources.push_back(std::move(source));
  return result;
}

}  // namespace rodeira::cli
