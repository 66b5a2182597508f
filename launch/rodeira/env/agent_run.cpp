// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/env/agent_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "common/core/base/log.hpp"
#include "common/core/base/suggest.hpp"
#include "common/runtime/replay/recorded_node.hpp"
#include "launch/rodeira/files_from_here.hpp"
#include "launch/rodeira/input_files.hpp"
#include "launch/rodeira/named_inputs.hpp"
#include "launch/rodeira/run/launch_path.hpp"
#include "launch/rodeira/run/resolve_recording.hpp"
#include "nodes/input/input_node.hpp"

namespace rodeira::cli {
namespace {

using lockstep::NodeIndex;
using lockstep::Sample;
using lockstep::Step;

base::Status CheckAgent(const launch::Launch& launch, const std::string& agent) {
  std::vector<std::string> inputs;
  std::string kind;
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name == "input") inputs.push_back(node.name);
    if (node.name == agent) kind = node.kind->name;
  }
  if (kind == "input") return {};
  const std::string what =
      kind.empty() ? fmt::format("no node '{}' was found; a node of kind 'input' was expected", agent)
                   : fmt::format("node '{}' is of kind '{}'; a node of kind 'input' was expected", agent, kind);
  return base::WrongInput("launch.no_agent_node", what + base::DidYouMean(agent, inputs), launch.path().string());
}

bool HasRecorder(const launch::Launch& launch) {
  return std::ranges::any_of(launch.nodes(),
                             [](const launch::LaunchNode& node) { return node.kind->name == "recorder"; });
}

// Restore is made for new nodes. Those of Rodeira take it again; what others do is not known.
bool CanBeginAgain(const launch::Launch& launch, const LocalNodes& nodes) {
  for (NodeIndex n = 0; n < nodes.nodes().size(); ++n) {
    if (launch.node(n).is_external() || (nodes.nodes()[n] != nullptr && !nodes.nodes()[n]->can_save())) return false;
  }
  return true;
}

bool SameStates(const std::vector<lockstep::Snapshot>& a, const std::vector<lockstep::Snapshot>& b) {
  return std::ranges::equal(a, b, [](const auto& one, const auto& other) { return one.state == other.state; });
}

}  // namespace

base::Result<std::unique_ptr<AgentRun>> AgentRun::Make(const std::string& launch_file, const launch::Overrides& set,
                                                       const std::string& agent) {
  auto file = ResolveInputFile(InputKind::kLaunch, launch_file);
  if (!file) return file.error();
  file = LaunchPath(file.value());
  if (!file) return file.error();
  std::unique_ptr<AgentRun> made(new AgentRun);
  made->launch_file_ = file.value();
  const auto named = WithNamedInputs(set, made->launch_file_, "--set");
  if (!named) return named.error();
  made->overrides_ = WithFilesFromHere(named.value(), made->launch_file_);
  auto launch = launch::Launch::Load(made->launch_file_, made->overrides_);
  if (!launch) return launch.error();
  if (auto status = CheckAgent(launch.value(), agent); !status) return status.error();
  made->overrides_.emplace_back("nodes." + agent + ".config", "{source: agent}");
  for (const launch::LaunchNode& node : launch.value().nodes()) {
    if (node.kind->name == "view") made->overrides_.emplace_back("nodes." + node.name + ".kind", launch::kNoKind);
  }
  // With a recorder in each episode, so that digests do not depend on what is recorded.
  if (!HasRecorder(launch.value()))
    made->overrides_.emplace_back("nodes." + FreeName(launch.value(), "recorder") + ".kind", "recorder");
  launch = launch::Launch::Load(made->launch_file_, made->overrides_);
  if (!launch) return launch.error();
  made->launch_ = std::make_unique<launch::Launch>(std::move(launch).value());
  made->agent_ = made->launch_->roster().Find(agent);
  made->seed_ = made->launch_->seed();
  made->samples_.resize(made->launch_->roster().sources().size());
  if (auto status = made->KeepWorld(); !status) return status.error();
  return made;
}

base::Status AgentRun::KeepWorld() {
  if (launch_->world().empty()) return {};
  auto world = road::World::Load(launch_->world());
  if (!world) return world.error();
  for (const std::string& warning : world.value()->warnings()) base::Log(base::LogLevel::kWarning, "", warning);
  world_ = std::make_unique<const road::KeptWorld>(launch_->world(), std::move(world).value());
  return {};
}

bool AgentRun::IsEventTopic(std::string_view topic) const {
  return std::ranges::any_of(launch::NodeKinds(), [&](const launch::NodeKind& kind) {
    return !kind.outputs.empty() && std::ranges::any_of(kind.inputs, [&](const launch::KindPort& port) {
      return port.topic == topic && port.kind == lockstep::PortKind::kEvent;
    });
  });
}

