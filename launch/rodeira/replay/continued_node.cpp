// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/continued_node.hpp"

#include <utility>

#include "common/core/base/assert.hpp"

namespace rodeira::cli {

void ContinuedNode::Follow(lockstep::Node& node, std::vector<lockstep::Sample> published,
                           const lockstep::Roster& roster) {
  RODEIRA_ASSERT(!published.empty());
  node_ = &node;
  roster_ = &roster;
  published_ = std::move(published);
}

base::Status ContinuedNode::Initialise(lockstep::Outbox&) {
  RODEIRA_ASSERT(false && "a node goes on behind its beginning");
}

base::Status ContinuedNode::Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox,
                                 lockstep::Outbox& outbox) {
  if (published_.empty()) return node_->Step(step, inbox, outbox);
  for (const lockstep::Sample& sample : std::exchange(published_, {}))
    outbox.Put(roster_->source(sample.source()).topic, *sample.payload);
  return {};
}

void ContinuedNode::Save(base::StateWriter& out) const { node_->Save(out); }
void ContinuedNode::Restore(base::StateReader&) { RODEIRA_ASSERT(false && "its state cannot be saved"); }

}  // namespace rodeira::cli
