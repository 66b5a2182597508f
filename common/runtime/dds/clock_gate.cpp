// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/clock_gate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/base/suggest.hpp"
#include "common/runtime/dds/statements.hpp"

namespace rodeira::dds {

ClockGate::ClockGate(ClockRun& run, std::uint64_t clock_id)
    : run_(run), clock_id_(clock_id), processes_(run.roster.nodes().size()) {
  for (lockstep::NodeIndex n = 0; n < run.roster.nodes().size(); ++n) expected_.push_back(OwnHello(run.launch, n));
}

void ClockGate::Take(const base::Bytes& payload) {
  auto named = DecodeReport(payload);
  if (!named) {
    refusal_ = named.error().Text();
    return;
  }
  Take(named.value());
}

void ClockGate::Take(NamedReport& named) {
  const lockstep::NodeIndex node = run_.roster.Find(named.node);
  if (node == run_.roster.nodes().size()) {
    Say("refused a node named '{}' on host {}, which is not in the roster{}", OneLine(named.node), named.hello.host,
        base::DidYouMean(named.node, run_.roster.Names()));
    return;
  }
  if (named.clock_id != 0 && named.clock_id != clock_id_) return;  // meant for another clock
  named.report.node = node;
  if (IsOfTheLost(named.report)) return;
  if (auto status = MayTakePart(node, named); !status) {
    refusal_ = status.error().Text();
    return;
  }
  Note(named.report);
}

void ClockGate::Take(const LastWord& word) {
  const lockstep::NodeIndex node = run_.roster.Find(word.node);
  if (node == run_.roster.nodes().size()) return;
  lockstep::Report report = run_.clock.report(node);
  report.node = node;
  report.incarnation = word.incarnation;
  report.phase = word.phase;
  report.progress = std::max(report.progress, word.step);
  report.message = word.text;
  if (!IsOfTheLost(report)) Note(report);
}

// Nothing more is to be done with it: of an incarnation that is over, or of a node that is lost.
bool ClockGate::IsOfTheLost(const lockstep::Report& report) {
  if (report.incarnation < run_.clock.incarnation(report.node)) return true;
  if (report.phase != lockstep::Phase::kLost) return false;
  lost_.push_back({run_.roster.node(report.node).name, report.incarnation, report.message});
  return true;
}

void ClockGate::Note(const lockstep::Report& report) {
  const lockstep::Wall now = run_.Now();
  run_.watchdog.Heard(report, now.monotonic_ns / 1'000'000);
  run_.missed.Heard(report.node, now.monotonic_ns);
  if (auto status = run_.clock.Take(report); !status) Say("refused {}", OneLine(status.error().Text()));
}

base::Status ClockGate::MayTakePart(lockstep::NodeIndex node, const NamedReport& named) {
  if (world_ == 0) world_ = named.hello.world;
  expected_[node].world = world_;
  if (auto status = CheckHello(expected_[node], named.hello); !status) {
    return status.error()
        .WithMessage(fmt::format("node '{}' (process {} on host {}) was refused: {}", named.node, named.hello.pid,
                                 named.hello.host, status.error().Text()))
        .WithContext("");
  }
  if (auto status = CheckOnce(node, named); !status) return status;
  return run_.clock.recovery().CheckState(named.report);
}

// Two processes as one node, of one incarnation: its program was started twice. The second one may fail before it has
// said anything else; a first report that is a failure is not the node's process yet.
base::Status ClockGate::CheckOnce(lockstep::NodeIndex node, const NamedReport& named) {
  if (named.hello.pid == 0) return {};  // of the follower on the node's PC
  const ProcessIdentity now{named.report.incarnation, named.hello.host, named.hello.pid};
  ProcessIdentity& known = processes_[node];
  if (named.report.phase >= lockstep::Phase::kFailed && known.incarnation != now.incarnation) return {};
  if (named.report.phase >= lockstep::Phase::kFailed && known.pid == 0) return {};
  if (known.pid == 0 || known.incarnation < now.incarnation) known = now;
  if (known.incarnation != now.incarnation || (known.pid == now.pid && known.host == now.host)) return {};
  return base::WrongInput(
      "run.duplicate_node",
      fmt::format("node '{}' runs twice, as process {} on host {} and as process {} on host {}; end one of them",
                  named.node, known.pid, known.host, now.pid, now.host));
}

std::vector<LostNode> ClockGate::TakeLost() { return std::exchange(lost_, {}); }

}  // namespace rodeira::dds
