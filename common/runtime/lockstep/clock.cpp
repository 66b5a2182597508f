// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "common/runtime/lockstep/life.hpp"

namespace rodeira::lockstep {

Clock::Clock(const Roster& roster, std::optional<Step> last_step, Step first_step, std::vector<Policy> policies)
    : roster_(roster),
      last_step_(last_step),
      first_step_(first_step),
      recovery_(roster, std::move(policies)),
      reports_(roster.nodes().size()),
      heard_(roster.nodes().size(), false) {
  grant_.roster = roster.hash();
  grant_.safe = recovery_.safe();
  for (NodeIndex n = 0; n < reports_.size(); ++n) reports_[n].node = n;
}

base::Status Clock::Take(const Report& report) {
  if (report.node >= roster_.nodes().size()) {
    return base::WrongInput(
        "run.wrong_report",
        fmt::format("a report of node number {} was refused: the roster has {} nodes", report.node, reports_.size()));
  }
  const RosterNode& spec = roster_.node(report.node);
  Report& known = reports_[report.node];
  const auto refuse = [&](std::string why) {
    return base::WrongInput("run.wrong_report", std::move(why), fmt::format("report of node '{}'", spec.name));
  };
  if (report.incarnation < incarnation(report.node)) {
    return refuse(
        fmt::format("incarnation {} was found, {} is the living one", report.incarnation, incarnation(report.node)));
  }
  if (heard_[report.node] && report.incarnation == known.incarnation) {
    if (report.progress < known.progress) return {};  // overtaken on its way, nothing new
    if (!MayFollow(known.phase, report.phase)) return {};
  }
  if (report.progress < 0 || report.progress % spec.period != 0) {
    return refuse(
        fmt::format("progress {} was found, a multiple of the period {} was expected", report.progress, spec.period));
  }
  LearnGranted(report);
  // No node can have run an activation that was not granted: its next one is at most a period behind the grant.
  if (spec.role == Role::kStepped && report.progress > std::max(grant_.through, first_step_) + spec.period) {
    return refuse(fmt::format("progress {} was found, but only step {} is granted", report.progress, grant_.through));
  }
  known = report;
  heard_[report.node] = true;
  SetIncarnation(report.node, report.incarnation);
  recovery_.Heard(report);
  if (rebuilding_ && HeardAll()) {
    recovery_.InitialiseFrom(reports_, grant_.through);
    rebuilding_ = false;
  }
  SetRecovery();
  return {};
}

void Clock::Rebuild() {
  has_predecessor_ = rebuilding_ = true;
  SetRecovery();
}

// Also later: a node that was stopped may receive only now a grant of the clock before this one.
void Clock::LearnGranted(const Report& report) {
  if (!has_predecessor_) return;
  grant_.through = std::max(grant_.through, report.granted);
  if (report.granted_final && report.granted == grant_.through) grant_.final = true;
}

bool Clock::HeardAll() const {
  for (NodeIndex n = 0; n < reports_.size(); ++n) {
    if (!heard_[n]) return false;
    if (roster_.node(n).keeps_snapshots() && reports_[n].safe == kUnknown) return false;
  }
  return true;
}

void Clock::SetRecovery() {
  grant_.safe = recovery_.safe();
  grant_.resume = rebuilding_ ? kUnknown : recovery_.ResumeAt(grant_.through);
}

void Clock::NoteIncarnation(NodeIndex node, std::uint32_t number) {
  if (number <= incarnation(node)) return;
  SetIncarnation(node, number);
  ForgetReport(node);
}

void Clock::SetIncarnation(NodeIndex node, std::uint32_t number) {
  if (number == incarnation(node)) return;
  grant_.incarnations.resize(reports_.size(), 0);
  grant_.incarnations[node] = number;
}

Step Clock::reached(NodeIndex node) const {
  return roster_.node(node).role == Role::kService ? std::max<Step>(grant_.through, 0) : reports_[node].progress;
}

Recovery::Decision Clock::HandleLoss(NodeIndex node) {
  auto decision = recovery_.Lost(node, reached(node));
  if (decision.policy == Policy::kRestart) ExpectRestart(node);
  SetRecovery();
  return decision;
}

void Clock::ExpectRestart(NodeIndex node) {
  SetIncarnation(node, incarnation(node) + 1);
  ForgetReport(node);
}

void Clock::ForgetReport(NodeIndex node) {
  Report unheard;
  unheard.node = node;
  unheard.incarnation = incarnation(node);
  reports_[node] = unheard;
  heard_[node] = false;
}

std::vector<std::string> Clock::Missing(Phase phase) const {
  std::vector<std::string> names;
  for (NodeIndex n = 0; n < reports_.size(); ++n) {
    if (IsMissing(n, phase)) names.push_back(roster_.node(n).name);
  }
  return names;
}

bool Clock::IsMissing(NodeIndex n, Phase phase) const {
  return !heard_[n] || reports_[n].phase < phase || reports_[n].phase >= Phase::kFailed;
}

bool Clock::HaveAll(Phase phase) const {
  for (NodeIndex n = 0; n < reports_.size(); ++n) {
    if (IsMissing(n, phase)) return false;
  }
  return true;
}

bool Clock::all_ready() const { return HaveAll(Phase::kReady); }
bool Clock::all_finished() const { return HaveAll(Phase::kFinished); }

bool Clock::all_sources_finished() const {
  for (NodeIndex n = 0; n < reports_.size(); ++n) {
    if (roster_.node(n).is_sink()) continue;
    if (!heard_[n] || reports_[n].phase != Phase::kFinished) return false;
  }
  return true;
}

Step Clock::slowest_progress() const {
  Step slowest = std::numeric_limits<Step>::max();
  for (NodeIndex n = 0; n < reports_.size(); ++n) {
    if (roster_.node(n).role == Role::kStepped) slowest = std::min(slowest, reports_[n].progress);
  }
  return slowest == std::numeric_limits<Step>::max() ? 0 : slowest;
}

Step Clock::window_limit() const { return slowest_progress() + roster_.window(); }

Grant Clock::Update(Step pace_limit) {
  if (grant_.abort || grant_.final || !all_ready()) return grant_;
  const Step limit = std::min(window_limit(), pace_limit);
  grant_.through = std::max(grant_.through, last_step_ ? std::min(limit, *last_step_) : limit);
  if (last_step_ && grant_.through >= *last_step_) grant_.final = true;
  return grant_;
}

void Clock::Stop() {
  if (grant_.through < 0) return Abort("stopped before the first step");
  grant_.final = true;
}

void Clock::Abort(std::string reason) {
  if (grant_.abort) return;  // the first reason is the one that counts
  grant_.abort = true;
  grant_.reason = std::move(reason);
}

base::Digest Clock::RunDigest() const {
  base::Digest digest = roster_.hash();
  for (const Report& report : reports_) digest = base::Combine(digest, report.digest);
  return digest;
}

}  // namespace rodeira::lockstep
