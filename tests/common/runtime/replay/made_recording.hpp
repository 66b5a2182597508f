// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/core/base/mathematics.hpp"
#include "common/data/record/mcap_writer.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/sample.hpp"
#include "idl/topic_types.hpp"
#include "idl/topics.hpp"

namespace rodeira::replay {

// A whole recording without a run: what a recorder would have written of a launch text with sources that say `payload`.
struct MadeRecording {
  std::string launch_text;
  lockstep::Step last_step = 0;
  // The sample of a source valid at a step, as idl::Encode gives it: its header is written here. Empty: it is missing.
  std::function<base::Bytes(const lockstep::Source& source, lockstep::Step step)> payload;
  record::WriterSettings settings;
  std::optional<lockstep::Step> said_last_step = {};  // what the file says of its end, if that is not last_step
  // Which sample is written next; by default in the order of (step, source).
  std::function<void(std::vector<std::pair<lockstep::Step, lockstep::SourceIndex>>&)> reorder = {};
  // Further channels, before the end.
  std::function<void(record::McapWriter&)> more = {};
};

inline void Must(const base::Status& status) {
  if (!status) throw std::runtime_error(status.error().Text());
}
template <class T>
T Must(base::Result<T> result) {
  if (!result) throw std::runtime_error(result.error().Text());
  return std::move(result).value();
}

// A channel of one of Rodeira's topics, with its IDL.
inline record::ChannelId AddTopic(record::McapWriter& writer, std::string_view topic,
                                  const record::TextMap& metadata = {}) {
  const idl::TopicInfo* info = idl::FindTopic(topic);
  const record::SchemaId schema = Must(writer.AddSchema(info->type, "omgidl", idl::IdlTextOf(info->subject)));
  return Must(writer.AddChannel(topic, schema, "cdr", metadata));
}

inline void Make(const MadeRecording& spec, const std::filesystem::path& file) {
  const auto launch = Must(launch::Launch::Parse(spec.launch_text, "launch.yaml"));
  const lockstep::Roster& roster = launch.roster();
  record::WriterSettings settings = spec.settings;
  settings.overwrite = true;
  auto writer = Must(record::McapWriter::Open(file, settings));
  Must(writer.AddMetadata("rodeira", {{"launch_file", "launch.yaml"},
                                      {"roster_hash", base::Hex(roster.hash())},
                                      {"protocol_hash", base::Hex(idl::ProtocolHash())},
                                      {"mathematics_hash", base::Hex(base::MathLibraryFingerprint())}}));
  Must(writer.AddAttachment("launch.yaml", "application/yaml", std::as_bytes(std::span(spec.launch_text)), 0, 0));
  std::vector<record::ChannelId> channels;
  for (lockstep::SourceIndex s = 0; s < roster.sources().size(); ++s) {
    channels.push_back(AddTopic(writer, roster.source(s).topic, {{"source_number", std::to_string(s)}}));
  }
  std::vector<std::pair<lockstep::Step, lockstep::SourceIndex>> order;
  for (lockstep::Step step = 0; step <= spec.last_step; ++step) {
    for (lockstep::SourceIndex s = 0; s < channels.size(); ++s) {
      if (step % roster.source(s).period == 0) order.emplace_back(step, s);
    }
  }
  if (spec.reorder) spec.reorder(order);
  for (const auto& [step, source] : order) {
    base::Bytes payload = spec.payload(roster.source(source), step);
    if (payload.empty()) continue;
    lockstep::SampleHeader header;
    header.step = step;
    header.time_ns = step * roster.base_step_ns();
    header.source = source;
    header.Write(payload);
    const auto time_ns = static_cast<std::uint64_t>(header.time_ns);
    Must(writer.Write(channels[source], 0, time_ns, time_ns, payload));
  }
  if (spec.more) spec.more(writer);
  const lockstep::Step said = spec.said_last_step.value_or(spec.last_step);
  Must(writer.AddMetadata("rodeira.end", {{"last_step", std::to_string(said)}, {"complete", "true"}}));
  Must(writer.Close());
}

}  // namespace rodeira::replay
