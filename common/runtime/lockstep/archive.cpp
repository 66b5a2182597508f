// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/archive.hpp"

#include <fmt/format.h>

namespace rodeira::lockstep {

base::Status Archive::Add(const Sample& sample) {
  if (sample.source() >= samples_.size())
    return base::WrongInput("run.wrong_sample", fmt::format("a sample of source number {} was found", sample.source()));
  if (sample.valid() < roster_.OldestNeeded(sample.source(), resume_)) return {};
  const auto [kept, is_new] = samples_[sample.source()].try_emplace(sample.valid(), sample);
  if (is_new || SameContent(kept->second, sample)) return {};
  return base::WrongInput("run.two_samples", fmt::format("two different samples are valid at step {}", sample.valid()),
                          roster_.SourceName(sample.source()));
}

void Archive::Forget(Step resume) {
  if (resume <= resume_) return;
  resume_ = resume;
  for (SourceIndex source = 0; source < samples_.size(); ++source) {
    auto& kept = samples_[source];
    kept.erase(kept.begin(), kept.lower_bound(roster_.OldestNeeded(source, resume)));
  }
}

std::vector<Sample> Archive::From(const Gap& gap) const {
  std::vector<Sample> found;
  if (gap.source >= samples_.size()) return found;
  const auto& kept = samples_[gap.source];
  const Step period = roster_.source(gap.source).period;
  Step expected = CeilTo(gap.from, period);
  for (auto it = kept.lower_bound(expected);
       it != kept.end() && it->first == expected && found.size() < KeptSamples::kAtATime; ++it) {
    found.push_back(it->second);
    expected += period;
  }
  return found;
}

std::size_t Archive::size() const {
  std::size_t size = 0;
  for (const auto& kept : samples_) size += kept.size();
  return size;
}

}  // namespace rodeira::lockstep
