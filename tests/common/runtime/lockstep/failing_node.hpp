// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "tests/common/runtime/lockstep/law.hpp"

namespace rodeira::lockstep {

// Publishes on its output and fails with an error at its activation in a step.
class FailingNode final : public Node {
 public:
  FailingNode(lockstep::Step at, base::Error error) : at_(at), error_(std::move(error)) {}

  base::Status Initialise(Outbox& outbox) override {
    outbox.Put("a", law::Payload(1));
    return {};
  }
  base::Status Step(const StepInfo& step, const Inbox&, Outbox& outbox) override {
    if (step.step == at_) return error_;
    outbox.Put("a", law::Payload(2));
    return {};
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

 private:
  lockstep::Step at_;
  base::Error error_;
};

}  // namespace rodeira::lockstep
