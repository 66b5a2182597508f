// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/kept_samples.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

// All samples and snapshots since the one from which a lost node would go on (recovery.hpp), whether they lie in a file
// yet or not: a node that is started again asks for its state and for its inputs, and the recorder answers from here.
// One thread at a time.
class Archive {
 public:
  // The roster outlives it.
  explicit Archive(const Roster& roster) : roster_(roster), samples_(roster.sources().size()) {}

  // In any order, twice too. Wrong input where another sample of the source is valid at the same step.
  base::Status Add(const Sample& sample);
  // Drops what no node can ask for that goes on from a snapshot at or after `resume`.
  void Forget(Step resume);
  // As KeptSamples::From; ends before the first sample that is missing, so that no hole looks like the data.
  std::vector<Sample> From(const Gap& gap) const;
  std::size_t size() const;

 private:
  const Roster& roster_;
  std::vector<std::map<Step, Sample>> samples_;  // by source
  Step resume_ = 0;
};

}  // namespace rodeira::lockstep
