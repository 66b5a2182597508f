// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/in_process_parts.hpp"

#include "common/core/base/assert.hpp"

namespace rodeira::lockstep {

void ReportServices(const Roster& roster, Clock& clock) {
  for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    if (roster.node(n).role != Role::kService) continue;
    Report report;
    report.node = n;
    report.phase = Phase::kFinished;
    RODEIRA_ASSERT(clock.Take(report).ok());
  }
}

std::vector<std::vector<NodeIndex>> ConsumersOf(const Roster& roster) {
  std::vector<std::vector<NodeIndex>> consumers(roster.sources().size());
  for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    for (const Port& port : roster.node(n).inputs) {
      for (const SourceIndex source : port.sources) consumers[source].push_back(n);
    }
  }
  return consumers;
}

Runner::Settings RunnerSettings(const InProcessSettings& settings, NodeIndex n) {
  Runner::Settings out;
  out.snapshot_every = settings.snapshot_every;
  if (!settings.resume.empty()) out.resume = settings.resume[n];
  return out;
}

RunOutcome OutcomeOf(const Clock& clock, const std::string& fault) {
  RunOutcome outcome;
  outcome.ok = fault.empty() && clock.all_finished() && !clock.grant().abort;
  outcome.fault = !fault.empty() ? fault : clock.grant().reason;
  outcome.last_step = clock.grant().through;
  outcome.digest = clock.RunDigest();
  for (NodeIndex n = 0; n < clock.roster().nodes().size(); ++n) outcome.reports.push_back(clock.report(n));
  return outcome;
}

}  // namespace rodeira::lockstep
