// SPDX-License-Identifier: Apache-2.0
#include "nodes/recorder/written_samples.hpp"

#include <algorithm>
#include <string>

namespace rodeira::nodes {

using lockstep::Step;

WrittenSamples::WrittenSamples(const lockstep::Roster& roster, lockstep::NodeIndex recorder) {
  for (const lockstep::Port& port : roster.node(recorder).inputs) {
    for (const lockstep::SourceIndex source : port.sources) lines_.push_back({source, roster.source(source).period, 0});
  }
}

void WrittenSamples::BeginBehind(Step step, lockstep::SourceIndex source) {
  for (Line& line : lines_) line.next = lockstep::CeilTo(line.source <= source ? step + 1 : step, line.period);
}

void WrittenSamples::Note(Step valid, lockstep::SourceIndex source) {
  const auto line = std::find_if(lines_.begin(), lines_.end(), [&](const Line& each) { return each.source == source; });
  if (line == lines_.end()) return;
  if (valid > line->next) missing_ += static_cast<std::uint64_t>((valid - line->next) / line->period);
  line->next = std::max(line->next, valid + line->period);
}

record::TextMap WrittenSamples::Entries(Step last_step) const {
  std::uint64_t samples = 0, missing = missing_;
  for (const Line& line : lines_) {
    samples += static_cast<std::uint64_t>(line.next / line.period);
    if (line.next <= last_step) missing += static_cast<std::uint64_t>((last_step - line.next) / line.period + 1);
  }
  return {{"samples", std::to_string(samples - missing_)},
          {"sources", std::to_string(lines_.size())},
          {"missing", std::to_string(missing)}};
}

}  // namespace rodeira::nodes
