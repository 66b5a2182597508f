// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/recovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rodeira::lockstep {
namespace {

constexpr int kMaxTimes = 4;

}  // namespace

Beginning BeginningOf(const Roster& roster, NodeIndex node, const Grant& grant, Step has_through) {
  if (grant.through < 0) return {};
  const RosterNode& spec = roster.node(node);
  if (spec.keeps_snapshots()) return {0, CeilTo(has_through + 1, spec.period)};
  if (spec.is_sink()) return {0, CeilTo(std::max<Step>(grant.through - roster.window(), 0), spec.period)};
  return {grant.resume, 0};
}

Recovery::Recovery(const Roster& roster, std::vector<Policy> policies)
    : roster_(roster),
      policies_(std::move(policies)),
      safe_of_(roster.nodes().size(), -1),
      incarnations_(roster.nodes().size()) {
  policies_.resize(roster.nodes().size(), Policy::kStop);
  const bool is_restart_wanted =
      std::any_of(policies_.begin(), policies_.end(), [](Policy policy) { return policy != Policy::kStop; });
  restarts_ = is_restart_wanted && std::any_of(roster.nodes().begin(), roster.nodes().end(),
                                               [](const RosterNode& node) { return node.keeps_snapshots(); });
  for (const RosterNode& node : roster.nodes()) {
    if (node.role != Role::kStepped) continue;
    ahead_ = std::max(ahead_, node.delay);
    has_other_sinks_ = has_other_sinks_ || (node.is_sink() && !node.keeps_snapshots());
    if (node.snapshots) every_ = roster.source(*node.snapshots).period;
  }
}

base::Status Recovery::CheckState(const Report& report) const {
  if (!report.cannot_save || policies_[report.node] != Policy::kRestart) return {};
  const std::string& name = roster_.node(report.node).name;
  return base::WrongInput(
      "launch.node_without_state",
      fmt::format("node '{}' cannot save its state, so it cannot be started again; 'stop' or 'pause' was expected as "
                  "nodes.{}.recovery",
                  name, name));
}

void Recovery::Heard(const Report& report) {
  Incarnation& incarnation = incarnations_[report.node];
  const bool is_there = roster_.node(report.node).role == Role::kService || report.progress >= incarnation.farthest;
  if (report.phase >= Phase::kReady && report.phase < Phase::kFailed && is_there) incarnation.back = true;
  if (!roster_.node(report.node).keeps_snapshots()) return;
  Step& own = safe_of_[report.node];
  own = std::max(own, report.safe);
  Step all = kNever;
  for (NodeIndex n = 0; n < safe_of_.size(); ++n) {
    if (roster_.node(n).keeps_snapshots()) all = std::min(all, safe_of_[n]);
  }
  safe_ = std::max(safe_, all);
}

Step Recovery::Newest() const { return every_ == 0 ? 0 : std::max<Step>(FloorTo(safe_ - ahead_, every_), 0); }

Step Recovery::resume() const {
  Step resume = Newest();
  for (const Incarnation& incarnation : incarnations_) {
    if (!incarnation.back) resume = std::min(resume, incarnation.resume);
  }
  return resume;
}

void Recovery::InitialiseFrom(const std::vector<Report>& reports, Step granted) {
  for (NodeIndex n = 0; n < incarnations_.size(); ++n) {
    // A node that is behind after a restart is not sent back, and needs what is valid from its next activation on.
    const bool runs = reports[n].phase >= Phase::kReady && roster_.node(n).role == Role::kStepped;
    const Step reached = every_ == 0 ? 0 : FloorTo(reports[n].progress, every_);
    Incarnation& incarnation = incarnations_[n];
    incarnation.resume = runs ? std::min(Newest(), reached) : Newest();
    incarnation.farthest = std::max(incarnation.farthest, granted);
    incarnation.back = false;
  }
}

Step Recovery::ResumeAt(Step granted) const {
  if (!has_other_sinks_ || every_ == 0) return resume();
  return std::min(resume(), FloorTo(std::max<Step>(granted - roster_.window(), 0), every_));
}

Recovery::Decision Recovery::Lost(NodeIndex node, Step progress) {
  if (policies_[node] != Policy::kRestart) return {policies_[node], ""};
  Incarnation& incarnation = incarnations_[node];
  incarnation.times = progress <= incarnation.farthest ? incarnation.times + 1 : 1;
  if (incarnation.times >= kMaxTimes)
    return {Policy::kStop, fmt::format("it was lost {} times without getting beyond step {}", incarnation.times,
                                       incarnation.farthest)};
  incarnation.resume = resume();  // not beyond where an earlier incarnation was sent to, as long as it is not back
  incarnation.farthest = std::max(incarnation.farthest, progress);
  incarnation.back = false;
  return {Policy::kRestart, ""};
}

}  // namespace rodeira::lockstep
