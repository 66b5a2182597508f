// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/wait_chain.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rodeira::lockstep {
namespace {

bool Stands(const Report& report) { return report.phase < Phase::kFinished && report.waiting != Waiting::kGrant; }

std::string Doing(const Report& report) {
  const double since_s = static_cast<double>(report.since_ms) * 1e-3;
  switch (report.waiting) {
    case Waiting::kServer:
      return fmt::format("waits at step {} for a server's answer since {:.1f} s", report.progress, since_s);
    case Waiting::kOutput:
      return fmt::format("still writes the output of the steps before {}, since {:.1f} s", report.progress, since_s);
    default:
      break;
  }
  if (report.phase >= Phase::kFailed) return std::string(PhaseName(report.phase));
  if (report.phase == Phase::kStarting) return fmt::format("is {}", PhaseName(report.phase));
  return fmt::format("computes step {} since {:.1f} s", report.progress, since_s);
}

}  // namespace

std::string WaitChain(const Roster& roster, const std::vector<Report>& reports) {
  const Report* at = nullptr;
  for (NodeIndex n = 0; n < reports.size(); ++n) {
    if (roster.node(n).role != Role::kStepped || !Stands(reports[n])) continue;
    if (at == nullptr || reports[n].progress < at->progress) at = &reports[n];
  }
  if (at == nullptr) return "";
  std::string chain;
  std::vector<bool> seen(reports.size(), false);
  while (at->waiting == Waiting::kInputs && at->phase < Phase::kFailed &&
         at->waiting_source < roster.sources().size() && !seen[at->node]) {
    seen[at->node] = true;
    const NodeIndex on = roster.source(at->waiting_source).node;
    chain += fmt::format("'{}' waits for '{}', ", roster.node(at->node).name, roster.node(on).name);
    at = &reports[on];
  }
  if (at->waiting == Waiting::kGrant && at->phase < Phase::kFailed) return "";
  const bool has_cause = at->phase < Phase::kFinished && !at->message.empty();
  return chain + fmt::format("'{}' {}{}", roster.node(at->node).name, Doing(*at),
                             has_cause ? fmt::format(" and {}", at->message) : "");
}

}  // namespace rodeira::lockstep
