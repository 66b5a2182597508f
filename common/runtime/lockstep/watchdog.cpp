// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/watchdog.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/runtime/lockstep/life.hpp"

namespace rodeira::lockstep {
namespace {

const std::string kNotHeard = "no message from it";

// The key of the launch file that says how long a step may take.
std::string DeadlineKey(const RosterNode& node) {
  return node.deadline_ms > 0 ? fmt::format("nodes.{}.deadline_s", node.name) : "limits.step_s";
}

}  // namespace

Watchdog::Watchdog(const Roster& roster, const Settings& settings)
    : roster_(roster), settings_(settings), incarnations_(roster.nodes().size()) {}

void Watchdog::Heard(const Report& report, std::int64_t now_ms) {
  if (report.node >= incarnations_.size()) return;
  Incarnation& incarnation = incarnations_[report.node];
  if (report.incarnation < incarnation.report.incarnation) return;
  if (incarnation.heard && report.incarnation == incarnation.report.incarnation &&
      IsTerminal(incarnation.report.phase) && !MayFollow(incarnation.report.phase, report.phase))
    return;
  const bool computes_still = incarnation.excused && report.incarnation == incarnation.report.incarnation &&
                              report.progress == incarnation.report.progress && report.phase == Phase::kRunning &&
                              report.waiting == Waiting::kNothing;
  incarnation = {true, now_ms, report, computes_still};
}

void Watchdog::ExpectRestart(NodeIndex node, std::int64_t now_ms) {
  const std::uint32_t incarnation = incarnations_[node].report.incarnation + 1;
  incarnations_[node] = {};
  incarnations_[node].report.incarnation = incarnation;
  first_ms_ = now_ms;
  all_ready_ = false;
  recovering_ = true;
}

void Watchdog::Suspend(NodeIndex node) { incarnations_[node].excused = true; }

std::optional<Watchdog::Fault> Watchdog::Check(std::int64_t now_ms, const Grant& grant) {
  if (!first_ms_) first_ms_ = checked_ms_ = now_ms;
  const std::int64_t own_gap_ms = now_ms - checked_ms_;
  checked_ms_ = now_ms;
  if (own_gap_ms > settings_.silence_ms / 6) {
    *first_ms_ += own_gap_ms;
    for (Incarnation& incarnation : incarnations_) incarnation.last_ms += own_gap_ms;
  }
  for (NodeIndex n = 0; n < incarnations_.size(); ++n) {
    const Incarnation& incarnation = incarnations_[n];
    if (incarnation.heard && !incarnation.excused && IsFault(incarnation.report.phase)) {
      return Fault{n,
                   fmt::format("node '{}' failed at step {}: {}", roster_.node(n).name, incarnation.report.progress,
                               incarnation.report.message),
                   incarnation.report.phase == Phase::kRefused ? 2 : 1};
    }
  }
  for (NodeIndex n = 0; n < incarnations_.size(); ++n) {
    const Incarnation& incarnation = incarnations_[n];
    if (incarnation.heard && !incarnation.excused && EndedEarly(incarnation.report.phase, grant)) {
      return Fault{n, fmt::format("node '{}' ended at step {} although the run goes on", roster_.node(n).name,
                                  incarnation.report.progress)};
    }
  }
  std::string missing;
  for (NodeIndex n = 0; n < incarnations_.size(); ++n) {
    const Incarnation& incarnation = incarnations_[n];
    if (incarnation.heard && incarnation.report.phase >= Phase::kReady) continue;
    const std::string& does = incarnation.heard ? incarnation.report.message : kNotHeard;
    missing += fmt::format("{}'{}'{}", missing.empty() ? "" : ", ", roster_.node(n).name,
                           does.empty() ? "" : fmt::format(" ({})", does));
  }
  if (recovering_ && missing.empty()) {
    recovering_ = false;
    for (Incarnation& incarnation : incarnations_) {
      incarnation.last_ms = now_ms;
      incarnation.held_up = true;
    }
  }
  for (NodeIndex n = 0; n < incarnations_.size() && !recovering_; ++n) {
    const Incarnation& incarnation = incarnations_[n];
    const RosterNode& spec = roster_.node(n);
    if (!incarnation.heard || incarnation.excused || IsTerminal(incarnation.report.phase)) continue;
    const std::int64_t silence_ms = now_ms - incarnation.last_ms;
    const std::int64_t patience = incarnation.held_up                        ? kHeldUp
                                  : incarnation.report.phase < Phase::kReady ? kStarting
                                                                             : 1;
    if (silence_ms > patience * settings_.silence_ms) {
      return Fault{n,
                   fmt::format("node '{}' has sent nothing for {:.2f} s at step {}: it was killed, stopped or cut off",
                               spec.name, static_cast<double>(silence_ms) / 1e3, incarnation.report.progress),
                   1, true};
    }
    const std::int64_t deadline_ms = spec.deadline_ms > 0 ? spec.deadline_ms : settings_.deadline_ms;
    if (incarnation.report.phase == Phase::kRunning && incarnation.report.waiting == Waiting::kNothing &&
        incarnation.report.since_ms > deadline_ms) {
      if (spec.role == Role::kService) {
        return Fault{n, fmt::format("node '{}' has been answering a request for {:.2f} s at step {}, its deadline is "
                                    "{:.2f} s ({})",
                                    spec.name, static_cast<double>(incarnation.report.since_ms) / 1e3,
                                    std::max<Step>(grant.through, 0), static_cast<double>(deadline_ms) / 1e3,
                                    DeadlineKey(spec))};
      }
      return Fault{
          n, fmt::format("node '{}' has been computing step {} for {:.2f} s, its deadline is {:.2f} s ({})", spec.name,
                         incarnation.report.progress, static_cast<double>(incarnation.report.since_ms) / 1e3,
                         static_cast<double>(deadline_ms) / 1e3, DeadlineKey(spec))};
    }
    if (incarnation.report.phase == Phase::kRunning && incarnation.report.waiting == Waiting::kOutput &&
        incarnation.report.since_ms > settings_.start_ms) {
      return Fault{
          n, fmt::format("node '{}' has been writing the output of the steps before {} for {:.0f} s, its limit is "
                         "{:.0f} s (limits.start_s)",
                         spec.name, incarnation.report.progress, static_cast<double>(incarnation.report.since_ms) / 1e3,
                         static_cast<double>(settings_.start_ms) / 1e3)};
    }
  }
  all_ready_ = all_ready_ || missing.empty();
  if (!all_ready_ && now_ms - *first_ms_ > settings_.start_ms) {
    const auto late = std::find_if(incarnations_.begin(), incarnations_.end(), [](const Incarnation& incarnation) {
      return !incarnation.heard || incarnation.report.phase < Phase::kReady;
    });
    return Fault{static_cast<NodeIndex>(late - incarnations_.begin()),
                 fmt::format("after {:.0f} s these are still missing: {}",
                             static_cast<double>(settings_.start_ms) / 1e3, missing)};
  }
  return std::nullopt;
}

}  // namespace rodeira::lockstep
