// SPDX-License-Identifier: Apache-2.0
#include "common/data/record/audit.hpp"

#include <algorithm>

namespace rodeira::record {
namespace {

constexpr std::size_t kMaxGaps = 100;

}  // namespace

void StepAudit::Declare(const std::string& topic, std::uint64_t source, std::uint64_t period_steps) {
  tracks_[{topic, source}].declared = period_steps;
}

void StepAudit::Add(const std::string& topic, std::uint64_t source, std::uint64_t step) {
  Track& track = tracks_[{topic, source}];
  if (track.count++ == 0) {
    track.first = track.last = step;
    return;
  }
  if (step == track.last) {
    ++track.repeated;
  } else if (step < track.last) {
    ++track.backward;
  } else {
    const std::uint64_t distance = step - track.last;
    ++track.distances[distance];
    auto& places = track.examples[distance];
    if (places.size() < kMaxGaps) places.push_back({track.last, step});
    track.last = step;
  }
}

std::map<StepAudit::Key, SourceAudit> StepAudit::Finish() const {
  std::map<Key, SourceAudit> audits;
  for (const auto& [key, track] : tracks_) {
    SourceAudit audit;
    audit.first_step = track.first;
    audit.last_step = track.last;
    audit.count = track.count;
    audit.repeated = track.repeated;
    audit.backward = track.backward;
    audit.period_steps = track.declared;
    if (audit.period_steps == 0 && !track.distances.empty()) audit.period_steps = track.distances.begin()->first;
    for (const auto& [distance, times] : track.distances) {
      if (distance == audit.period_steps) continue;
      audit.missing += times * ((distance - 1) / audit.period_steps);  // ⌈distance / period⌉ − 1 of each
      const auto& places = track.examples.at(distance);
      audit.gaps.insert(audit.gaps.end(), places.begin(), places.end());
    }
    std::ranges::sort(audit.gaps, {}, &StepGap::after_step);  // no ties: each step is left forward once
    if (audit.gaps.size() > kMaxGaps) audit.gaps.resize(kMaxGaps);
    audits.emplace(key, std::move(audit));
  }
  return audits;
}

}  // namespace rodeira::record
