// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/stepped_run.hpp"
#include "common/world/road/kept_world.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "nodes/input/agent_source.hpp"

namespace rodeira::cli {

// The run of a launch file in one process, again and again, with an agent outside in place of an input node. Between
// two calls the run stands at an activation of that node, which is not done yet.
class AgentRun {
 public:
  // `agent`: the input node. Views are left out. Wrong input where the launch file is wrong or has no such node.
  static base::Result<std::unique_ptr<AgentRun>> Make(const std::string& launch_file, const launch::Overrides& set,
                                                      const std::string& agent);

  const launch::Launch& launch() const { return *launch_; }
  lockstep::NodeIndex agent() const { return agent_; }
  // Whether observations hold all samples of a topic since the last one, and not the newest alone.
  bool IsEventTopic(std::string_view topic) const;

  // Ends the episode and begins another one, at step 0. seed: none: that of the episode before. record: a new file;
  // empty: no recording. After an error there is no episode.
  base::Status Reset(std::optional<std::uint64_t> seed, const std::string& record);
  // One period of the agent's node with these controls, which are in effect one delay of the node later. After an error
  // there is no episode. Precondition: has_episode().
  base::Status Advance(const nodes::AgentControls& controls);
  // Ends the episode: its recording is whole then. Precondition: has_episode().
  base::Status Finish();

  bool has_episode() const { return run_ != nullptr; }
  lockstep::Step step() const { return step_; }
  std::uint64_t seed() const { return seed_; }
  // Of all samples of the episode so far. Precondition: has_episode().
  base::Digest digest() const { return run_->digest(); }
  // Of each source the newest sample that is valid now; of event topics those of the last period. By source, then by
  // step.
  std::vector<lockstep::Sample> Observation() const;

 private:
  // Nodes of one seed, made for one recording or for many episodes without one.
  struct SeedNodes {
    std::unique_ptr<launch::Launch> launch;
    std::unique_ptr<LocalNodes> nodes;
    std::vector<lockstep::Snapshot> beginning;  // empty: its nodes can be used once
  };

  AgentRun() = default;
  base::Status KeepWorld();
  base::Result<SeedNodes> MakeSeedNodes(std::uint64_t seed, const std::string& record);
  base::Status Begin(SeedNodes& seed_nodes);
  base::Status BeginAgain(SeedNodes& seed_nodes);
  void DropEpisode();
  void Take(const lockstep::Sample& sample);
  void ForgetSamples();

  std::string launch_file_;
  launch::Overrides overrides_;
  std::unique_ptr<launch::Launch> launch_;
  lockstep::NodeIndex agent_ = 0;
  std::shared_ptr<nodes::AgentControls> wanted_ = std::make_shared<nodes::AgentControls>();
  std::unique_ptr<const road::KeptWorld> world_;  // its files are read once; null: the run has none
  std::uint64_t seed_ = 0;
  std::optional<SeedNodes> seed_nodes_;        // without a recording, of `seed_`
  std::optional<SeedNodes> recorded_;          // of the episode that is recorded
  std::unique_ptr<lockstep::SteppedRun> run_;  // behind the nodes that it uses
  lockstep::Step step_ = 0;
  std::vector<std::deque<lockstep::Sample>> samples_;  // by source
};

}  // namespace rodeira::cli
