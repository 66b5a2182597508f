// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/local_exchange.hpp"

#include "common/core/base/assert.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/lockstep/in_process_parts.hpp"

namespace rodeira::dds {

LocalExchange::LocalExchange(const lockstep::Roster& roster, const std::vector<lockstep::NodeIndex>& nodes)
    : roster_(roster),
      is_here_(roster.nodes().size(), false),
      buses_(roster.nodes().size(), nullptr),
      consumers_(lockstep::ConsumersOf(roster)) {
  for (const lockstep::NodeIndex node : nodes) is_here_[node] = true;
}

void LocalExchange::Join(lockstep::NodeIndex node, NodeBus& bus) {
  RODEIRA_ASSERT(Has(node));
  buses_[node] = &bus;
}

void LocalExchange::Deliver(const lockstep::Sample& sample) const {
  for (const lockstep::NodeIndex node : consumers_[sample.source()]) {
    if (buses_[node] != nullptr) buses_[node]->TakeLocal(sample);
  }
}

}  // namespace rodeira::dds
