// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/watchdog.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/runtime/lockstep/life.hpp"

namespace rodeira::lockstep {

Watchdog::Watchdog(const Roster& roster, const Settings& settings)
    : roster_(roster), settings_(settings), lives_(roster.nodes().size()) {}

void Watchdog::Heard(const Report& report, std::int64_t now_ms) {
  if (report.node >= lives_.size()) return;
  Life& life = lives_[report.node];
  if (report.incarnation < life.report.incarnation) return;
  if (life.heard && report.incarnation == life.report.incarnation && IsTerminal(life.report.phase) &&
      !MayFollow(life.report.phase, report.phase))
    return;
  const bool computes_still = life.excused && report.incarnation == life.report.incarnation &&
                              report.progress == life.report.progress && report.phase == Phase::kRunning &&
                              report.waiting == Waiting::kNothing;
  life = {true, now_ms, report, computes_still};
}

void Watchdog::ExpectNextLife(NodeIndex node, std::int64_t now_ms) {
  const std::uint32_t incarnation = lives_[node].report.incarnation + 1;
  lives_[node] = {};
  lives_[node].report.incarnation = incarnation;
  first_ms_ = now_ms;
  everybody_ready_ = false;
  recovering_ = true;
}

void Watchdog::Excuse(NodeIndex node) { lives_[node].excused = true; }

std::optional<Watchdog::Fault> Watchdog::Check(std::int64_t now_ms, const Grant& grant) {
  if (!first_ms_) first_ms_ = checked_ms_ = now_ms;
  const std::int64_t own_gap_ms = now_ms - checked_ms_;
  checked_ms_ = now_ms;
  if (own_gap_ms > settings_.silence_ms / 6) {
    *first_ms_ += own_gap_ms;
    for (Life& life : lives_) life.last_ms += own_gap_ms;
  }
  for (NodeIndex n = 0; n < lives_.size(); ++n) {
    const Life& life = lives_[n];
    if (life.heard && !life.excused && IsFault(life.report.phase)) {
      return Fault{n,
                   fmt::format("node '{}' failed at step {}: {}", roster_.node(n).name, life.report.progress,
                               life.report.message),
                   life.report.phase == Phase::kRefused ? 2 : 1};
    }
  }
  for (NodeIndex n = 0; n < lives_.size(); ++n) {
    const Life& life = lives_[n];
    if (life.heard && !life.excused && EndedEarly(life.report.phase, grant)) {
      return Fault{n, fmt::format("node '{}' ended at step {} although the run goes on", roster_.node(n).name,
                                  life.report.progress)};
    }
  }
  std::string missing;
  for (NodeIndex n = 0; n < lives_.size(); ++n) {
    const Life& life = lives_[n];
    if (!life.heard || life.report.phase < Phase::kReady)
      missing += (missing.empty() ? "'" : ", '") + roster_.node(n).name + "'";
  }
  if (recovering_ && missing.empty()) {
    recovering_ = false;
    for (Life& life : lives_) {
      life.last_ms = now_ms;
      life.held_up = true;
    }
  }
  for (NodeIndex n = 0; n < lives_.size() && !recovering_; ++n) {
    const Life& life = lives_[n];
    const RosterNode& spec = roster_.node(n);
    if (!life.heard || life.excused || IsTerminal(life.report.phase)) continue;
    const std::int64_t silence_ms = now_ms - life.last_ms;
    const std::int64_t patience = life.held_up ? kHeldUp : life.report.phase < Phase::kReady ? kStarting : 1;
    if (silence_ms > patience * settings_.silence_ms) {
      return Fault{n,
                   fmt::format("node '{}' has said nothing for {:.2f} s at step {}: it was killed, stopped or cut off",
                               spec.name, static_cast<double>(silence_ms) / 1e3, life.report.progress)};
    }
    const std::int64_t deadline_ms = spec.deadline_ms > 0 ? spec.deadline_ms : settings_.deadline_ms;
    if (life.report.phase == Phase::kRunning && life.report.waiting == Waiting::kNothing &&
        life.report.since_ms > deadline_ms) {
      return Fault{n, fmt::format("node '{}' has been computing step {} for {:.2f} s, its deadline is {:.2f} s",
                                  spec.name, life.report.progress, static_cast<double>(life.report.since_ms) / 1e3,
                                  static_cast<double>(deadline_ms) / 1e3)};
    }
    if (life.report.phase == Phase::kRunning && life.report.waiting == Waiting::kOutput &&
        life.report.since_ms > settings_.start_ms) {
      return Fault{n, fmt::format("node '{}' has been writing what it made before step {} for {:.0f} s", spec.name,
                                  life.report.progress, static_cast<double>(life.report.since_ms) / 1e3)};
    }
  }
  everybody_ready_ = everybody_ready_ || missing.empty();
  if (!everybody_ready_ && now_ms - *first_ms_ > settings_.start_ms) {
    const auto late = std::find_if(lives_.begin(), lives_.end(),
                                   [](const Life& life) { return !life.heard || life.report.phase < Phase::kReady; });
    return Fault{static_cast<NodeIndex>(late - lives_.begin()),
                 fmt::format("after {:.0f} s these are still missing: {}",
                             static_cast<double>(settings_.start_ms) / 1e3, missing)};
  }
  return std::nullopt;
}

}  // namespace rodeira::lockstep
