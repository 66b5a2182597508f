// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/clock_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rodeira::dds {

std::string ProgressLine(const ClockRun& run) {
  if (!run.controller.begun())
    return fmt::format("waiting for {}", fmt::join(run.clock.Missing(lockstep::Phase::kReady), ", "));
  return fmt::format("progress step={} wall_s={:.3f} pace={:g} paused={} begun_ns={}", run.clock.slowest_progress(),
                     run.RunSeconds(), run.controller.pacer().pace(), run.controller.pacer().paused() ? 1 : 0,
                     run.BegunNs());
}

std::string NodeLines(const ClockRun& run) {
  std::string lines;
  for (lockstep::NodeIndex n = 0; n < run.roster.nodes().size(); ++n) {
    const lockstep::Report& report = run.clock.report(n);
    const double mean_us =
        report.steps == 0 ? 0.0 : static_cast<double>(report.busy_ns) * 1e-3 / static_cast<double>(report.steps);
    lines += fmt::format(
        "node {} steps={} mean_us={:.2f} worst_us={:.1f} apart_us={:.1f} apart_p99_us={:.1f} server_calls={} saves={} "
        "digest={}\n",
        run.roster.node(n).name, report.steps, mean_us, static_cast<double>(report.worst_ns) * 1e-3,
        static_cast<double>(report.median_interval_ns) * 1e-3, static_cast<double>(report.p99_interval_ns) * 1e-3,
        report.server_calls, report.cannot_save ? 0 : 1, base::Hex(report.digest));
  }
  return lines;
}

std::string EndLine(const ClockRun& run, const char* how, lockstep::Step last_step, base::Digest digest, int status) {
  const lockstep::Pacer& pacer = run.controller.pacer();
  const lockstep::Lateness& late = pacer.lateness();
  const auto seconds = [](auto ns) { return static_cast<double>(ns) * 1e-9; };
  return fmt::format(
      "end {} last_step={} wall_s={:.6f} digest={} slipped_s={:.6f} paused_s={:.6f} paced_steps={} late_steps={} "
      "late_mean_s={:.9f} late_worst_s={:.9f} status={}",
      how, last_step, run.RunSeconds(), base::Hex(digest), seconds(pacer.slipped_ns()),
      seconds(pacer.PausedNs(run.NowNs())), late.steps, late.late, seconds(late.mean_ns()), seconds(late.worst_ns),
      status);
}

}  // namespace rodeira::dds
