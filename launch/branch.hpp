#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/launch/launch.hpp"
#include "common/lockstep/in_process.hpp"
#include "common/replay/comparison.hpp"
#include "common/replay/recorded_run.hpp"

namespace rodeira::front {

struct BranchWish {
  std::string parent;               // recording
  lockstep::Step at = 0;            // base steps: where the branch leaves its parent
  launch::Overrides changes;        // of the launch file
  std::optional<lockstep::Step> last_step;  // none: the parent's
  std::string recording;            // the new file
  std::function<bool()> stop_requested = {};  // it fails then, and there is no new file
};

struct BranchOutcome {
  lockstep::Step recomputed_from = 0;
  lockstep::Step at = 0;
  lockstep::Step last_step = 0;
  std::vector<std::string> taken_over;  // nodes whose model began from what the parent had published
  std::optional<replay::Difference> difference;  // the parent could not be repeated: there is no branch then
};

// A run that is its parent up to a step and goes on with other settings from there (X4). The parent's nodes are computed
// again from the snapshot before that step, every sample compared; then each node goes on with the changed configuration
// from its state, or, where that does not fit another model, from what the parent had published (Node::TakeOver). Samples
// valid up to the step are the parent's. Wrong input: a step outside the run or between two activations of a node,
// changes that change the roster.
base::Result<BranchOutcome> Branch(const BranchWish& wish);

}  // namespace rodeira::front
