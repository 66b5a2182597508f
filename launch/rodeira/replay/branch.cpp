// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/branch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "common/runtime/replay/recorded_node.hpp"
#include "common/runtime/replay/splice.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/replay/branch_ground.hpp"
#include "launch/rodeira/replay/continued_node.hpp"
#include "launch/rodeira/replay/recording_text.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "launch/rodeira/run/local_nodes.hpp"

namespace rodeira::cli {
namespace {

using lockstep::NodeIndex;
using lockstep::Snapshot;
using lockstep::Step;

// The parent's nodes at `at`: computed again from the snapshot before, each sample compared.
base::Result<Recomputed> StatesAt(const replay::RecordedRun& parent, const BranchSpec& spec, BranchOutcome& outcome) {
  Recomputation again;
  again.from = spec.at;
  again.last_step = spec.at;
  again.snapshot_at = spec.at;
  again.stop_requested = spec.stop_requested;
  auto done = Recompute(parent, again);
  if (!done) return done.error();
  outcome.recomputed_from = done.value().verdict.first_step;
  outcome.difference = done.value().verdict.difference;
  outcome.without_state = done.value().verdict.without_state;
  return done;
}

base::Status CheckStep(const replay::RecordedRun& parent, Step at) {
  const auto& roster = parent.roster();
  const double dt_s = static_cast<double>(roster.base_step_ns()) * 1e-9;
  if (at < parent.branched_at()) {
    return base::WrongInput(
        "replay.wrong_branch_time",
        fmt::format("--from {:.3f} s was found, but this recording left its parent at {:.3f} s; what lies before is "
                    "the parent's to branch from",
                    static_cast<double>(at) * dt_s, static_cast<double>(parent.branched_at()) * dt_s),
        parent.path().string());
  }
  const bool has_snapshots = std::any_of(roster.nodes().begin(), roster.nodes().end(),
                                         [](const auto& node) { return node.snapshots.has_value(); });
  if (at == 0 && !has_snapshots)
    return base::WrongInput("replay.wrong_branch_time",
                            "--from 0 was found; a run without snapshots has no states at its beginning",
                            parent.path().string());
  if (at < 0 || at > parent.last_step()) {
    return base::WrongInput("replay.wrong_branch_time",
                            fmt::format("--from {:.3f} s was found, but the run ends at {:.3f} s",
                                        static_cast<double>(at) * dt_s, static_cast<double>(parent.last_step()) * dt_s),
                            parent.path().string());
  }
  Step common = 1;
  for (const auto& node : roster.nodes()) {
    if (node.role == lockstep::Role::kStepped && !node.is_sink()) common = std::lcm(common, node.period);
  }
  if (at % common != 0) {
    return base::WrongInput("replay.wrong_branch_time",
                            fmt::format("--from {:.3f} s was found; a branch begins where all nodes are activated, the "
                                        "nearest such time is {:.3f} s",
                                        static_cast<double>(at) * dt_s,
                                        static_cast<double>(lockstep::FloorTo(at + common / 2, common)) * dt_s),
                            parent.path().string());
  }
  return {};
}

// Its recorded samples answer what the parent did, not what the branch does.
base::Status CheckExternalNodes(const replay::RecordedRun& parent) {
  for (NodeIndex n = 0; n < parent.roster().nodes().size(); ++n) {
    if (!parent.launch().node(n).is_external() || !parent.is_substituted(n) || parent.roster().node(n).is_sink())
      continue;
    return base::WrongInput(
        "replay.no_library",
        fmt::format("node '{0}' is an external program, which a branch cannot run; its recorded samples do not answer "
                    "what changes in a branch; --library {0}=FILE.so names its shared object",
                    parent.roster().node(n).name),
        parent.path().string());
  }
  return {};
}

using GoingOn = std::map<NodeIndex, ContinuedNode*>;

// The changes name the node, or one of its keys.
bool IsNamed(const std::string& node, const launch::Overrides& changes) {
  const std::string own = "nodes." + node;
  return std::any_of(changes.begin(), changes.end(),
                     [&](const auto& change) { return change.first == own || change.first.starts_with(own + "."); });
}

// The keys of a node among the changes; all of them where none is its own.
std::string KeysThatChange(const std::string& node, const launch::Overrides& changes) {
  std::vector<std::string> own, all;
  for (const auto& [key, value] : changes) {
    all.push_back(key);
    if (IsNamed(node, {{key, value}})) own.push_back(key);
  }
  return fmt::format("{}", fmt::join(own.empty() ? all : own, ", "));
}

// Each node's state for its new model, but for those that go on themselves; the names of those that had to take over.
base::Result<std::vector<std::string>> Adapt(const lockstep::Roster& roster, const std::vector<lockstep::Node*>& nodes,
                                             const GoingOn& go_on, const launch::Overrides& changes,
                                             std::vector<Snapshot>& snapshots) {
  std::vector<std::string> taken_over;
  for (NodeIndex n = 0; n < nodes.size(); ++n) {
    if (nodes[n] == nullptr || go_on.contains(n)) continue;
    if (roster.node(n).is_sink()) {  // begins anew
      base::StateWriter out;
      nodes[n]->Save(out);
      snapshots[n].state = out.bytes();
      continue;
    }
    if (snapshots[n].has_state && nodes[n]->can_save()) {
      base::StateReader in(snapshots[n].state);
      nodes[n]->Restore(in);
      if (in.Finish().ok()) continue;
    }
    if (auto status = nodes[n]->InitialiseFrom(snapshots[n].samples); !status) {
      return status.error().In(
          fmt::format("node '{}', changed {}", roster.node(n).name, KeysThatChange(roster.node(n).name, changes)));
    }
    taken_over.push_back(roster.node(n).name);
    snapshots[n].has_state = nodes[n]->can_save();
    snapshots[n].state.clear();
    if (!snapshots[n].has_state) continue;
    base::StateWriter out;
    nodes[n]->Save(out);
    snapshots[n].state = out.bytes();
  }
  return taken_over;
}

// Those without a state that the changes leave as they are.
std::set<NodeIndex> Unchanged(const std::vector<NodeIndex>& without_state, const launch::Launch& launch,
                              const launch::Overrides& changes) {
  std::set<NodeIndex> unchanged;
  const bool other_model = std::any_of(changes.begin(), changes.end(),
                                       [](const auto& change) { return change.first.starts_with("vehicle"); });
  if (std::any_of(changes.begin(), changes.end(), [](const auto& change) { return change.first == "world"; }))
    return unchanged;
  for (const NodeIndex n : without_state) {
    if (other_model && launch.node(n).kind->name == "vehicle") continue;
    if (!IsNamed(launch.node(n).name, changes)) unchanged.insert(n);
  }
  return unchanged;
}

// The first node of a kind; empty where there is none.
std::string NodeOfKind(const launch::Launch& launch, std::string_view kind) {
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name == kind) return node.name;
  }
  return {};
}

