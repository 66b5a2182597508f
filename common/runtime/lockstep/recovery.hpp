// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/lockstep/report.hpp"
#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::lockstep {

// What becomes of a run of which a part has died or hangs.
enum class Policy {
  kStop,     // the run ends, its recording is closed
  kPause,    // time stands until the part goes on or a person decides, without any limit
  kRestart,  // the part is started again and computes again what it had computed: the same bits
};

// Where another incarnation than the first begins, by the grant that it hears: a node at its snapshot at `snapshot` (0:
// from its start, with all samples from there on), a recorder behind what its file holds (`has_through`), another sink
// where no node can be behind. A run that has not begun begins for all alike.
struct Beginning {
  Step snapshot = 0;
  Step sink_from = 0;
};
// `has_through` counts for recorders alone.
Beginning BeginningOf(const Roster& roster, NodeIndex node, const Grant& grant, Step has_through);

// Says how a run goes on after the loss of a node, and from where. Pure logic for the clock.
//
// A node goes on from its snapshot at resume(): the newest step of which the recorder says that everything valid up to
// then, and all that a node publishes ahead of it, lies in its file (`safe`). So two losses at once lose nothing: what
// lies behind is still with its producers, or they compute it again.
class Recovery {
 public:
  // policies: one for each node, or empty (all kStop).
  Recovery(const Roster& roster, std::vector<Policy> policies);

  // Of a node of the roster.
  Policy policy(NodeIndex node) const { return policies_[node]; }
  // A node may be started again, by policy or by a person, and there is a recorder: nodes keep what it could lose.
  bool restarts() const { return restarts_; }

  // Wrong input: the node is to be started again, and says that it cannot save its state. There is no snapshot to begin
  // at, and no node keeps the samples of a whole run, to compute it again from its first step.
  base::Status CheckState(const Report& report) const;
  // Takes from it whether a node that was started again is back, and of a recorder what its file holds.
  void Heard(const Report& report);
  // For the grant: kNever where no node is started again.
  Step safe() const { return restarts_ ? safe_ : kNever; }
  Step resume() const;
  // The same where `granted` is the last granted step: not behind the first activation of a sink that keeps no
  // snapshots and is started again (BeginningOf), for it needs samples of nodes that may be lost with it.
  Step ResumeAt(Step granted) const;

  // What is done about a loss.
  struct Decision {
    Policy policy = Policy::kStop;
    std::string why;  // of a stop that the policy did not ask for
  };
  // The node was lost before its activation at `progress`, a server when the run was there. A node that is lost four
  // times without having got further than before will be lost there every time.
  Decision Lost(NodeIndex node, Step progress);
  // For a clock that takes the place of a lost one, once it knows what was granted: what any node may still need is
  // kept until the node has come as far as the grant. `reports`: one of each node.
  void InitialiseFrom(const std::vector<Report>& reports, Step granted);

 private:
  struct Incarnation {
    Step farthest = -1;  // where it was lost
    int times = 0;       // lost at or before that step
    bool back = true;    // it has come that far again
    Step resume = 0;     // where it was sent to
  };
  Step Newest() const;

  const Roster& roster_;
  std::vector<Policy> policies_;
  bool restarts_ = false;
  bool has_other_sinks_ = false;  // beside those that keep snapshots
  Step every_ = 0;                // steps between snapshots; 0: there are none
  Step ahead_ = 0;                // the longest delay
  Step safe_ = -1;
  std::vector<Step> safe_of_;  // by node, of those that keep snapshots
  std::vector<Incarnation> incarnations_;
};

}  // namespace rodeira::lockstep
