// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/kept_samples.hpp"

#include <algorithm>

#include "common/core/base/assert.hpp"

namespace rodeira::lockstep {

KeptSamples::KeptSamples(const Roster& roster, NodeIndex node) : roster_(roster), outputs_(roster.node(node).outputs) {
  if (const auto& snapshots = roster.node(node).snapshots) outputs_.push_back(*snapshots);
  samples_.resize(outputs_.size());
}

void KeptSamples::Add(const Sample& sample) {
  const auto output = std::find(outputs_.begin(), outputs_.end(), sample.source());
  RODEIRA_ASSERT(output != outputs_.end());
  auto& kept = samples_[static_cast<std::size_t>(output - outputs_.begin())];
  if (kept.empty() || kept.back().valid() < sample.valid()) kept.push_back(sample);
}

void KeptSamples::Granted(const Grant& grant) {
  const Step slowest = std::min(grant.through - roster_.window(), grant.safe == kNever ? kNever : grant.safe + 1);
  if (slowest <= 0) return;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Step oldest = roster_.OldestNeeded(outputs_[i], slowest);
    while (!samples_[i].empty() && samples_[i].front().valid() < oldest) samples_[i].pop_front();
  }
}

std::vector<Sample> KeptSamples::From(const Gap& gap) const {
  const auto output = std::find(outputs_.begin(), outputs_.end(), gap.source);
  if (output == outputs_.end()) return {};
  const auto& kept = samples_[static_cast<std::size_t>(output - outputs_.begin())];
  const auto first = std::lower_bound(kept.begin(), kept.end(), gap.from,
                                      [](const Sample& sample, Step step) { return sample.valid() < step; });
  return {first, first + std::min<std::ptrdiff_t>(kAtATime, kept.end() - first)};
}

bool KeptSamples::Has(SourceIndex source) const {
  return std::find(outputs_.begin(), outputs_.end(), source) != outputs_.end();
}

std::size_t KeptSamples::size() const {
  std::size_t size = 0;
  for (const auto& kept : samples_) size += kept.size();
  return size;
}

}  // namespace rodeira::lockstep
