// SPDX-License-Identifier: Apache-2.0
#include "common/data/csv/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rodeira::csv {
namespace {

constexpr double kNsPerSecond = 1e9;
constexpr double kLatestNs = 9.2e18;  // what 64 bits with a sign hold
constexpr std::string_view kOwnTopics = "rodeira/";

bool IsColumn(Slot::Use use) {
  return use == Slot::Use::kCell || use == Slot::Use::kRowCell || use == Slot::Use::kList || use == Slot::Use::kRowList;
}

std::uint64_t Nanoseconds(double seconds) {
  return static_cast<std::uint64_t>(std::llround(std::clamp(seconds * kNsPerSecond, 0.0, kLatestNs)));
}

std::string WithoutIndexes(std::string_view column) {
  std::string text;
  bool within = false;
  for (const char c : column) {
    if (c == '[') within = true;
    if (!within) text += c;
    if (c == ']') within = false;
  }
  return text;
}

bool IsGroup(std::string_view name, std::string_view column) {
  if (!column.starts_with(name)) return false;
  const std::string_view rest = column.substr(name.size());
  return rest.empty() || rest[0] == '.' || rest[0] == '[';
}

}  // namespace

base::Result<record::Query> TimesOf(const Selection& selection, const record::McapReader& reader) {
  record::Query query;
  if (selection.from_s) query.from_ns = Nanoseconds(*selection.from_s);
  const std::uint64_t end_ns = selection.to_s ? Nanoseconds(*selection.to_s) : query.through_ns;
  if (selection.to_s && end_ns <= query.from_ns) {
    return base::WrongInput(
        "command.wrong_value",
        fmt::format("{} s was found; a time after {} s was expected", *selection.to_s, selection.from_s.value_or(0.0)),
        "--to");
  }
  const std::uint64_t last_ns = reader.statistics().last_log_time_ns;
  if (query.from_ns > last_ns) {
    return base::WrongInput("replay.outside_of_run",
                            fmt::format("{} s was found, but the recording ends at {:.3f} s", *selection.from_s,
                                        static_cast<double>(last_ns) / kNsPerSecond),
                            "--from");
  }
  if (selection.to_s) query.through_ns = end_ns - 1;
  return query;
}

bool Holds(const Selection& selection, double time_s) {
  const std::uint64_t time_ns = Nanoseconds(time_s);
  return (!selection.from_s || time_ns >= Nanoseconds(*selection.from_s)) &&
         (!selection.to_s || time_ns < Nanoseconds(*selection.to_s));
}

std::string_view ShortTopic(std::string_view topic) {
  if (topic.starts_with(kOwnTopics)) topic.remove_prefix(kOwnTopics.size());
  return topic;
}

bool HasTopic(const std::vector<std::string>& names, std::string_view topic) {
  return std::ranges::any_of(names, [&](const std::string& name) { return ShortTopic(name) == ShortTopic(topic); });
}

bool Names(std::string_view name, std::string_view column) {
  return !name.empty() && (IsGroup(name, column) || IsGroup(name, WithoutIndexes(column)));
}

std::size_t KeepColumns(const std::vector<std::string>& names, Layout& layout) {
  std::size_t kept = 0;
  for (Slot& slot : layout.slots) {
    if (!IsColumn(slot.use)) continue;
    const bool keep =
        names.empty() || std::ranges::any_of(names, [&](const std::string& name) { return Names(name, slot.name); });
    if (keep) {
      ++kept;
    } else {
      slot.use = Slot::Use::kDropped;
    }
  }
  layout.writes_digest =
      layout.has_header && (names.empty() || std::ranges::find(names, "state_digest") != names.end());
  return kept + (layout.writes_digest && !names.empty() ? 1 : 0);
}

std::vector<std::string> ColumnsOf(const Layout& layout) {
  std::vector<std::string> names;
  for (const Slot& slot : layout.slots) {
    if (IsColumn(slot.use)) names.push_back(slot.name);
  }
  if (layout.has_header) names.emplace_back("state_digest");
  return names;
}

bool Thinning::Keeps(std::uint64_t time_ns) {
  const auto interval = static_cast<std::uint64_t>(static_cast<double>(time_ns) / (kNsPerSecond / rate_hz_));
  if (last_ == interval) return false;
  last_ = interval;
  return true;
}

}  // namespace rodeira::csv
