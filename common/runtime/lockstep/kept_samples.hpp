// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/runtime/lockstep/mailbox.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/ring.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

// A node's own samples that a consumer may still ask for. No acknowledgement is needed to know which: time is granted
// at most a window beyond the slowest node (law L2), so what no node at `through` − window can need any more has been
// seen by all. One thread at a time.
class KeptSamples {
 public:
  // Of this node's sources. The roster outlives it.
  KeptSamples(const Roster& roster, NodeIndex node);

  // Precondition: of a source of this node. A sample that is not newer than the source's newest one changes nothing.
  void Add(const Sample& sample);
  // Drops what no consumer can ask for once `grant` is said, not even a recorder that is started again.
  void Granted(const Grant& grant);
  // The samples of gap.source valid at or after gap.from, oldest first, at most kAtATime: a node that lacks more asks
  // again. None where the source is another node's.
  static constexpr std::size_t kAtATime = 64;
  std::vector<Sample> From(const Gap& gap) const;
  // Whether it is the node's own.
  bool Has(SourceIndex source) const;
  std::size_t size() const;

 private:
  const Roster& roster_;
  std::vector<SourceIndex> outputs_;
  std::vector<Ring<Sample>> samples_;  // of each output, by step
};

}  // namespace rodeira::lockstep
