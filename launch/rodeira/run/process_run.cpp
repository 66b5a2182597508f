// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/process_run.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/runtime/dds/network_state.hpp"
#include "common/runtime/launch/command_answer.hpp"
#include "launch/rodeira/run/control_folder.hpp"
#include "launch/rodeira/run/failure_report.hpp"
#include "launch/rodeira/run/node_processes.hpp"
#include "launch/rodeira/run/operator.hpp"
#include "launch/rodeira/run/run_report.hpp"
#include "launch/rodeira/run/shared_memory.hpp"
#include "launch/rodeira/run/silent_nodes.hpp"
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

using namespace std::chrono_literals;

// After the first SIGINT, SIGTERM or SIGHUP a run has two seconds: an orderly stop, an abort by the clock, force.
constexpr auto kOrderlyStop = 1100ms, kAbortedStop = 1600ms;

std::atomic<int> g_interrupts = 0;
void CountInterrupt(int) { ++g_interrupts; }

// The processes of a run, their clock's words, and their end.
class ProcessRun {
 public:
  ProcessRun(const RunOptions& options, const Placement& placement, const launch::Launch& launch,
             launch::Overrides overrides)
      : options_(options),
        placement_(placement),
        launch_(launch),
        processes_(options, placement, launch, std::move(overrides)),
        network_need_(dds::NeedOf(launch)) {
    RemoveLeftOvers({});  // of dead runs
    before_ = SharedMemoryFiles();
    if (placement.has_clock()) operator_.emplace(options.run, options.quiet);
    if (operator_) operator_->Listen(PauseButtons::Open(launch));
  }

  int Run() {
    struct sigaction action {};
    action.sa_handler = CountInterrupt;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    ::sigaction(SIGHUP, &action, nullptr);
    ::signal(SIGPIPE, SIG_IGN);
    base::Status status = processes_.StartClock();
    if (status.ok() && placement_.has_clock()) status = processes_.StartNodes();
    if (!status) {
      processes_.EndAll(report_.ended, interrupted_at_);
      return base::PrintError("rodeira", status.error());
    }
    status = Watch();
    processes_.EndAll(report_.ended, interrupted_at_);
    RemoveLeftOvers(before_);
    if (!status) return base::PrintError("rodeira", status.error());
    Close();
    return ExitStatus();
  }

 private:
  base::Status RestartClock(const std::string& reason) {
    const NodeProcesses::ClocksPlace place{report_.clock_id, report_.begun_ns, report_.pace, report_.paused};
    if (auto status = processes_.RestartClock(place); !status) return status;
    pending_.clear();
    told_.clear();  // the old one may have died before it heard
    exits_told_.clear();
    const base::Error lost = base::Failed("run.clock_lost", "the clock was lost; ask again");
    for (const auto& [number, answer] : answers_) answer(launch::AnswerLine(lost));
    answers_.clear();
    report_.recovered.push_back(reason + "; started again");
    Tell(report_.recovered.back());
    return {};
  }
  base::Status RestartNode(const RunReport::Restart& restart) {
    const auto done = processes_.RestartNode(restart.node, restart.incarnation);
    if (!done) return done.error();
    if (done.value() == NodeProcesses::Restarted::kElsewhere) return {};
    told_.erase(restart.node);
    if (!restart.reason.empty()) Tell(restart.reason + "; it is started again");
    return {};
  }

