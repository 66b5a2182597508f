// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "common/runtime/lockstep/node.hpp"

namespace rodeira::cli {

// In a branch at step T: a node of the parent's that cannot save its state goes on itself. It has done its activation
// at T already, on the same samples and so with the same result: that one is said again, and only those behind it are
// computed.
class ContinuedNode final : public lockstep::Node {
 public:
  // Before the run: the node, which outlives this, and what it published at its activation at T.
  void Follow(lockstep::Node& node, std::vector<lockstep::Sample> published, const lockstep::Roster& roster);

  base::Status Initialise(lockstep::Outbox& outbox) override;
  base::Status Step(const lockstep::StepInfo& step, const lockstep::Inbox& inbox, lockstep::Outbox& outbox) override;
  void Save(base::StateWriter& out) const override;
  void Restore(base::StateReader& in) override;
  bool can_save() const override { return false; }

 private:
  lockstep::Node* node_ = nullptr;
  const lockstep::Roster* roster_ = nullptr;
  std::vector<lockstep::Sample> published_;  // empty behind T
};

}  // namespace rodeira::cli
