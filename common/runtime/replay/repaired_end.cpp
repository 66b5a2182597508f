// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/replay/repaired_end.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "common/data/record/text_number.hpp"

namespace rodeira::replay {
using lockstep::Step;

void RepairedEnd::Begin(const std::map<record::ChannelId, record::Channel>& channels) {
  for (const auto& [id, channel] : channels) {
    const auto period = record::WholeNumber(channel.metadata, "period_steps");
    if (period && *period > 0 && *period <= std::numeric_limits<std::uint32_t>::max()) lines_[id] = {*period, 0};
  }
}

// A sample's sequence is its valid step in periods.
void RepairedEnd::Keep(const record::Channel& channel, const record::Message& message) {
  const auto line = lines_.find(channel.id);
  if (line == lines_.end()) return;
  const Step valid = static_cast<Step>(message.sequence) * line->second.period;
  if (valid == line->second.next) line->second.next += line->second.period;
}

record::TextMap RepairedEnd::Entries(const record::TextMap& found) const {
  if (lines_.empty()) return found;
  Step last = std::numeric_limits<Step>::max();
  for (const auto& [id, line] : lines_) last = std::min(last, line.next - 1);
  if (last < 0) return {};
  const auto said = record::WholeNumber(found, "last_step");
  if (said && *said >= 0 && *said <= last) return found;
  record::TextMap entries{{"log_complete", "false"}};
  entries["last_step"] = std::to_string(last);
  entries["complete"] = "false";
  return entries;
}

}  // namespace rodeira::replay
