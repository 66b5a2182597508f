// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <optional>
#include <sstream>

#include "common/runtime/dds/options.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/dds/run.hpp"
#include "common/runtime/dds/statements.hpp"
#include "common/runtime/dds/stop_signals.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"
#include "common/runtime/dds/wall_clock.hpp"
#include "common/runtime/dds/wire.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;
namespace topics = idl::topics;
using lockstep::NodeIndex;
using lockstep::Phase;

constexpr auto kClockSilence = 3s;  // as the nodes' own (NodeBus::Settings)
constexpr auto kClosingTime = 3s;   // from an abort to the closing words

// On a PC where the clock does not run: an observer of grants and reports that says what the clock says there, so that
// `rodeira run` shows the same and ends with the same status. Its own word goes to the clock only as the failure of a
// node of its host.
class Follower {
 public:
  Follower(const launch::Launch& launch, const ProcessOptions& options)
      : launch_(launch), roster_(launch.roster()), options_(options), reports_(roster_.nodes().size()) {}

  int Run() {
    auto participant = Participant::Open(DomainOf(options_, launch_, "follower on " + options_.follow));
    if (!participant) return ReportFault(participant.error());
    participant_ = std::move(participant).value();
    if (auto status = Connect(); !status) return ReportFault(status.error());
    if (auto status = supervisor_.Listen(STDIN_FILENO, [this] { OnSupervisor(); }); !status)
      return ReportFault(status.error());
    return Loop();
  }

 private:
  static int ReportFault(const base::Error& error) {
    Say("fault {}", OneLine(error.Text()));
    return error.exit_status();
  }

  void OnSupervisor() {
    if (supervisor_.is_closed()) EndProcessWithin(kEndWithoutSupervisor);
    woken_.notify_one();
  }

  base::Status Connect() {
    auto grants =
        participant_->MakeReader(topics::kGrant, Delivery::kObserve, [this](base::Bytes&& bytes) { OnGrant(bytes); });
    if (!grants) return grants.error();
    grants_ = std::move(grants).value();
    auto reports =
        participant_->MakeReader(topics::kReport, Delivery::kObserve, [this](base::Bytes&& bytes) { OnReport(bytes); });
    if (!reports) return reports.error();
    reports_in_ = std::move(reports).value();
    auto out = participant_->MakeWriter(topics::kReport, Delivery::kBestEffortRepeated);
    if (!out) return out.error();
    reports_out_ = std::move(out).value();
    return {};
  }

  void OnGrant(const base::Bytes& bytes) {
    auto said = DecodeGrant(bytes);
    if (!said) return;
    const lockstep::Grant& grant = said.value().grant;
    const std::lock_guard lock(mutex_);
    // A clock that is met for the first time and ends is that of the run before.
    if (clock_id_ == 0 && (grant.abort || grant.over)) return;
    if (clock_id_ == 0) clock_id_ = said.value().clock_id;
    if (clock_id_ != said.value().clock_id || grant_.over) return;
    heard_at_ = WallClock::now();
    grant_ = grant;
    woken_.notify_one();
  }

  void OnReport(const base::Bytes& bytes) {
    const auto report = DecodeReport(bytes);
    if (!report) return;
    const NodeIndex node = roster_.Find(report.value().node);
    const std::lock_guard lock(mutex_);
    if (node < reports_.size() && report.value().clock_id == clock_id_) reports_[node] = report.value().report;
  }

  struct Now {
    std::uint64_t clock_id = 0;
    lockstep::Grant grant;
    WallClock::time_point heard_at;
    std::vector<std::optional<lockstep::Report>> reports;
  };
  Now Poll() {
    std::unique_lock lock(mutex_);
    woken_.wait_for(lock, 10ms);
    return {clock_id_, grant_, heard_at_, reports_};
  }

  int Loop() {
    std::optional<WallClock::time_point> aborted_at;
    for (;;) {
      const Now now = Poll();
      if (now.clock_id == 0) {
        if (StopSignals() > 0) return ReportFault(base::Failed("run.interrupted", "stopped by a signal"));
        Show([&] { Say("waiting for the clock of run '{}' in domain {}", OneLine(options_.run), options_.domain); });
        continue;
      }
      if (!met_) {
        if (now.grant.through >= 0) {
          return ReportFault(base::WrongInput(
              "run.already_running",
              fmt::format("it is under way already, at step {}, without the processes of this command; "
                          "wait for its end or choose another --run",
                          now.grant.through),
              fmt::format("run '{}' in domain {}", options_.run, options_.domain)));
        }
        met_ = true;
        Say("met");
      }
      if (now.grant.over) return End(now.grant.reason);
      if (now.grant.abort && !aborted_at) {
        aborted_at = WallClock::now();
        Say("fault {}", OneLine(now.grant.reason));
      }
      if (aborted_at && WallClock::now() - *aborted_at > kClosingTime) return 1;
      if (!aborted_at && WallClock::now() - now.heard_at > kClockSilence) {
        return ReportFault(base::Failed(
            "run.clock_lost", fmt::format("the clock has sent nothing for {:.1f} s: it was killed, stopped or cut off",
                                          std::chrono::duration<double>(kClockSilence).count())));
      }
      TellFaults(now);
      TellIncarnations(now);
      ShowProgress(now);
    }
  }

  // What the clock says at the very end is said here too, word for word.
  static int End(const std::string& words) {
    int status = 1;
    std::istringstream lines(words);
    for (std::string line; std::getline(lines, line);) {
      SayLine(line);
      const auto at = line.find(" status=");
      if (line.starts_with("end ") && at != std::string::npos) status = std::atoi(line.c_str() + at + 8);
    }
    return status;
  }

