// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "common/data/record/mcap_types.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::nodes {

// The audit of a recording while it is written: of each source one sample a period, in order, from step 0 on.
class WrittenSamples {
 public:
  // Of the sources that node `recorder` hears.
  WrittenSamples(const lockstep::Roster& roster, lockstep::NodeIndex recorder);

  // An earlier incarnation has written everything up to here, in the order of (step, source).
  void BeginBehind(lockstep::Step step, lockstep::SourceIndex source);
  // The sample has been written.
  void Note(lockstep::Step valid, lockstep::SourceIndex source);
  // What the file says at its end: how many `samples` of how many `sources` are in it, those of an earlier incarnation
  // among them, and how many are `missing` of a run that ended at `last_step`.
  record::TextMap Entries(lockstep::Step last_step) const;

 private:
  struct Line {
    lockstep::SourceIndex source = 0;
    lockstep::Step period = 1;
    lockstep::Step next = 0;  // valid step of the sample that comes next
  };
  std::vector<Line> lines_;
  std::uint64_t missing_ = 0;  // before the lines' next ones
};

}  // namespace rodeira::nodes
