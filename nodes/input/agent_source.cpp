// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/agent_source.hpp"

#include <utility>

namespace rodeira::nodes {
namespace {

class AgentSource final : public Source {
 public:
  explicit AgentSource(std::shared_ptr<const AgentControls> wanted) : wanted_(std::move(wanted)) {}
  dynamics::Controls First() override { return dynamics::Clamp(wanted_->controls); }
  base::Result<dynamics::Controls> Step(const lockstep::StepInfo&, std::int64_t, const lockstep::Inbox&) override {
    return dynamics::Clamp(wanted_->controls);
  }
  input_devices::Signals signals() const override { return wanted_->signals; }
  void Save(base::StateWriter&) const override {}  // the agent is outside
  void Restore(base::StateReader&) override {}
  void InitialiseFrom(const dynamics::Controls&, const input_devices::Signals&) override {}

 private:
  std::shared_ptr<const AgentControls> wanted_;
};

}  // namespace

std::unique_ptr<Source> MakeAgentSource(std::shared_ptr<const AgentControls> wanted) {
  return std::make_unique<AgentSource>(std::move(wanted));
}

}  // namespace rodeira::nodes