  // Said again until the clock has stopped time or has called for another incarnation of the node.
  void TellFaults(const Now& now) {
    if (now.grant.abort) return;
    for (const LostNode& lost : supervisor_.TakeLost()) {
      const NodeIndex node = roster_.Find(lost.node);
      if (node == roster_.nodes().size()) continue;
      lost_.push_back(
          {node, lost.incarnation, fmt::format("{} (host '{}')", lost.text, options_.follow), Phase::kLost, 0});
    }
    for (LastWord& word : supervisor_.TakeLastWords()) {
      const NodeIndex node = roster_.Find(word.node);
      if (node < roster_.nodes().size())
        lost_.push_back({node, word.incarnation, std::move(word.text), word.phase, word.step});
    }
    std::erase_if(lost_, [&](const Lost& lost) { return IncarnationOf(now, lost.node) > lost.incarnation; });
    for (const Lost& lost : lost_) TellFault(now, lost);
    if (StopSignals() > 0)
      TellFault(now, {AnyOwnNode(), IncarnationOf(now, AnyOwnNode()),
                      fmt::format("it was stopped by a signal (host '{}')", options_.follow), Phase::kFailed, 0});
  }
  struct Lost {
    NodeIndex node = 0;
    std::uint32_t incarnation = 0;
    std::string text;
    Phase phase = Phase::kLost;
    lockstep::Step step = 0;  // at least
  };
  void TellFault(const Now& now, const Lost& lost) {
    NamedReport report;
    report.node = roster_.node(lost.node).name;
    report.clock_id = now.clock_id;
    report.hello = OwnHello(launch_, lost.node);
    report.hello.pid = 0;  // not the node's own word
    if (now.reports[lost.node]) report.report = *now.reports[lost.node];
    report.report.incarnation = lost.incarnation;
    report.report.phase = lost.phase;
    report.report.progress = std::max(report.report.progress, lost.step);
    report.report.message = lost.text;
    (void)reports_out_->Write(EncodeReport(report));
  }
  static std::uint32_t IncarnationOf(const Now& now, NodeIndex node) {
    return node < now.grant.incarnations.size() ? now.grant.incarnations[node] : 0;
  }

  // The clock calls for another incarnation of a node by its grant; what starts processes on this host is told.
  void TellIncarnations(const Now& now) {
    incarnations_.resize(roster_.nodes().size(), 0);
    for (NodeIndex n = 0; n < incarnations_.size(); ++n) {
      if (IncarnationOf(now, n) <= incarnations_[n]) continue;
      incarnations_[n] = IncarnationOf(now, n);
      if (launch_.node(n).host == options_.follow)
        Say("restart {} {} asked for by the clock", launch_.node(n).name, incarnations_[n]);
    }
  }
  NodeIndex AnyOwnNode() const {
    for (NodeIndex n = 0; n < launch_.nodes().size(); ++n) {
      if (launch_.node(n).host == options_.follow) return n;
    }
    return 0;
  }

  template <class What>
  void Show(What what) {
    if (WallClock::now() - shown_ < 200ms) return;
    shown_ = WallClock::now();
    what();
  }
  void ShowProgress(const Now& now) {
    if (now.grant.abort) return;
    if (now.grant.through < 0) {
      Show([&] { Say("waiting for {}", fmt::join(NotReady(now), ", ")); });
      return;
    }
    if (!began_) {
      began_ = WallClock::now();
      Say("ready");
    }
    const double wall_s = std::chrono::duration<double>(WallClock::now() - *began_).count();
    Show([&] { Say("progress step={} wall_s={:.3f}", SlowestProgress(now), wall_s); });
  }
  std::vector<std::string> NotReady(const Now& now) const {
    std::vector<std::string> names;
    for (NodeIndex n = 0; n < now.reports.size(); ++n) {
      if (!now.reports[n] || now.reports[n]->phase < Phase::kReady) names.push_back(roster_.node(n).name);
    }
    return names;
  }
  lockstep::Step SlowestProgress(const Now& now) const {
    lockstep::Step slowest = std::numeric_limits<lockstep::Step>::max();
    for (NodeIndex n = 0; n < now.reports.size(); ++n) {
      if (roster_.node(n).role == lockstep::Role::kStepped)
        slowest = std::min(slowest, now.reports[n] ? now.reports[n]->progress : 0);
    }
    return slowest == std::numeric_limits<lockstep::Step>::max() ? 0 : slowest;
  }

  const launch::Launch& launch_;
  const lockstep::Roster& roster_;
  const ProcessOptions& options_;
  SupervisorPipe supervisor_;
  bool met_ = false;
  std::optional<WallClock::time_point> began_;
  WallClock::time_point shown_{};
  std::mutex mutex_;
  std::condition_variable woken_;
  std::uint64_t clock_id_ = 0;  // 0: not heard yet
  lockstep::Grant grant_;
  WallClock::time_point heard_at_{};
  std::vector<std::optional<lockstep::Report>> reports_;
  std::vector<Lost> lost_;
  std::vector<std::uint32_t> incarnations_;
  std::unique_ptr<Participant> participant_;  // outlives its endpoints
  std::unique_ptr<Writer> reports_out_;
  std::unique_ptr<Reader> grants_;
  std::unique_ptr<Reader> reports_in_;
};

}  // namespace

int FollowClock(const launch::Launch& launch, const ProcessOptions& options) {
  CountStopSignals();
  return Follower(launch, options).Run();
}

}  // namespace rodeira::dds
