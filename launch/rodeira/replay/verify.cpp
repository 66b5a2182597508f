// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "common/core/base/log.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/replay/recorded_node.hpp"

namespace rodeira::cli {

base::Result<VerifyResult> Verify(const replay::RecordedRun& run, lockstep::Step from,
                                  const std::function<void(lockstep::Step)>& on_progress,
                                  const std::function<bool()>& stop_requested) {
  Recomputation spec;
  spec.from = from;
  spec.on_progress = on_progress;
  spec.stop_requested = stop_requested;
  auto done = Recompute(run, spec);
  if (!done) return done.error();
  return std::move(done.value().verdict);
}

void WarnOfWorld(const replay::RecordedRun& run, const LocalNodes& nodes) {
  for (const std::string& warning : nodes.world_warnings()) {
    base::Error said;
    said.message = warning;
    base::Log(base::LogLevel::kWarning, "", run.Named(said).Text());
  }
}

base::Result<Recomputed> Recompute(const replay::RecordedRun& run, const Recomputation& spec) {
  const auto& roster = run.roster();
  if (auto status = run.CheckBytes(); !status) return status.error();
  if (auto status = run.CheckTypes(); !status) return status.error();
  if (auto status = run.CheckMathematics(); !status) return status.error();
  const auto without_state = run.WithoutState();
  if (!without_state) return without_state.error();
  // The recording ends with its last step; what is published ahead of it is there only where it is computed again.
  lockstep::Step ahead = 0;
  for (const lockstep::RosterNode& node : roster.nodes()) {
    if (!node.outputs.empty()) ahead = std::max(ahead, node.delay - node.period);
  }
  const auto at = run.SnapshotAtOrBefore(
      spec.snapshot_at ? std::min(spec.from, std::max<lockstep::Step>(run.last_step() - ahead, 0)) : spec.from);
  if (!at) return at.error();
  if (spec.snapshot_at && *spec.snapshot_at == at.value() && at.value() + ahead > run.last_step()) {
    return base::WrongInput("replay.no_sample_to_compare",
                            fmt::format("the run ends at step {}; what its nodes publish ahead of step {} is not in it",
                                        run.last_step(), at.value()),
                            run.path().string());
  }
  if (spec.snapshot_at && *spec.snapshot_at < at.value()) {
    return base::WrongInput(
        "replay.no_snapshot",
        fmt::format("the states of step {} are wanted, but the first snapshots of this run's own are at step {}",
                    *spec.snapshot_at, at.value()),
        run.path().string());
  }
  Recomputed recomputed;
  VerifyResult& verdict = recomputed.verdict;
  verdict.first_step = at.value();
  for (const lockstep::NodeIndex n : without_state.value()) {
    verdict.without_state.push_back(roster.node(n).name);
    if (spec.snapshot_at) recomputed.last_published[n] = {};
  }
  std::vector<bool> trusted(roster.nodes().size(), false);
  for (lockstep::NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    const launch::LaunchNode& node = run.launch().node(n);
    trusted[n] = run.is_substituted(n) && !roster.node(n).is_sink();
    if (trusted[n]) (node.is_external() ? verdict.external : verdict.substituted).push_back(node.name);
    if (!trusted[n] && !roster.node(n).is_sink() && roster.node(n).role == lockstep::Role::kStepped) ++verdict.nodes;
  }
  auto nodes = LocalNodes::Make(run.launch(), [&](lockstep::NodeIndex n) -> std::unique_ptr<lockstep::Node> {
    if (roster.node(n).is_sink()) return replay::MakeNullSink();
    if (trusted[n]) return replay::MakeRecordedNode(run, n, at.value());
    return nullptr;
  });
  if (!nodes) return run.Named(nodes.error());
  if (!spec.snapshot_at) WarnOfWorld(run, nodes.value());  // a branch says what its own world needed
  if (!run.world_hash().empty() && run.world_hash() != base::Hex(nodes.value().world_hash())) {
    return base::WrongInput("replay.other_world",
                            fmt::format("the recording says world_hash {}, the embedded world has {}", run.world_hash(),
                                        base::Hex(nodes.value().world_hash())),
                            run.path().string());
  }

  lockstep::InProcessSettings settings;
  settings.first_step = at.value();
  settings.last_step = spec.last_step.value_or(run.last_step());
  if (spec.snapshot_at && *spec.snapshot_at > at.value()) {
    recomputed.snapshots.resize(roster.nodes().size());
    settings.snapshot_every = *spec.snapshot_at;
    settings.on_snapshot = [&](const lockstep::Snapshot& snapshot) {
      if (snapshot.at == *spec.snapshot_at) recomputed.snapshots[snapshot.node] = snapshot;
    };
  }
  if (at.value() > 0 || spec.snapshot_at == 0) {
    auto snapshots = run.Snapshots(at.value());
    if (!snapshots) return snapshots.error();
    if (spec.snapshot_at == at.value()) recomputed.snapshots = snapshots.value();
    if (at.value() > 0) settings.resume = std::move(snapshots).value();
    for (lockstep::NodeIndex n = 0; n < roster.nodes().size(); ++n) {
      if (trusted[n] && !settings.resume.empty()) settings.resume[n].state.clear();  // it was another node's
    }
  }
  replay::Comparison comparison(run, at.value(), trusted);
  std::atomic<bool> stop = false;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    comparison.Take(sample);
    if (comparison.differs()) stop = true;
    const auto last = recomputed.last_published.find(roster.source(sample.source()).node);
    if (last == recomputed.last_published.end() || sample.source() == roster.node(last->first).snapshots) return;
    if (sample.valid() == *spec.snapshot_at + roster.node(last->first).delay) last->second.push_back(sample);
  };
  const auto interrupted = [&spec] { return spec.stop_requested && spec.stop_requested(); };
  settings.stop_requested = [&] { return stop.load() || interrupted(); };
  if (spec.on_progress)
    settings.on_progress = [&](const lockstep::Clock& clock) { spec.on_progress(clock.slowest_progress()); };
  const lockstep::RunOutcome outcome = lockstep::RunThreaded(roster, nodes.value().nodes(), settings);
  if (interrupted() && !comparison.differs())
    return base::Failed("run.interrupted",
                        fmt::format("interrupted at step {}", std::max(outcome.last_step, at.value())),
                        run.path().string());
  comparison.Finish(std::min(outcome.last_step, run.last_step()));
  for (lockstep::NodeIndex n = 0; n < recomputed.snapshots.size(); ++n) {
    recomputed.snapshots[n].node = n;
    recomputed.snapshots[n].at = *spec.snapshot_at;
  }
  if (comparison.problem()) return *comparison.problem();
  if (!outcome.ok && !comparison.first())
    return run.Named(
        base::Failed("replay.node_failed", fmt::format("the run could not be computed again: {}", outcome.fault)));
  verdict.last_step = outcome.last_step;
  verdict.samples = comparison.compared();
  verdict.snapshots = comparison.snapshots_compared();
  verdict.difference = comparison.first();
  if (spec.snapshot_at) recomputed.nodes = std::make_shared<LocalNodes>(std::move(nodes).value());
  return recomputed;
}

}  // namespace rodeira::cli
