// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::dds {

class NodeBus;

// Between the nodes that share a process: samples go from one to the others as they are, without DDS, and what one
// receiving thread does for all of them is known to each. Every node joins before the first one runs; from then on any
// thread may call it.
class LocalExchange {
 public:
  // `nodes`: those of this process. The roster outlives it.
  LocalExchange(const lockstep::Roster& roster, const std::vector<lockstep::NodeIndex>& nodes);

  // One of those nodes. The bus outlives all calls of Deliver.
  void Join(lockstep::NodeIndex node, NodeBus& bus);
  // Whether the node, or the source's node, runs in this process.
  bool Has(lockstep::NodeIndex node) const { return is_here_[node]; }
  bool HasSource(lockstep::SourceIndex source) const { return Has(roster_.source(source).node); }
  // To all nodes of the process that are wired to the sample's source, on the calling thread.
  void Deliver(const lockstep::Sample& sample) const;

  // Messages that receiving threads of the process have begun and done.
  std::atomic<std::uint64_t> messages_begun = 0;
  std::atomic<std::uint64_t> messages_done = 0;

 private:
  const lockstep::Roster& roster_;
  std::vector<bool> is_here_;                                // by node
  std::vector<NodeBus*> buses_;                              // by node; null: of another process
  std::vector<std::vector<lockstep::NodeIndex>> consumers_;  // by source
};

}  // namespace rodeira::dds
