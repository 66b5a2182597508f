// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/replay/comparison.hpp"
#include "common/runtime/replay/recorded_run.hpp"

namespace rodeira::cli {

// What is branched off, where, and with which changes.
struct BranchSpec {
  std::string parent;                       // recording
  lockstep::Step at = 0;                    // base steps: where the branch leaves its parent
  launch::Overrides changes;                // of the launch file
  std::optional<lockstep::Step> last_step;  // none: the parent's
  std::string recording;                    // the new file
  std::function<bool()> stop_requested =
      {};                  // it fails then, and there is no new file; driven by a person, it ends there
  bool with_view = false;  // the launch file's view shows the branch as it is driven; otherwise it is not drawn
  double pace = 0.0;       // of the branch behind T, as Pacer: 0 as fast as possible, 1 real time
  std::function<std::optional<lockstep::OperatorCommand>()> next_command =
      {};                            // of an operator, for the branch behind T
  launch::Overrides libraries = {};  // nodes.NAME.library, of external nodes
};

// What came of a branch.
struct BranchOutcome {
  lockstep::Step recomputed_from = 0;
  lockstep::Step at = 0;
  lockstep::Step last_step = 0;
  std::vector<std::string> live;                 // nodes that a person drove
  std::vector<std::string> without_state;        // cannot save it: the parent was computed again from its first step
  std::vector<std::string> taken_over;           // nodes with models that began from what the parent had published
  std::string recorded_by_another;               // as RecordedByAnother, of the parent
  std::optional<replay::Difference> difference;  // the parent could not be repeated: there is no branch then
};

// A run that is its parent up to a step and goes on with other settings from there (X4). The parent's nodes are
// computed again from the snapshot before that step, every sample compared; then each node goes on with the changed
// configuration from its state, or, where that does not fit another model, from what the parent had published
// (Node::InitialiseFrom). Samples valid up to the step are the parent's. A node that cannot save its state goes on
// itself, where the changes name neither it nor the world; then it begins from what the parent had published. A node
// that takes live input (a wheel, a keyboard) is driven by a person where the changes name it, `nodes.NAME.…`;
// otherwise by its recorded samples. Wrong input: a step outside the run or between two activations of a node, changes
// that change the roster, a view where there is none.
base::Result<BranchOutcome> Branch(const BranchSpec& spec);
// The nodes that a person drives in a branch.
struct LiveDrivers {
  std::vector<std::string> names;
  bool by_device = false;  // one of them by a wheel or a game pad
};
// The nodes that a person would drive, without computing anything.
base::Result<LiveDrivers> DrivenLive(const BranchSpec& spec);

}  // namespace rodeira::cli