// Which nodes drive anew, and which as recorded: a live input is a person's where the changes name its node.
std::vector<bool> Persons(const launch::Launch& launch, const launch::Overrides& changes) {
  std::vector<bool> persons;
  for (const launch::LaunchNode& node : launch.nodes()) {
    persons.push_back(node.is_live() && IsNamed(node.name, changes));
  }
  return persons;
}

std::vector<std::string> NamesOf(const launch::Launch& launch, const std::vector<bool>& marked) {
  std::vector<std::string> names;
  for (NodeIndex n = 0; n < marked.size(); ++n) {
    if (marked[n]) names.push_back(launch.node(n).name);
  }
  return names;
}

base::Result<launch::Overrides> ChangesOf(const replay::RecordedRun& parent, const BranchSpec& spec,
                                          const std::filesystem::path& own) {
  launch::Overrides changes = spec.changes;
  changes.insert(changes.end(), spec.libraries.begin(), spec.libraries.end());
  changes.emplace_back("nodes." + NodeOfKind(parent.launch(), "recorder") + ".config.file", "\"" + own.string() + "\"");
  if (!spec.with_view) return changes;
  const std::string view = NodeOfKind(parent.launch(), "view");
  if (view.empty())
    return base::WrongInput("replay.no_view", "a view is requested, but the recorded launch file has none",
                            spec.parent);
  changes.emplace_back("nodes." + view + ".config.window", "always");
  changes.emplace_back("nodes." + view + ".config.frames", "~");  // pictures of the parent's
  return changes;
}

// As long as is wished, or as the changes say; otherwise as long as the parent.
base::Result<Step> LastStep(const replay::RecordedRun& changed, const BranchSpec& spec) {
  const bool says = std::any_of(spec.changes.begin(), spec.changes.end(),
                                [](const auto& change) { return change.first == "duration_s"; });
  const auto duration_s = changed.launch().duration_s();
  if (spec.last_step || !says || !duration_s) return spec.last_step.value_or(changed.last_step());
  const auto last_step =
      static_cast<Step>(std::llround(*duration_s * 1e9 / static_cast<double>(changed.roster().base_step_ns())));
  if (last_step > spec.at) return last_step;
  return base::WrongInput(
      "replay.wrong_branch_time",
      fmt::format("duration_s = {} was found; the branch begins at {:.3f} s", *duration_s,
                  static_cast<double>(spec.at) * static_cast<double>(changed.roster().base_step_ns()) * 1e-9),
      spec.parent);
}

}  // namespace

