// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/info_command.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string>

#include "common/core/base/print_error.hpp"
#include "common/core/base/printable.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/data/record/repair.hpp"
#include "common/data/record/sink.hpp"
#include "launch/rodeira/replay/recording_audit.hpp"
#include "launch/rodeira/replay/recording_text.hpp"

namespace rodeira::cli {
namespace {

void PrintWhatItIs(const record::McapReader& in, const std::string& file, bool is_being_written) {
  const auto& statistics = in.statistics();
  fmt::print("{}  {}, {}\n", file, Size(in.condition().file_bytes),
             is_being_written       ? "being written"
             : in.condition().whole ? "whole"
                                    : "not whole");
  fmt::print("time    {:.3f} s to {:.3f} s, {} samples in {} chunks\n",
             static_cast<double>(statistics.first_log_time_ns) * 1e-9,
             static_cast<double>(statistics.last_log_time_ns) * 1e-9, statistics.messages, statistics.chunks);
  for (const char* name : {"rodeira", "rodeira.meta", "rodeira.branch", "rodeira.end", record::kRepairMetadata}) {
    const auto metadata = in.FindMetadata(name);
    if (!metadata || !metadata.value()) continue;
    if (name == std::string_view(record::kRepairMetadata)) fmt::print("repaired:\n");
    for (const auto& [key, value] : metadata.value()->entries) fmt::print("{:<16}  {}\n", key, value);
  }
}

void PrintSources(const RecordingAudit& audit) {
  constexpr const char* kLine = "{:<24}  {:<10}  {:<28}  {:>8}  {:>9}  {:>10}  {}\n";
  fmt::print(kLine, "topic", "source", "type", "rate", "samples", "size", "audit");
  for (const RecordedSource& source : audit.sources) {
    const std::string rate = source.rate_hz ? fmt::format("{:g} Hz", *source.rate_hz) : "";
    fmt::print(kLine, source.topic, source.source, source.type, rate, source.samples, Size(source.bytes),
               source.Verdict());
  }
}

// "KEY=VALUE", where the attachment is a `--set` of the run.
std::optional<std::string> OverrideIn(const record::McapReader& in, const record::AttachmentInfo& info) {
  if (info.name != "override") return std::nullopt;
  const auto attachment = in.ReadAttachment(info);
  if (!attachment) return std::nullopt;
  const auto& data = attachment.value().data;
  return base::Printable({reinterpret_cast<const char*>(data.data()), data.size()});
}

void PrintWhatIsEmbedded(const record::McapReader& in) {
  std::set<std::string> schemas;
  for (const auto& [id, schema] : in.schemas()) schemas.insert(schema.name + " (" + schema.encoding + ")");
  for (const auto& attachment : in.attachments()) {
    if (const auto change = OverrideIn(in, attachment)) {
      fmt::print("embedded  {}  {}\n", attachment.name, *change);
      continue;
    }
    fmt::print("embedded  {}  {}, {}\n", attachment.name, Size(attachment.data_bytes), attachment.media_type);
  }
  for (const std::string& schema : schemas) fmt::print("embedded  {}\n", schema);
}

}  // namespace

int Info(const std::string& file) {
  const bool is_being_written = record::IsBeingWritten(file);
  const auto reader = record::McapReader::Open(file);
  if (!reader) return base::PrintError("rodeira", reader.error());
  const auto& in = reader.value();
  const RecordingAudit audit = Audit(in);
  PrintWhatItIs(in, file, is_being_written);
  PrintSources(audit);
  PrintWhatIsEmbedded(in);
  for (const RecordedSource& source : audit.sources) {
    if (source.without_state) fmt::print("{}", WithoutStateLine(source.source));
  }
  std::set<std::string> different;
  for (const RecordedSource& source : audit.sources) {
    if (source.type_difference.empty() || !different.insert(source.topic).second) continue;
    fmt::print("type      topic {} differs from this program's: {}\n", source.topic, source.type_difference);
  }
  fmt::print("content   {}  (of all samples: recordings with the same one are identical)\n", base::Hex(audit.content));
  if (is_being_written) {  // its end is not written yet, which is no damage
    fmt::print("being written: this is what it holds so far; ask again when the run has ended\n");
    return 1;
  }
  for (const std::string& damage : audit.damages) fmt::print("damage    {}\n", damage);
  if (audit.steps_without_wall_time.value_or(0) > 0) {
    fmt::print("wall      the wall times of {} steps are missing: a clock that was lost had not said them yet\n",
               *audit.steps_without_wall_time);
  }
  const bool whole = in.condition().whole && audit.damages.empty();
  if (!whole) fmt::print("what to do: rodeira repair {} --out REPAIRED.mcap\n", file);
  if (!audit.lossless()) {
    fmt::print("{}\n", audit.last_step && audit.has_every_sample() ? "damaged, though no source lacks a sample"
                                                                   : "not lossless: samples of the run are missing");
  } else if (whole && audit.broken_off) {
    fmt::print("no gaps; the run was cancelled at step {}\n", audit.last_step.value_or(0));
  } else if (whole && audit.last_step) {
    fmt::print("lossless: each source's samples are there once, from step 0 to step {}\n", *audit.last_step);
  } else if (whole) {
    fmt::print("no gaps; the end of the run is not in it\n");
  }
  return whole && audit.lossless() ? 0 : 1;
}

}  // namespace rodeira::cli
