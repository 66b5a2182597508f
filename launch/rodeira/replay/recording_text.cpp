// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/recording_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/core/base/version.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "nodes/recorder/program.hpp"

namespace rodeira::cli {
namespace {

// The time of the last sample of the lockstep, s; 0 where there is none.
double LastSample(const record::McapReader& reader) {
  record::Query end;
  const std::uint64_t last_ns = reader.statistics().last_log_time_ns;
  end.from_ns =
      last_ns - std::min<std::uint64_t>(last_ns, 2'000'000'000);  // remarks may lie behind it, but not by much
  end.channels.emplace();
  for (const auto& [id, channel] : reader.channels()) {
    if (channel.metadata.contains("source_number")) end.channels->insert(id);
  }
  std::uint64_t time_ns = 0;
  auto cursor = reader.Messages(end);
  for (auto message = cursor.Next(); message && message.value(); message = cursor.Next())
    time_ns = std::max(time_ns, message.value()->log_time_ns);
  return static_cast<double>(time_ns) * 1e-9;
}

// What the recorder counted.
std::string AuditLine(const record::McapReader& reader) {
  const auto end = reader.FindMetadata("rodeira.end");
  if (!end || !end.value()) return "";
  record::TextMap entries = end.value()->entries;
  if (!entries.contains("missing")) return "";
  if (entries["missing"] == "0")
    return fmt::format("audit   lossless: {} samples of {} sources\n", entries["samples"], entries["sources"]);
  return fmt::format("audit   {} samples are missing; rodeira info says which\n", entries["missing"]);
}

}  // namespace

std::string Size(std::uint64_t bytes) {
  const auto size = static_cast<double>(bytes);
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1'000'000) return fmt::format("{:.1f} kB", size * 1e-3);
  if (bytes < 1'000'000'000) return fmt::format("{:.1f} MB", size * 1e-6);
  return fmt::format("{:.2f} GB", size * 1e-9);
}

std::string WrittenFile(const std::string& recording, double reached_s) {
  std::error_code problem;
  if (recording.empty()) return {};
  if (!std::filesystem::exists(recording, problem)) {
    return fmt::format("lost    {}: no such file: it was removed, or not even begun\n", recording);
  }
  std::string text = fmt::format("wrote   {} ({})\n", recording, Size(std::filesystem::file_size(recording, problem)));
  if (!std::filesystem::is_regular_file(recording, problem)) return text;
  const auto reader = record::McapReader::Open(recording);
  if (!reader) {
    const bool is_unknown = reader.error().code == base::ErrorCode::kFailed;
    return text + fmt::format("{}{}\n", is_unknown ? "audit   not made: " : "lost    ", reader.error().Text());
  }
  if (reader.value().condition().whole) return text + AuditLine(reader.value());
  return text +
         fmt::format(
             "lost    its end: it holds {:.3f} s of {:.3f} s; what to do: rodeira repair {} --out REPAIRED.mcap\n",
             LastSample(reader.value()), reached_s, recording);
}

std::string WithoutStateLine(const std::string& node) {
  return fmt::format(
      "state   node '{}' cannot save its state: replayed from the first step, and not to be started again\n", node);
}

std::string ComputedFromTheStart(const std::vector<std::string>& nodes) {
  std::string text;
  for (const std::string& node : nodes)
    text += fmt::format("node '{}' cannot save its state: all is computed again from step 0\n", node);
  return text;
}

std::string RecordedByAnother(const std::string& version, const std::string& commit) {
  if (version == base::Version() && commit == nodes::ProgramCommit()) return {};
  return fmt::format(
      "recorded by another program (version {}, commit {}; this one is version {}, commit {}): other sources may give "
      "other bits\n",
      version, commit, base::Version(), nodes::ProgramCommit());
}

}  // namespace rodeira::cli
