// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/exhaustion.hpp"
#include "common/core/base/log.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/print_error.hpp"
#include "common/runtime/dds/clock_gate.hpp"
#include "common/runtime/dds/clock_losses.hpp"
#include "common/runtime/dds/clock_run.hpp"
#include "common/runtime/dds/clock_words.hpp"
#include "common/runtime/dds/operator_commands.hpp"
#include "common/runtime/dds/options.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/dds/remote_log.hpp"
#include "common/runtime/dds/run.hpp"
#include "common/runtime/dds/shared_memory_room.hpp"
#include "common/runtime/dds/statements.hpp"
#include "common/runtime/dds/stop_signals.hpp"
#include "common/runtime/dds/supervisor_pipe.hpp"
#include "common/runtime/dds/triggers.hpp"
#include "common/runtime/dds/wire.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;
namespace topics = idl::topics;

constexpr auto kStartsForLong = 1000ms;
constexpr auto kOrderlyStop = 1000ms;  // after the end of `rodeira run`

std::uint64_t DrawnIfNone(std::uint64_t clock_id) {
  std::random_device device;
  while (clock_id == 0) clock_id = (static_cast<std::uint64_t>(device()) << 32) | device();
  return clock_id;
}

// The clock's process: its endpoints, its loop, and its end. Attendance of nodes, losses, commands of the operator and
// the run log are in files of their own (clock_*.hpp).
class ClockProcess {
 public:
  ClockProcess(const launch::Launch& launch, const ProcessOptions& options)
      : options_(options),
        clock_id_(DrawnIfNone(options.clock_id)),
        run_(launch, options),
        gate_(run_, clock_id_),
        losses_(run_, [this](lockstep::NodeIndex node) { OnRestart(node); }),
        operator_commands_(run_, losses_) {}

  int Run() {
    DomainSettings settings = DomainOf(options_, run_.launch, "clock");
    settings.serves_discovery = true;
    auto participant = Participant::Open(settings);
    if (!participant) return ReportFault(participant.error());
    participant_ = std::move(participant).value();
    if (auto status = Connect(*participant_); !status) return ReportFault(status.error());
    Say("clock id={} life={}", clock_id_, options_.incarnation);
    Say("starting {} nodes", run_.roster.nodes().size());
    if (options_.listen) {
      if (auto status = supervisor_.Listen(STDIN_FILENO, [this] { OnSupervisor(); }); !status)
        return ReportFault(status.error());
    }
    run_.start = WallClock::now();
    if (options_.incarnation > 0) Resume();
    return Loop();
  }

 private:
  static int ReportFault(const base::Error& error) {
    Say("fault {}", OneLine(error.Text()));
    return error.exit_status();
  }

  base::Status Connect(Participant& participant) {
    // Before anything is said: another clock's word in this run means that this one is too many.
    auto other = participant.MakeReader(topics::kGrant, Delivery::kBestEffortRepeated, [this](base::Bytes&& bytes) {
      const auto grant = DecodeGrant(bytes);
      if (grant && grant.value().clock_id != clock_id_) other_clock_ = grant.value().clock_id;
    });
    if (!other) return other.error();
    others_ = std::move(other).value();
    if (options_.incarnation == 0 && !IsOnlyClock()) std::this_thread::sleep_for(300ms);
    if (other_clock_ != 0) return SecondClock();
    auto reports = participant.MakeReader(topics::kReport, Delivery::kBestEffortRepeated, [this](base::Bytes&& bytes) {
      const std::lock_guard lock(mutex_);
      inbox_.push_back(std::move(bytes));
      woken_.notify_one();
    });
    if (!reports) return reports.error();
    reports_ = std::move(reports).value();
    auto grants = participant.MakeWriter(topics::kGrant, Delivery::kBestEffortRepeated);
    if (!grants) return grants.error();
    grants_ = std::move(grants).value();
    auto log = OpenLogSpeaker(participant, run_.roster.hash(), clock_id_, run_.roster.base_step_ns());
    if (!log) return log.error();
    log_ = std::move(log).value();
    auto triggers = Triggers::Open(participant, options_.run, run_.roster.base_step_ns());
    if (!triggers) return triggers.error();
    triggers_.emplace(std::move(triggers).value());
    return {};
  }
  // `rodeira run`, which listens on the other end of the pipe, holds name and domain of its run on this PC; nothing
  // from another PC comes by shared memory.
  bool IsOnlyClock() const {
    const auto& transport = run_.launch.transport_settings();
    return options_.listen && transport.kind == launch::Transport::kSharedMemory && !transport.has_observers;
  }
  base::Status SecondClock() const {
    return base::WrongInput(
        "run.already_running",
        fmt::format("run '{}' in domain {} has a clock already ({}); choose another --run or --domain", options_.run,
                    options_.domain, base::Hex(other_clock_)));
  }
  // Two clocks that began at the same moment: the one with the larger number is the one too many.
  bool MustYield() const { return other_clock_ != 0 && other_clock_ < clock_id_; }