base::Result<BranchOutcome> Branch(const BranchSpec& spec) {
  BranchOutcome outcome;
  outcome.at = spec.at;
  auto parent = replay::RecordedRun::Open(spec.parent, spec.libraries);
  if (!parent) return parent.error();
  outcome.recorded_by_another = RecordedByAnother(parent.value().version(), parent.value().commit());
  const auto& roster = parent.value().roster();
  if (auto status = parent.value().CheckTypes(); !status) return status.error();
  if (auto status = CheckExternalNodes(parent.value()); !status) return status.error();
  if (auto status = CheckStep(parent.value(), spec.at); !status) return status.error();
  auto folder = base::TemporaryFolder::Make("branch");
  if (!folder) return folder.error();
  const std::filesystem::path own = folder.value().path() / "branch.mcap";
  const auto changes = ChangesOf(parent.value(), spec, own);
  if (!changes) return changes.error();
  // What is wrong with the changes is said before anything is computed.
  auto changed = replay::RecordedRun::Open(spec.parent, changes.value());
  if (!changed) return changed.error();
  const auto last_step = LastStep(changed.value(), spec);
  if (!last_step) return last_step.error();
  if (auto status = CheckGroundOfBranch(parent.value(), changed.value(), spec.changes, spec.at); !status)
    return status.error();
  const launch::Launch& launch = changed.value().launch();
  const std::vector<bool> persons = Persons(launch, spec.changes);
  outcome.live = NamesOf(launch, persons);
  const auto is_replayed = [&](NodeIndex n) { return launch.node(n).is_live() && !persons[n]; };
  const auto without_state = parent.value().WithoutState();
  if (!without_state) return without_state.error();
  const std::set<NodeIndex> unchanged = Unchanged(without_state.value(), launch, spec.changes);
  GoingOn go_on;
  launch::RunLogBoard log;
  auto nodes = LocalNodes::Make(
      launch,
      [&](NodeIndex n) -> std::unique_ptr<lockstep::Node> {
        if (unchanged.contains(n)) {
          auto continued = std::make_unique<ContinuedNode>();
          go_on[n] = continued.get();
          return continued;
        }
        if (is_replayed(n)) return replay::MakeRecordedNode(parent.value(), n, spec.at);
        const std::string_view kind = launch.node(n).kind->name;
        if (roster.node(n).is_sink() && kind != "recorder" && !(spec.with_view && kind == "view"))
          return replay::MakeNullSink();
        return nullptr;
      },
      &log);
  if (!nodes) return changed.value().Named(nodes.error());
  WarnOfWorld(changed.value(), nodes.value());

  auto states = StatesAt(parent.value(), spec, outcome);
  if (!states) return states.error();
  if (outcome.difference) return outcome;
  std::vector<Snapshot>& snapshots = states.value().snapshots;
  for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    if (is_replayed(n)) snapshots[n].state.clear();
  }
  for (const auto& [n, continued] : go_on)
    continued->Follow(*states.value().nodes->nodes()[n], states.value().last_published[n], roster);
  auto taken_over = Adapt(roster, nodes.value().nodes(), go_on, spec.changes, snapshots);
  if (!taken_over) return changed.value().Named(taken_over.error());
  outcome.taken_over = std::move(taken_over).value();

  lockstep::InProcessSettings settings;
  settings.first_step = spec.at;
  settings.last_step = last_step.value();
  settings.resume = std::move(snapshots);
  settings.stop_requested = spec.stop_requested;
  settings.pace = spec.pace;
  settings.next_command = spec.next_command;
  settings.on_log = [&log](const lockstep::LogBatch& batch) { log.Say(batch); };
  const lockstep::RunOutcome ran = lockstep::RunThreaded(roster, nodes.value().nodes(), settings);
  const auto stopped = [&] { return spec.stop_requested && spec.stop_requested(); };
  const bool stopped_at_once =
      !ran.ok && ran.last_step < spec.at && stopped();  // no node's fault: no step was driven yet
  if (!ran.ok && !stopped_at_once)
    return changed.value().Named(
        base::Failed("replay.node_failed", fmt::format("the branch ended at step {}: {}", ran.last_step, ran.fault)));
  // What a person has driven cannot be driven again: it is kept.
  if (stopped_at_once || (stopped() && outcome.live.empty())) {
    return base::Failed("run.interrupted",
                        fmt::format("interrupted at step {}; no branch was written", std::max(ran.last_step, spec.at)),
                        spec.parent);
  }
  outcome.last_step = ran.last_step;

  record::TextMap about{
      {"parent", std::filesystem::path(spec.parent).filename().string()},
      {"step", std::to_string(spec.at)},
      {"time_s", fmt::format("{}", static_cast<double>(spec.at) * static_cast<double>(roster.base_step_ns()) * 1e-9)}};
  for (const auto& [key, value] : spec.changes) about["change " + key] = value;
  if (auto status = replay::Splice(parent.value(), own, spec.at, about, spec.recording,
                                   outcome.live.empty() ? spec.stop_requested : std::function<bool()>());
      !status)
    return status.error();
  return outcome;
}

base::Result<LiveDrivers> DrivenLive(const BranchSpec& spec) {
  auto changed = replay::RecordedRun::Open(spec.parent, spec.changes);
  if (!changed) return changed.error();
  const launch::Launch& launch = changed.value().launch();
  const std::vector<bool> persons = Persons(launch, spec.changes);
  LiveDrivers drivers{NamesOf(launch, persons), false};
  for (NodeIndex n = 0; n < persons.size(); ++n) {
    if (persons[n] && ReadsDevice(launch.node(n))) drivers.by_device = true;
  }
  return drivers;
}

}  // namespace rodeira::cli
