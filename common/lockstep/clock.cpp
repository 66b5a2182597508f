#include "common/lockstep/clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace rodeira::lockstep {

Clock::Clock(const Roster& roster, std::optional<Step> last_step, Step first_step)
    : roster_(roster), last_step_(last_step), first_step_(first_step), reports_(roster.nodes().size()), heard_(roster.nodes().size(), false) {
  grant_.roster = roster.hash();
  for (NodeIndex n = 0; n < reports_.size(); ++n) reports_[n].node = n;
}

base::Status Clock::Take(const Report& report) {
  if (report.node >= roster_.nodes().size()) {
    return base::WrongInput(fmt::format("a report of node number {} was refused: the roster has {} nodes", report.node, reports_.size()));
  }
  const NodeSpec& spec = roster_.node(report.node);
  Report& known = reports_[report.node];
  const auto refuse = [&](std::string why) { return base::WrongInput(std::move(why), fmt::format("report of node '{}'", spec.name)); };
  if (heard_[report.node]) {
    if (report.incarnation < known.incarnation) {
      return refuse(fmt::format("incarnation {} was found, {} is the living one", report.incarnation, known.incarnation));
    }
    if (report.incarnation == known.incarnation) {
      if (report.progress < known.progress) return {};  // overtaken on its way, nothing new
      if (report.phase < known.phase) return {};
    }
  }
  if (report.progress < 0 || report.progress % spec.period != 0) {
    return refuse(fmt::format("progress {} was found, a multiple of the period {} was expected", report.progress, spec.period));
  }
  // Nobody can have run an activation that was not granted: its next one is at most a period behind the grant.
  if (spec.role == Role::kStepped && report.progress > std::max(grant_.through, first_step_) + spec.period) {
    return refuse(fmt::format("progress {} was found, but only step {} is granted", report.progress, grant_.through));
  }
  known = report;
  heard_[report.node] = true;
  return {};
}

std::vector<std::string> Clock::Missing(Phase phase) const {
  std::vector<std::string> names;
  for (NodeIndex n = 0; n < reports_.size(); ++n) {
    if (!heard_[n] || reports_[n].phase < phase || reports_[n].phase >= Phase::kFailed) names.push_back(roster_.node(n).name);
  }
  return names;
}

bool Clock::all_ready() const { return Missing(Phase::kReady).empty(); }
bool Clock::all_finished() const { return Missing(Phase::kFinished).empty(); }

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