  // On the thread of the pipe, which reads also while the loop hangs.
  void OnSupervisor() {
    if (supervisor_.is_closed()) EndProcessWithin(kEndWithoutSupervisor);
    woken_.notify_one();
  }

  // A report of a node may have been passed over for want of memory.
  base::Status CheckMemory() const {
    const auto& transport = run_.launch.transport_settings();
    if (transport.kind != launch::Transport::kSharedMemory) return {};
    return CheckAddressSpace(transport.segment_kib);
  }

  // This incarnation of the clock takes the place of one that has died: the nodes' reports say where the run stands.
  void Resume() {
    run_.clock.Rebuild();
    serial_ = options_.incarnation << 24;
    if (options_.begun_ns < 0) return;
    run_.controller.ContinueRun(options_.begun_ns - std::chrono::nanoseconds(run_.start.time_since_epoch()).count(),
                                options_.paused, run_.Now());
  }

  int Loop() {
    auto said = WallClock::now() - 1s;
    bool told_ready = false;
    while (!run_.clock.all_finished()) {
      if (MustYield()) return ReportFault(SecondClock().error());
      TakeReports();
      for (const LastWord& word : supervisor_.TakeLastWords()) gate_.Take(word);
      if (!gate_.refusal().empty()) return Abort({gate_.refusal(), 2});
      if (const auto end = LookAfterLosses()) return Abort(*end);
      if (!told_ready && run_.clock.all_ready()) {
        told_ready = true;
        Say("ready");
      }
      if (!told_ready && WallClock::now() - run_.start > kStartsForLong) {
        if (auto status = CheckMemory(); !status) return Abort({status.error().Text(), 1});
      }
      const lockstep::Grant before = run_.clock.grant();
      operator_commands_.Do(supervisor_.TakeCommands());
      if (run_.clock.grant().abort) return Abort({run_.clock.grant().reason, 1});
      if (operator_commands_.stop_asked() && !run_.missed.empty())
        return Abort({"stopped while the run waited: " + run_.missed.Text(run_.NowNs()), 1});
      const lockstep::Grant grant = run_.controller.Update(run_.Now());
      if (const std::string warning = run_.controller.TakeWarning(); !warning.empty())
        base::Log(base::LogLevel::kWarning, "", warning);
      const auto now = WallClock::now();
      if (grant.through != before.through || grant.final != before.final || now - said >= 10ms) {
        said = now;
        SayGrant(grant);
        ShowProgress(now);
      }
      if (grant.final && run_.clock.all_sources_finished()) run_.controller.CloseLog(run_.Now());
      FlushLog();
      Wait();
    }
    triggers_->SayEnd(run_.clock.grant().through, run_.Now().utc_ns, "ok");
    Close(NodeLines(run_) + EndLine(run_, "ok", run_.clock.grant().through, run_.clock.RunDigest(), 0));
    return 0;
  }

  // The nodes that are lost, as this PC, another one, or the watchdog says; and a signal to this process.
  std::optional<RunTermination> LookAfterLosses() {
    std::vector<LostNode> lost = gate_.TakeLost();
    for (LostNode& one : supervisor_.TakeLost()) lost.push_back(std::move(one));
    for (const LostNode& one : lost) {
      if (auto end = losses_.TakeLost(one)) return end;
    }
    const auto now = WallClock::now();
    if (now - checked_ < 20ms) return std::nullopt;
    checked_ = now;
    if (auto end = losses_.Watch()) return end;
    const int signals = StopSignals();
    if (signals > 2 || supervisor_.must_abort()) return RunTermination{"stopped by a signal" + NotFinished(), 1};
    if (signals > 0 && run_.clock.grant().through < 0) return RunTermination{"stopped by a signal", 1};
    if (signals > 0) operator_commands_.StopBySignal();
    return LookAfterSupervisor(now);
  }
  // Without `rodeira run` the run ends: in order at its last granted step, or after a moment by an abort.
  std::optional<RunTermination> LookAfterSupervisor(WallClock::time_point now) {
    if (!supervisor_.is_closed()) return std::nullopt;
    if (!alone_since_) alone_since_ = now;
    if (run_.clock.grant().through < 0 || now - *alone_since_ > kOrderlyStop)
      return RunTermination{"'rodeira run' has ended" + NotFinished(), 1};
    operator_commands_.StopBySignal();
    return std::nullopt;
  }
  std::string NotFinished() const {
    const auto names = run_.clock.Missing(lockstep::Phase::kFinished);
    return names.empty() ? "" : fmt::format(" before these nodes had finished: '{}'", fmt::join(names, "', '"));
  }
  void OnRestart(lockstep::NodeIndex node) {
    gate_.ExpectRestart(node);
    SayGrant(run_.clock.grant());
  }