  // Until the clock has ended, by itself or not.
  base::Status Watch() {
    while (true) {
      ReadClock(50);
      // Beside a clock elsewhere nothing begins before it is met: this PC may wait for the others as long as it likes.
      if (report_.met && !processes_.has_nodes() && NetworkRuns()) {
        if (auto status = processes_.StartNodes(); !status) return status;
      }
      if (!report_.wanted.empty() && NetworkRuns()) {
        for (const RunReport::Restart& restart : std::exchange(report_.wanted, {})) {
          if (auto status = RestartNode(restart); !status) return status;
        }
      }
      for (const std::string& reason : std::exchange(report_.paused_by, {})) {
        Tell(reason +
             "; the run waits: it goes on when the node does; `rodeira ctl restart NODE` or `rodeira ctl stop` decide "
             "otherwise");
      }
      processes_.Poll();
      Child& clock = processes_.clock();
      if ((clock.ended() || clock.stopped()) && MayRestartClock()) {
        if (auto status = RestartClock(fmt::format("the clock {} at about step {}", clock.Fate(), report_.step));
            !status)
          return status;
        continue;
      }
      if (clock.ended()) {
        while (ReadClock(0)) {
        }
        if (!report_.ended && clock.exit_status() != 2)
          Fault(fmt::format("the {} {} at about step {}", clock.name(), clock.Fate(), report_.step));
        return {};
      }
      if (clock.stopped()) {
        if (!report_.ended) Fault(fmt::format("the {} {} at about step {}", clock.name(), clock.Fate(), report_.step));
        return {};
      }
      for (const Child& child : processes_.children()) {
        if (&child != &clock) LookAfter(child);
      }
      const int interrupts = g_interrupts;
      if (interrupts > 0 && !interrupted_at_) interrupted_at_ = WallClock::now();
      for (; passed_on_ < interrupts; ++passed_on_) clock.Signal(SIGINT);
      if (interrupted_at_ && !report_.ended) {
        const auto passed = WallClock::now() - *interrupted_at_;
        if (passed > kOrderlyStop && !std::exchange(told_to_abort_, true)) clock.Send("abort");
        if (passed > kAbortedStop) {
          Fault(fmt::format("stopped by a signal: the {} did not end the run within {:.1f} s", clock.name(),
                            std::chrono::duration<double>(kAbortedStop).count()));
          return {};
        }
      }
      AskClock();
      LookAtNetwork();
      ShowProgress();
    }
  }
  // What the operator asks for goes to the clock; its answer comes among its other words.
  void AskClock() {
    // A client that floods waits: the processes are looked after in between.
    constexpr int kMaxAtATime = 16;
    for (int i = 0; i < kMaxAtATime; ++i) {
      auto asked = operator_ ? operator_->Next() : std::nullopt;
      if (!asked) return;
      // What would end a line or a text is no part of a command.
      std::replace_if(
          asked->line.begin(), asked->line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
      processes_.clock().Send(fmt::format("do {} {}", ++asked_, asked->line));
      answers_[asked_] = std::move(asked->answer);
    }
  }
  void TakeAnswer(std::string_view line) {
    std::size_t number = 0;
    const auto [end, problem] = std::from_chars(line.data(), line.data() + line.size(), number);
    const auto waiting = answers_.find(number);
    if (problem != std::errc{} || waiting == answers_.end()) return;
    line.remove_prefix(std::min(static_cast<std::size_t>(end - line.data()) + 1, line.size()));
    waiting->second(std::string(line));
    answers_.erase(waiting);
  }
  static bool LeftByItself(const Child& child) {
    return child.ended() && child.exit_status() && *child.exit_status() <= 2 && !child.ended_by_foreign_code();
  }
  void LookAfter(const Child& child) {
    for (const std::string& node : processes_.NodesOf(child)) {
      if (!child.LastWordOf(node).empty() || LeftByItself(child)) {
        TellExit(child, node);
      } else if (child.stopped() || child.ended() || child.killed()) {
        TellClock(child, node);
      } else {
        told_.erase(node);  // it goes on
      }
    }
  }
  // The node's last word; without one the node is lost. The clock knows whether the run goes on without it: a node may
  // leave before the clock's closing words are read here.
  void TellExit(const Child& child, const std::string& node) {
    const std::uint32_t incarnation = processes_.incarnation(node);
    if (!exits_told_.emplace(node, incarnation).second) return;
    const std::string word = child.LastWordOf(node);
    processes_.clock().Send(word.empty() ? fmt::format("lost {} {} {}", node, incarnation, processes_.FateOf(child))
                                         : fmt::format("said {} {} {}", node, incarnation, word));
  }
  // Called for a node that the clock no longer receives reports of.
  std::optional<std::string> FateOfSilent(const std::string& node) {
    processes_.Poll();
    for (const Child& child : processes_.children()) {
      if (!std::ranges::count(processes_.NodesOf(child), node)) continue;
      if (child.ended() || child.stopped() || child.killed())
        return fmt::format("node '{}' {} at about step {}", node, processes_.FateOf(child), report_.step);
    }
    return std::nullopt;
  }
  // Dead or stopped though the run is not over.
  void TellClock(const Child& broken, const std::string& name) {
    if (report_.ended || !fault_.empty() || !told_.insert(name).second) return;
    const std::string fate = processes_.FateOf(broken);
    const launch::LaunchNode& node = launch_.node(launch_.roster().Find(name));
    if (node.recovery == lockstep::Policy::kStop)
      Fault(fmt::format("node '{}' {} at about step {}", name, fate, report_.step));
    processes_.clock().Send(fmt::format("lost {} {} {}", name, processes_.incarnation(name), fate));
  }
  // A clock that is lost again and again without the run getting on has a reason for it. One that had not said its
  // number yet (0) is known to none: another one draws its own.
  bool MayRestartClock() {
    while (ReadClock(0)) {
    }
    const Child& clock = processes_.clock();
    const bool by_itself = clock.ended() && clock.exit_status() && *clock.exit_status() <= 2;
    if (by_itself || report_.ended || !fault_.empty() || g_interrupts > 0) return false;
    if (!placement_.has_clock() || launch_.recovery() != lockstep::Policy::kRestart) return false;
    clocks_losses_ = report_.step > clocks_last_step_ ? 1 : clocks_losses_ + 1;
    clocks_last_step_ = report_.step;
    return clocks_losses_ < 4;
  }
  // Packets arrive up to a second before an interface counts as running; Fast DDS passes over one that does not run
  // when a process starts, for good.
  bool NetworkRuns() const { return !dds::NetworkProblem(network_need_, dds::ReadNetworkState()); }
  // An interface that goes away is named before the nodes that are no longer heard.
  void LookAtNetwork() {
    const auto problem = dds::NetworkProblem(network_need_, dds::ReadNetworkState());
    if (problem && !network_problem_) Tell(*problem);
    if (!problem && network_problem_) Tell("the network of the run is there again");
    network_problem_ = problem;
  }
  // The first fault is the cause, what follows are its consequences; it is said at once.
  void Fault(const std::string& fault) {
    if (!fault_.empty()) return;
    LookAtNetwork();
    fault_ = fault;
    if (!base::ErrorsAreJson()) Tell(fault);  // JSON has the exit status, which is known when the run is closed
  }
  void Tell(const std::string& sentence) {
    fmt::print(stderr, "{}rodeira: {}\n", shown_ ? "\r\033[K" : "", sentence);
    std::fflush(stderr);
  }

  // Reads what the clock has said; false where there was nothing.
  bool ReadClock(int wait_ms) {
    const int out = processes_.clock().out();
    pollfd waiting{out, POLLIN, 0};
    if (::poll(&waiting, 1, wait_ms) <= 0) return false;
    char buffer[4096];
    const ssize_t size = ::read(out, buffer, sizeof(buffer));
    if (size <= 0) {
      if (wait_ms > 0) ::usleep(10'000);  // closed: its end is seen by Poll
      return false;
    }
    pending_.append(buffer, static_cast<std::size_t>(size));
    for (auto end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n')) {
      const std::string_view line = std::string_view(pending_).substr(0, end);
      if (line.starts_with("answer ")) {
        TakeAnswer(line.substr(7));
      } else if (!silent_.Take(line)) {
        report_.Take(silent_.Reworded(std::string(line)));
      }
      pending_.erase(0, end + 1);
      if (!report_.faults.empty()) Fault(report_.faults.front());
    }
    return true;
  }

  void ShowProgress() {
    if (options_.quiet || ::isatty(STDERR_FILENO) == 0 || WallClock::now() - start_ < 2s) return;
    if (!report_.ready) {
      fmt::print(stderr, "\r\033[Kwaiting for {}{}", report_.waiting_for,
                 processes_.has_nodes() ? "" : " on " + placement_.ClocksPlace());
    } else {
      const double simulated_s =
          static_cast<double>(report_.step) * static_cast<double>(launch_.roster().base_step_ns()) * 1e-9;
      fmt::print(stderr, "\r\033[K{:.1f} s simulated, {:.1f} s passed, {:.2f} × real time{}{}", simulated_s,
                 report_.wall_s, report_.wall_s > 0.0 ? simulated_s / report_.wall_s : 0.0,
                 report_.paused ? ", paused" : "", operator_ && operator_->has_keys() ? " (h: keys)" : "");
    }
    shown_ = true;
  }

  void Close() {
    if (shown_) fmt::print(stderr, "\r\033[K");
    report_.faults = fault_.empty() ? std::vector<std::string>() : std::vector<std::string>{fault_};
    for (const std::string& remark : report_.remarks) fmt::print(stderr, "rodeira: {}\n", remark);
    if (base::ErrorsAreJson() && ExitStatus() != 0)
      base::PrintError("rodeira", ExitStatus() == 2 ? base::WrongInput("run.refused", FaultText())
                                                    : base::Failed("run.failed", FaultText()));
    LeaveReport();
    if (!report_.ready || options_.quiet) return;
    fmt::print("{}", report_.Table(static_cast<double>(launch_.roster().base_step_ns()) * 1e-9, options_.record));
  }

  // Of a run that failed: one file with everything that is known.
  void LeaveReport() const {
    if (ExitStatus() != 1) return;
    std::vector<FailedPart> parts;
    for (const Child& child : processes_.children())
      parts.push_back({child.name(), child.Fate(), processes_.LogOf(child.name())});
    const auto file = FailureFile(options_.record, launch_.name());
    const auto written = base::WriteWhole(file, FailureText(FaultText(), launch_, parts));
    if (written.ok())
      fmt::print(stderr, "rodeira: report of the failure: {}\n", file.string());
    else
      fmt::print(stderr, "rodeira: the report of the failure cannot be written: {}\n", written.error().Text());
  }

  std::string FaultText() const { return fault_.empty() ? "the run did not end in order" : fault_; }

  int ExitStatus() const {
    if (report_.ok && fault_.empty()) return 0;
    for (const Child& child : processes_.children()) {
      if (child.exit_status() == 2) return 2;
    }
    return 1;
  }

  const RunOptions& options_;
  const Placement& placement_;
  const launch::Launch& launch_;
  NodeProcesses processes_;
  std::set<std::string> before_;
  RunReport report_;
  SilentNodes silent_{[this](const std::string& node) { return FateOfSilent(node); }, 500ms};
  std::string fault_;
  std::string pending_;
  std::optional<Operator> operator_;  // where the clock is
  std::size_t asked_ = 0;
  std::map<std::size_t, std::function<void(const std::string&)>> answers_;
  int passed_on_ = 0;
  std::optional<WallClock::time_point> interrupted_at_;
  bool told_to_abort_ = false;
  std::set<std::string> told_;                                  // nodes of which the clock was told that they are lost
  std::set<std::pair<std::string, std::uint32_t>> exits_told_;  // node and incarnation that ended by itself
  std::int64_t clocks_last_step_ = -1;                          // where it was lost …
  int clocks_losses_ = 0;                                       // … so often
  bool shown_ = false;
  const dds::NetworkNeed network_need_;
  std::optional<std::string> network_problem_;
  WallClock::time_point start_ = WallClock::now();
};

}  // namespace

int RunProcesses(const RunOptions& options, const Placement& placement, const launch::Launch& launch,
                 launch::Overrides overrides) {
  // Its nodes would take the names of those of the first one.
  if (placement.has_clock() && IsRunning(options.run)) {
    return base::PrintError(
        "rodeira", base::WrongInput("run.already_running",
                                    fmt::format("run '{}' is going on already on this PC; another --run was expected, "
                                                "or `rodeira ctl stop --run {}` first",
                                                options.run, options.run)));
  }
  return ProcessRun(options, placement, launch, std::move(overrides)).Run();
}

}  // namespace rodeira::cli