base::Result<AgentRun::SeedNodes> AgentRun::MakeSeedNodes(std::uint64_t seed, const std::string& record) {
  SeedNodes seed_nodes;
  launch::Overrides overrides = overrides_;
  overrides.emplace_back("seed", std::to_string(seed));
  if (!record.empty()) {
    RunOptions options;
    options.record = record;
    if (auto status = ResolveRecording(*launch_, {}, options, overrides); !status) return status.error();
  }
  auto launch = launch::Launch::Load(launch_file_, overrides);
  if (!launch) return launch.error();
  seed_nodes.launch = std::make_unique<launch::Launch>(std::move(launch).value());
  auto made = LocalNodes::Make(*seed_nodes.launch, [&](NodeIndex n) -> std::unique_ptr<lockstep::Node> {
    if (n == agent_)
      return nodes::InputNodeOf(nodes::MakeAgentSource(wanted_), seed_nodes.launch->roster().base_step_ns());
    if (record.empty() && seed_nodes.launch->node(n).kind->name == "recorder") return replay::MakeNullSink();
    return nullptr;
  });
  if (!made) return made.error();
  seed_nodes.nodes = std::make_unique<LocalNodes>(std::move(made).value());
  return seed_nodes;
}

base::Status AgentRun::Reset(std::optional<std::uint64_t> seed, const std::string& record) {
  if (has_episode()) {
    if (auto status = Finish(); !status) return status;
  }
  const std::uint64_t next_seed = seed.value_or(seed_);
  if (next_seed != seed_) seed_nodes_.reset();
  seed_ = next_seed;
  *wanted_ = {};
  if (!record.empty()) {
    auto made = MakeSeedNodes(seed_, record);
    if (!made) return made.error();
    recorded_ = std::move(made).value();
    return Begin(*recorded_);
  }
  if (seed_nodes_ && !seed_nodes_->beginning.empty()) {
    const base::Status again = BeginAgain(*seed_nodes_);
    if (!again || has_episode()) return again;
  }
  seed_nodes_.reset();
  auto made = MakeSeedNodes(seed_, {});
  if (!made) return made.error();
  seed_nodes_ = std::move(made).value();
  if (auto status = Begin(*seed_nodes_); !status) return status;
  if (CanBeginAgain(*seed_nodes_->launch, *seed_nodes_->nodes)) seed_nodes_->beginning = run_->Beginning();
  return {};
}

base::Status AgentRun::Begin(SeedNodes& seed_nodes) {
  for (auto& samples : samples_) samples.clear();
  step_ = 0;
  lockstep::SteppedRun::Settings settings;
  settings.resume = seed_nodes.beginning;
  settings.on_sample = [this](const Sample& sample) { Take(sample); };
  run_ = std::make_unique<lockstep::SteppedRun>(seed_nodes.launch->roster(), seed_nodes.nodes->nodes(),
                                                std::move(settings));
  const base::Status started = run_->Start();
  if (!started) DropEpisode();
  return started;
}

// Without an episode and without an error where a node does not take its first state back: it is made anew then.
base::Status AgentRun::BeginAgain(SeedNodes& seed_nodes) {
  if (auto status = Begin(seed_nodes); !status) return status;
  if (!SameStates(run_->Beginning(), seed_nodes.beginning)) DropEpisode();
  return {};
}

base::Status AgentRun::Advance(const nodes::AgentControls& controls) {
  *wanted_ = controls;
  ForgetSamples();
  step_ += launch_->roster().node(agent_).period;
  const base::Status status = run_->RunThrough(step_ - 1);
  if (!status) {
    DropEpisode();
    seed_nodes_.reset();  // one of its nodes has failed
  }
  return status;
}

// The activations at the last step are done too, so that the recording holds the last observation and the last action.
base::Status AgentRun::Finish() {
  base::Status status;
  if (recorded_) {
    status = run_->RunThrough(step_);
    if (status.ok()) status = run_->Finish();
  }
  DropEpisode();
  return status;
}

void AgentRun::DropEpisode() {
  run_.reset();
  recorded_.reset();
}

void AgentRun::Take(const Sample& sample) { samples_[sample.source()].push_back(sample); }

// What no later observation has: all samples before the newest that is valid now, and of event topics that one too.
void AgentRun::ForgetSamples() {
  const auto& roster = launch_->roster();
  for (lockstep::SourceIndex source = 0; source < samples_.size(); ++source) {
    auto& samples = samples_[source];
    const std::size_t kept = IsEventTopic(roster.source(source).topic) ? 0 : 1;
    while (samples.size() > kept && samples[kept].valid() <= step_) samples.pop_front();
  }
}

std::vector<Sample> AgentRun::Observation() const {
  std::vector<Sample> seen;
  for (const auto& samples : samples_) {
    const auto ahead = std::ranges::find_if(samples, [this](const Sample& sample) { return sample.valid() > step_; });
    if (ahead == samples.begin()) continue;
    const bool all = IsEventTopic(launch_->roster().source(samples.front().source()).topic);
    std::copy(all ? samples.begin() : ahead - 1, ahead, std::back_inserter(seen));
  }
  return seen;
}

}  // namespace rodeira::cli