  void TakeReports() {
    std::deque<base::Bytes> taken;
    {
      const std::lock_guard lock(mutex_);
      taken.swap(inbox_);
    }
    for (const base::Bytes& bytes : taken) gate_.Take(bytes);
  }
  void Wait() {
    std::unique_lock lock(mutex_);
    const auto due = std::chrono::nanoseconds(run_.controller.NextDueIn(run_.Now()));
    const std::chrono::nanoseconds limit = due > 0ns ? std::min<std::chrono::nanoseconds>(due, 10ms) : 10ms;
    woken_.wait_for(lock, limit, [this] { return !inbox_.empty() || supervisor_.is_waiting(); });
  }

  void SayGrant(const lockstep::Grant& grant) { (void)grants_->Write(EncodeGrant({clock_id_, ++serial_, grant})); }
  void ShowProgress(WallClock::time_point now) {
    if (now - shown_ < 200ms) return;
    shown_ = now;
    SayLine(ProgressLine(run_));
  }
  void FlushLog() {
    const auto batch = run_.controller.log().Take(run_.NowNs());
    if (!batch) return;
    log_->Say(*batch);
    for (const lockstep::Remark& remark : batch->remarks) triggers_->Say(remark);
  }

  // The closing words, here and to the followers on other PCs. Repeated until all must have heard them; one that has
  // gone already does not matter.
  void Close(const std::string& words) {
    lockstep::Grant last = run_.clock.grant();
    last.over = true;
    last.reason = words;
    for (int i = 0; i < 10; ++i) {
      SayGrant(last);
      std::this_thread::sleep_for(5ms);
    }
    SayLine(words);
  }
  // Time stops everywhere; sinks get a moment to close their files.
  int Abort(const RunTermination& end) {
    run_.controller.Abort(end.reason, run_.Now());
    FlushLog();
    triggers_->SayEnd(run_.clock.slowest_progress() - 1, run_.Now().utc_ns, run_.clock.grant().reason);
    Say("fault {}", OneLine(end.reason));
    // At least some times: no process of another PC is told of it by another way.
    for (int i = 0; i < 10 || (i < 100 && !AllSinksHaveFinished()); ++i) {
      SayGrant(run_.clock.grant());
      std::this_thread::sleep_for(10ms);
      TakeReports();
    }
    Close(fmt::format("fault {}\n", OneLine(end.reason)) + NodeLines(run_) +
          EndLine(run_, "aborted", run_.clock.slowest_progress() - 1, 0, end.status));
    return end.status;
  }
  bool AllSinksHaveFinished() const {
    for (lockstep::NodeIndex n = 0; n < run_.roster.nodes().size(); ++n) {
      if (run_.roster.node(n).is_sink() && run_.clock.report(n).phase < lockstep::Phase::kFinished) return false;
    }
    return true;
  }

  const ProcessOptions& options_;
  const std::uint64_t clock_id_;
  ClockRun run_;
  ClockGate gate_;
  ClockLosses losses_;
  OperatorCommands operator_commands_;
  std::uint32_t serial_ = 0;
  std::atomic<std::uint64_t> other_clock_ = 0;
  WallClock::time_point shown_{};
  WallClock::time_point checked_{};
  std::optional<WallClock::time_point> alone_since_;  // without `rodeira run`
  std::mutex mutex_;
  std::condition_variable woken_;
  std::deque<base::Bytes> inbox_;
  SupervisorPipe supervisor_;
  std::unique_ptr<Participant> participant_;  // outlives its endpoints
  std::unique_ptr<Writer> grants_;
  std::unique_ptr<LogSpeaker> log_;
  std::optional<Triggers> triggers_;
  std::unique_ptr<Reader> others_;
  std::unique_ptr<Reader> reports_;
};

}  // namespace

int RunClock(int argc, char** argv) {
  base::PinMathLibrary(argv);
  base::TraceCrashes();
  base::NameExhaustion("rodeira-clock");
  const ParsedOptions parsed = ParseOptions("rodeira-clock", ProgramOf::kClock, argc, argv);
  if (parsed.leave_with) return *parsed.leave_with;
  const auto launch = launch::Launch::Load(parsed.options.launch_file, parsed.options.overrides);
  if (!launch) return base::PrintError("rodeira-clock", launch.error());
  if (!parsed.options.follow.empty()) return FollowClock(launch.value(), parsed.options);
  CountStopSignals();
  return ClockProcess(launch.value(), parsed.options).Run();
}

}  // namespace rodeira::dds
