// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/in_process_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stop_token>
#include <thread>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/log.hpp"
#include "common/core/base/print_error.hpp"
#include "common/runtime/launch/pace.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "launch/rodeira/run/operator.hpp"
#include "launch/rodeira/run/run_report.hpp"
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

// A thread that hangs cannot be ended: a while after a signal the process ends without it. On a thread of its own, for
// nodes run on every other one.
void EndWhatHangs(const std::stop_token& done) {
  constexpr std::chrono::milliseconds kForcedStop{1500}, kLook{20};
  std::optional<WallClock::time_point> interrupted_at;
  for (; !done.stop_requested(); std::this_thread::sleep_for(kLook)) {
    if (!Interrupted()) continue;
    if (!interrupted_at) interrupted_at = WallClock::now();
    if (WallClock::now() - *interrupted_at < kForcedStop) continue;
    std::_Exit(
        base::PrintError("rodeira", base::Failed("run.stopped", "stopped by a signal before all nodes had finished")));
  }
}

RunReport ReportOf(const lockstep::RunOutcome& outcome, const lockstep::Roster& roster, double wall_s) {
  RunReport report;
  report.ready = true;
  report.ended = true;
  report.ok = outcome.ok;
  report.step = outcome.last_step;
  report.wall_s = wall_s;
  report.slipped_s = static_cast<double>(outcome.slipped_ns) * 1e-9;
  report.paused_s = static_cast<double>(outcome.paused_ns) * 1e-9;
  report.paced_steps = outcome.lateness.steps;
  report.late_steps = outcome.lateness.late;
  report.late_mean_s = outcome.lateness.mean_ns() * 1e-9;
  report.late_worst_s = static_cast<double>(outcome.lateness.worst_ns) * 1e-9;
  report.digest = base::Hex(outcome.digest);
  if (!outcome.fault.empty()) report.faults.push_back(outcome.fault);
  for (const lockstep::Report& node : outcome.reports) {
    const double mean_us =
        node.steps == 0 ? 0.0 : static_cast<double>(node.busy_ns) * 1e-3 / static_cast<double>(node.steps);
    report.nodes.push_back({roster.node(node.node).name, node.steps, mean_us, static_cast<double>(node.worst_ns) * 1e-3,
                            static_cast<double>(node.median_interval_ns) * 1e-3,
                            static_cast<double>(node.p99_interval_ns) * 1e-3, node.server_calls, node.cannot_save});
  }
  return report;
}

}  // namespace

int RunInProcess(const RunOptions& options, const launch::Launch& launch) {
  base::TraceCrashes("rodeira: the crash ends this run of one process; 'rodeira repair' completes its recording\n");
  CatchInterrupts();
  const std::jthread guard(EndWhatHangs);
  const auto& roster = launch.roster();
  Operator run_operator(options.run, options.quiet);
  launch::RunLogBoard log;
  auto nodes = LocalNodes::Make(launch, {}, &log);
  if (!nodes) return base::PrintError("rodeira", nodes.error());
  for (const std::string& warning : nodes.value().world_warnings()) base::Log(base::LogLevel::kWarning, "", warning);
  lockstep::InProcessSettings settings;
  const auto seconds = options.duration_s ? options.duration_s : launch.duration_s();
  if (seconds)
    settings.last_step =
        static_cast<lockstep::Step>(std::llround(*seconds * 1e9 / static_cast<double>(roster.base_step_ns())));
  settings.pace = launch::ParsePace(options.pace).value();
  settings.stop_requested = Interrupted;
  settings.on_log = [&log](const lockstep::LogBatch& batch) { log.Say(batch); };
  settings.next_command = [&run_operator] { return NextCommand(run_operator); };
  const auto start = WallClock::now();
  const lockstep::RunOutcome outcome = lockstep::RunThreaded(roster, nodes.value().nodes(), settings);
  const double wall_s = SecondsSince(start);
  { const LocalNodes ended = std::move(nodes).value(); }  // the recording is closed, or removed, before it is told of
  const RunReport report = ReportOf(outcome, roster, wall_s);
  const bool is_refused = std::ranges::any_of(
      outcome.reports, [](const lockstep::Report& one) { return one.phase == lockstep::Phase::kRefused; });
  const int status = outcome.ok   ? 0
                     : is_refused ? base::PrintError("rodeira", base::WrongInput("run.refused", outcome.fault))
                                  : base::PrintError("rodeira", base::Failed("run.failed", outcome.fault));
  const bool has_begun = !is_refused || outcome.last_step > 0;
  if (has_begun && !options.quiet)
    fmt::print("{}", report.Table(static_cast<double>(roster.base_step_ns()) * 1e-9, options.record));
  return status;
}

}  // namespace rodeira::cli
