// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/base/result.hpp"
#include "common/core/base/state.hpp"
#include "common/runtime/lockstep/inbox.hpp"
#include "common/runtime/lockstep/step.hpp"
#include "common/vehicle/dynamics/controls.hpp"
#include "common/vehicle/input_devices/signals.hpp"

namespace rodeira::nodes {

// Where the controls come from: a script, an autopilot, a wheel.
class Source {
 public:
  virtual ~Source() = default;
  // The controls valid at time zero, before anything is seen.
  virtual dynamics::Controls First() = 0;
  // The controls for the time `valid_ns` at which they will be valid, from what is seen now.
  virtual base::Result<dynamics::Controls> Step(const lockstep::StepInfo& step, std::int64_t valid_ns,
                                                const lockstep::Inbox& inbox) = 0;
  // Lamps and horn that go with the controls of the last First or Step.
  virtual input_devices::Signals signals() const { return {}; }
  // May be asked on any thread, one at a time, and soon has its answer.
  virtual bool runs_inline() const { return true; }
  virtual void Save(base::StateWriter& out) const = 0;
  virtual void Restore(base::StateReader& in) = 0;
  // In place of First(): goes on where another source has left hands, feet and levers.
  virtual void InitialiseFrom(const dynamics::Controls& last, const input_devices::Signals& signals) = 0;
};

}  // namespace rodeira::nodes
