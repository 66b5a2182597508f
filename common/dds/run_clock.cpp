#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/base/mathematics.hpp"
#include "common/base/suggest.hpp"
#include "common/dds/options.hpp"
#include "common/dds/parents_word.hpp"
#include "common/dds/participant.hpp"
#include "common/dds/remote_log.hpp"
#include "common/dds/run.hpp"
#include "common/dds/statements.hpp"
#include "common/dds/triggers.hpp"
#include "common/dds/wire.hpp"
#include "common/launch/agreement.hpp"
#include "common/launch/command_text.hpp"
#include "common/lockstep/clock.hpp"
#include "common/lockstep/conductor.hpp"
#include "common/lockstep/missed_nodes.hpp"
#include "common/lockstep/wait_chain.hpp"
#include "common/lockstep/watchdog.hpp"
#include "idl/topics.hpp"

namespace rodeira::dds {
namespace {

using namespace std::chrono_literals;
using WallClock = std::chrono::steady_clock;
namespace topics = idl::topics;

std::atomic<int> g_signals = 0;
void OnSignal(int) { ++g_signals; }

class ClockProcess {
 public:
  ClockProcess(const launch::Launch& launch, const ProcessOptions& options)
      : launch_(launch), roster_(launch.roster()), options_(options), clock_(roster_, LastStep(), 0, launch.policies()),
        conductor_(clock_, lockstep::Pacer(roster_.base_step_ns(), options.pace), options.incarnation),
        watchdog_(roster_, launch.watchdog()), own_(OwnHello(launch::Agreement(launch))), clock_id_(options.clock_id) {
    std::random_device device;
    while (clock_id_ == 0) clock_id_ = (static_cast<std::uint64_t>(device()) << 32) | device();
  }

  int Run() {
    DomainSettings settings = DomainOf(options_, launch_, "clock");
    settings.serves_discovery = true;
    auto participant = Participant::Open(settings);
    if (!participant) return Complain(participant.error());
    participant_ = std::move(participant).value();
    if (auto status = Connect(*participant_); !status) return Complain(status.error());
    Say("clock id={} life={}", clock_id_, options_.incarnation);
    Say("starting {} nodes", roster_.nodes().size());
    if (options_.listen) parents_.Listen([this] { woken_.notify_one(); });
    start_ = WallClock::now();
    if (options_.incarnation > 0) GoOn();
    return Loop();
  }

 private:
  std::optional<lockstep::Step> LastStep() const {
    const auto seconds = options_.duration_s ? options_.duration_s : launch_.duration_s();
    if (!seconds) return std::nullopt;
    return static_cast<lockstep::Step>(std::llround(*seconds * 1e9 / static_cast<double>(roster_.base_step_ns())));
  }
  static int Complain(const base::Error& error) {
    Say("fault {}", OneLine(error.Text()));
    return error.exit_status();
  }
  std::int64_t NowNs() const { return std::chrono::nanoseconds(WallClock::now() - start_).count(); }
  lockstep::Wall Now() const {
    return {NowNs(), std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count()};
  }
  double RunSeconds() const { return static_cast<double>(conductor_.RunNs(Now())) * 1e-9; }

  base::Status Connect(Participant& participant) {
    // Before anything is said: another clock's word in this run means that this one is too many.
    auto other = participant.MakeReader(topics::kGrant, Delivery::kSaidAgain, [this](base::Bytes&& bytes) {
      const auto grant = DecodeGrant(bytes);
      if (grant && grant.value().clock_id != clock_id_) other_clock_ = grant.value().clock_id;
    });
    if (!other) return other.error();
    others_ = std::move(other).value();
    if (options_.incarnation == 0) std::this_thread::sleep_for(300ms);
    if (other_clock_ != 0) return SecondClock();
    auto reports = participant.MakeReader(topics::kReport, Delivery::kSaidAgain, [this](base::Bytes&& bytes) {
      const std::lock_guard lock(mutex_);
      inbox_.push_back(std::move(bytes));
      woken_.notify_one();
    });
    if (!reports) return reports.error();
    reports_ = std::move(reports).value();
    auto grants = participant.MakeWriter(topics::kGrant, Delivery::kSaidAgain);
    if (!grants) return grants.error();
    grants_ = std::move(grants).value();
    auto log = OpenLogSpeaker(participant, roster_.hash(), clock_id_, roster_.base_step_ns());
    if (!log) return log.error();
    log_ = std::move(log).value();
    auto triggers = Triggers::Open(participant, options_.run, roster_.base_step_ns());
    if (!triggers) return triggers.error();
    triggers_.emplace(std::move(triggers).value());
    return {};
  }
  base::Status SecondClock() const {
    return base::WrongInput(fmt::format("run '{}' in domain {} has a clock already ({}); choose another --run or --domain", options_.run, options_.domain,
                                        base::Hex(other_clock_)));
  }

  // This life of the clock takes the place of one that has died: the nodes' reports say where the run stands.
  void GoOn() {
    clock_.Rebuild();
    serial_ = options_.incarnation << 24;
    if (options_.begun_ns < 0) return;
    conductor_.GoOn(options_.begun_ns - std::chrono::nanoseconds(start_.time_since_epoch()).count(), options_.paused, Now());
    conductor_.NoteFault(fmt::format("the clock was lost; this is its life {}", options_.incarnation + 1), Now());
  }

  // "answer NUMBER ok|wrong|failed SENTENCE".
  void DoCommands() {
    for (const std::string& line : parents_.TakeAsked()) {
      const auto space = std::min(line.find(' '), line.size());
      const std::string number = line.substr(0, space);
      const auto command = launch::ParseCommand(std::string_view(line).substr(space));
      const auto done = command ? Do(command.value()) : base::Result<std::string>(command.error());
      const std::string_view how = done ? "ok" : done.error().code == base::ErrorCode::kWrongInput ? "wrong" : "failed";
      Say("answer {} {} {}", number, how, OneLine(done ? done.value() : done.error().Text()));
    }
  }
  base::Result<std::string> Do(const lockstep::Command& command) {
    using Kind = lockstep::Command::Kind;
    if (command.kind == Kind::kRestart) return RestartByHand(command.text);
    stop_asked_ = stop_asked_ || command.kind == Kind::kStop;
    auto done = conductor_.Do(command, Now());
    if (!done || command.kind != Kind::kState) return done;
    if (!missed_.empty()) return done.value() + "; it stands: " + missed_.Text(NowNs());
    const std::string chain = lockstep::WaitChain(roster_, clock_.reports());
    return chain.empty() ? done : done.value() + "; " + chain;
  }
  base::Result<std::string> RestartByHand(const std::string& name) {
    const lockstep::NodeIndex node = roster_.Find(name);
    if (node == roster_.nodes().size()) return base::WrongInput(fmt::format("there is no node '{}'{}", name, base::DidYouMean(name, roster_.Names())), "restart");
    if (!clock_.recovery().restarts()) {
      return base::Failed("in this run nobody keeps what a node needs that is started again; a recorder and 'recovery: pause' or 'restart' in its launch file do");
    }
    if (launch_.node(node).is_live()) return base::Failed(fmt::format("node '{}' is driven by a person, whose input cannot be computed again", name));
    if (clock_.report(node).cannot_save) return base::Failed(fmt::format("node '{}' cannot save its state, so it cannot be started again", name));
    Restart(node, fmt::format("node '{}' at about step {}: asked for by the operator", name, clock_.reached(node)));
    return fmt::format("'{}' is started again", name);
  }

  // Names the fault and does what the node's policy says; a status where that is the end of the run.
  std::optional<int> Lose(lockstep::NodeIndex node, const std::string& reason, int status) {
    if (clock_.grant().abort || clock_.report(node).phase == lockstep::Phase::kFinished) return std::nullopt;
    const auto decision = clock_.Lose(node);
    switch (decision.policy) {
      case lockstep::Policy::kStop: return Abort(decision.why.empty() ? reason : reason + "; " + decision.why, status);
      case lockstep::Policy::kPause:
        watchdog_.Excuse(node);
        Say("paused {} {}", roster_.node(node).name, OneLine(reason));
        conductor_.NoteFault(reason + "; the run waits for it", Now());
        missed_.Lost(node, reason, NowNs());
        return std::nullopt;
      case lockstep::Policy::kRestart: Announce(node, reason); return std::nullopt;
    }
    return std::nullopt;
  }
  void Restart(lockstep::NodeIndex node, const std::string& reason) {
    clock_.ExpectNextLife(node);
    Announce(node, reason);
  }
  // To `rodeira run`, here by this line and on other PCs by the lives in the grant, which end the old process and start another.
  void Announce(lockstep::NodeIndex node, const std::string& reason) {
    watchdog_.ExpectNextLife(node, NowNs() / 1'000'000);
    missed_.Restarted(node);
    who_[node] = {};
    Say("restart {} {} {}", roster_.node(node).name, clock_.life(node), OneLine(reason));
    conductor_.NoteFault(reason + "; it is started again", Now());
    SayGrant(clock_.grant());
  }

  // "NODE TEXT" of a process that died or was stopped, as `rodeira run` saw it.
  std::optional<int> TakeLost(const std::string& lost) {
    const auto space = std::min(lost.find(' '), lost.size());
    const lockstep::NodeIndex node = roster_.Find(lost.substr(0, space));
    if (node == roster_.nodes().size()) return std::nullopt;
    const std::string what = space < lost.size() ? lost.substr(space + 1) : "was lost";
    return Lose(node, fmt::format("node '{}' {} at about step {}", roster_.node(node).name, what, clock_.reached(node)), 1);
  }

  void FlushLog() {
    const auto batch = conductor_.log().Take(NowNs());
    if (!batch) return;
    log_->Say(*batch);
    for (const lockstep::Remark& remark : batch->remarks) triggers_->Say(remark);
  }

  // Two clocks that began at the same moment: the one with the larger number is the one too many.
  bool MustYield() const { return other_clock_ != 0 && other_clock_ < clock_id_; }

  int Loop() {
    auto said = WallClock::now() - 1s;
    auto checked = said;
    bool told_ready = false;
    while (!clock_.all_finished()) {
      if (MustYield()) return Complain(SecondClock().error());
      TakeReports();
      if (!refusal_.empty()) return Abort(refusal_, 2);
      for (std::string& lost : parents_.TakeLost()) lost_.push_back(std::move(lost));
      for (const std::string& lost : std::exchange(lost_, {})) {
        if (const auto status = TakeLost(lost)) return *status;
      }
      const auto now = WallClock::now();
      if (now - checked >= 20ms) {
        checked = now;
        if (auto fault = watchdog_.Check(NowNs() / 1'000'000)) {
          if (const auto status = TakeFault(*fault)) return *status;
        }
        if (const int signals = g_signals; signals > 0) {
          if (signals > 2 || clock_.grant().through < 0) return Abort("stopped by a signal", 1);
          conductor_.Stop(Now());
          stop_asked_ = true;
        }
      }
      if (!told_ready && clock_.all_ready()) {
        told_ready = true;
        Say("ready");
      }
      const lockstep::Grant before = clock_.grant();
      DoCommands();
      if (clock_.grant().abort) return Abort(clock_.grant().reason, 1);
      if (stop_asked_ && !missed_.empty()) return Abort("stopped while the run waited: " + missed_.Text(NowNs()), 1);
      const lockstep::Grant grant = conductor_.Move(Now());
      if (grant.through != before.through || grant.final != before.final || now - said >= 10ms) {
        said = now;
        SayGrant(grant);
        ShowProgress(now);
      }
      if (grant.final && clock_.all_sources_finished()) conductor_.CloseLog(Now());
      FlushLog();
      Wait();
    }
    triggers_->SayEnd(clock_.grant().through, Now().utc_ns, "ok");
    Close(NodeLines() + EndLine("ok", clock_.grant().through, clock_.RunDigest(), 0));
    return 0;
  }

  // Who failed by its own word would fail again; who has not been ready in time would not be the next time either.
  std::optional<int> TakeFault(const lockstep::Watchdog::Fault& fault) {
    using Phase = lockstep::Phase;
    const lockstep::Report& report = clock_.report(fault.node);
    const bool by_its_own_word = report.phase == Phase::kFailed || report.phase == Phase::kRefused;
    if (by_its_own_word || report.phase < Phase::kReady) return Abort(fault.reason, fault.status);
    return Lose(fault.node, fault.reason, fault.status);
  }

  // The closing words, here and to who follows on other PCs. Said again until everybody must have heard them; who has gone
  // already does not matter.
  void Close(const std::string& words) {
    lockstep::Grant last = clock_.grant();
    last.over = true;
    last.reason = words;
    for (int i = 0; i < 10; ++i) {
      SayGrant(last);
      std::this_thread::sleep_for(5ms);
    }
    SayLine(words);
  }
  std::string EndLine(const char* how, lockstep::Step last_step, base::Digest digest, int status) const {
    const lockstep::Pacer& pacer = conductor_.pacer();
    const lockstep::Lateness& late = pacer.lateness();
    const auto seconds = [](auto ns) { return static_cast<double>(ns) * 1e-9; };
    return fmt::format("end {} last_step={} wall_s={:.6f} digest={} slipped_s={:.6f} paused_s={:.6f} paced_steps={} late_steps={} "
                       "late_mean_s={:.9f} late_worst_s={:.9f} status={}",
                       how, last_step, RunSeconds(), base::Hex(digest), seconds(pacer.slipped_ns()), seconds(pacer.PausedNs(NowNs())),
                       late.steps, late.late, seconds(late.mean_ns()), seconds(late.worst_ns), status);
  }

  void Wait() {
    std::unique_lock lock(mutex_);
    const auto due = std::chrono::nanoseconds(conductor_.NextDueIn(Now()));
    const std::chrono::nanoseconds limit = due > 0ns ? std::min<std::chrono::nanoseconds>(due, 10ms) : 10ms;
    woken_.wait_for(lock, limit, [this] { return !inbox_.empty() || parents_.is_waiting(); });
  }

  void TakeReports() {
    std::deque<base::Bytes> taken;
    {
      const std::lock_guard lock(mutex_);
      taken.swap(inbox_);
    }
    for (const base::Bytes& bytes : taken) {
      auto named = DecodeReport(bytes);
      if (!named) {
        refusal_ = "a report that cannot be read was found (a node of another version?): " + named.error().Text();
        return;
      }
      TakeReport(named.value());
    }
  }

  void TakeReport(NamedReport& named) {
    const lockstep::NodeIndex node = roster_.Find(named.node);
    if (node == roster_.nodes().size()) {
      Say("refused a node named '{}' on host {}, which is not in the roster{}", OneLine(named.node), named.hello.host, base::DidYouMean(named.node, roster_.Names()));
      return;
    }
    if (named.clock_id != 0 && named.clock_id != clock_id_) return;  // meant for another clock
    if (named.report.incarnation < clock_.life(node)) return;        // of a life that is over
    if (named.report.phase == lockstep::Phase::kLost) {
      lost_.push_back(named.node + " " + named.report.message);
      return;
    }
    if (own_.world == 0) own_.world = named.hello.world;
    if (auto status = CheckHello(own_, named.hello); !status) {
      refusal_ = fmt::format("node '{}' (process {} on host {}) was refused: {}", named.node, named.hello.pid, named.hello.host, status.error().Text());
      return;
    }
    if (named.report.phase < lockstep::Phase::kFailed && IsTwice(node, named)) return;
    named.report.node = node;
    if (auto status = clock_.recovery().CheckState(named.report); !status) {
      refusal_ = status.error().Text();
      return;
    }
    watchdog_.Heard(named.report, NowNs() / 1'000'000);
    missed_.Heard(node, NowNs());
    if (auto status = clock_.Take(named.report); !status) Say("refused {}", OneLine(status.error().Text()));
  }

  // Two processes as one node, of one life: somebody has started the same host twice.
  bool IsTwice(lockstep::NodeIndex node, const NamedReport& named) {
    const Who now{named.report.incarnation, named.hello.host, named.hello.pid};
    Who& known = who_[node];
    if (known.pid == 0 || known.incarnation < now.incarnation) known = now;
    if (known.incarnation != now.incarnation || (known.pid == now.pid && known.host == now.host)) return false;
    refusal_ = fmt::format("node '{}' takes part twice, as process {} on host {} and as process {} on host {}; end one of them", named.node, known.pid, known.host,
                           now.pid, now.host);
    return true;
  }

  void SayGrant(const lockstep::Grant& grant) { (void)grants_->Write(EncodeGrant({clock_id_, ++serial_, grant})); }

  void ShowProgress(WallClock::time_point now) {
    if (now - shown_ < 200ms) return;
    shown_ = now;
    if (!conductor_.begun()) {
      Say("waiting for {}", fmt::join(clock_.Missing(lockstep::Phase::kReady), ", "));
    } else {
      Say("progress step={} wall_s={:.3f} pace={:g} paused={} begun_ns={}", clock_.slowest_progress(), RunSeconds(), conductor_.pacer().pace(),
          conductor_.pacer().paused() ? 1 : 0, std::chrono::nanoseconds(start_.time_since_epoch()).count() + NowNs() - conductor_.RunNs(Now()));
    }
  }

  // A line each, with its line break.
  std::string NodeLines() const {
    std::string lines;
    for (lockstep::NodeIndex n = 0; n < roster_.nodes().size(); ++n) {
      const lockstep::Report& report = clock_.report(n);
      const double mean_us = report.steps == 0 ? 0.0 : static_cast<double>(report.busy_ns) * 1e-3 / static_cast<double>(report.steps);
      lines += fmt::format("node {} steps={} mean_us={:.2f} worst_us={:.1f} apart_us={:.1f} apart_p99_us={:.1f} server_calls={} saves={} digest={}\n",
                           roster_.node(n).name, report.steps, mean_us, static_cast<double>(report.worst_ns) * 1e-3,
                           static_cast<double>(report.median_interval_ns) * 1e-3, static_cast<double>(report.p99_interval_ns) * 1e-3,
                           report.server_calls, report.cannot_save ? 0 : 1, base::Hex(report.digest));
    }
    return lines;
  }

  // Time stops everywhere; sinks get a moment to close their files.
  int Abort(const std::string& reason, int status) {
    conductor_.Abort(reason, Now());
    FlushLog();
    triggers_->SayEnd(clock_.slowest_progress() - 1, Now().utc_ns, clock_.grant().reason);
    Say("fault {}", OneLine(reason));
    // At least some times: no process of another PC is told of it by anybody else.
    for (int i = 0; i < 10 || (i < 100 && !AllButTheDeadHaveFinished()); ++i) {
      SayGrant(clock_.grant());
      std::this_thread::sleep_for(10ms);
      TakeReports();
    }
    Close(fmt::format("fault {}\n", OneLine(reason)) + NodeLines() + EndLine("aborted", clock_.slowest_progress() - 1, 0, status));
    return status;
  }
  bool AllButTheDeadHaveFinished() const {
    for (lockstep::NodeIndex n = 0; n < roster_.nodes().size(); ++n) {
      if (roster_.node(n).is_sink() && clock_.report(n).phase < lockstep::Phase::kFinished) return false;
    }
    return true;
  }

  const launch::Launch& launch_;
  const lockstep::Roster& roster_;
  const ProcessOptions& options_;
  lockstep::Clock clock_;
  lockstep::Conductor conductor_;
  lockstep::Watchdog watchdog_;
  Hello own_;
  struct Who {
    std::uint32_t incarnation = 0;
    std::string host;
    std::uint32_t pid = 0;
  };
  lockstep::MissedNodes missed_;
  bool stop_asked_ = false;  // by the operator
  std::vector<Who> who_ = std::vector<Who>(roster_.nodes().size());
  std::uint64_t clock_id_ = 0;
  std::uint32_t serial_ = 0;
  std::atomic<std::uint64_t> other_clock_ = 0;
  WallClock::time_point start_ = WallClock::now();
  WallClock::time_point shown_{};
  std::string refusal_;
  std::vector<std::string> lost_;  // "NODE TEXT"
  std::mutex mutex_;
  std::condition_variable woken_;
  std::deque<base::Bytes> inbox_;
  ParentsWord parents_;
  std::unique_ptr<Participant> participant_;  // outlives its endpoints
  std::unique_ptr<Writer> grants_;
  std::unique_ptr<LogSpeaker> log_;
  std::optional<Triggers> triggers_;
  std::unique_ptr<Reader> others_;
  std::unique_ptr<Reader> reports_;
};

}  // namespace

int RunClock(int argc, char** argv) {
  base::FixMathematics(argv);
  const ParsedOptions parsed = ParseOptions("rodeira-clock", true, argc, argv);
  if (parsed.leave_with) return *parsed.leave_with;
  const auto launch = launch::Launch::Load(parsed.options.launch_file, parsed.options.overrides);
  if (!launch) {
    fmt::print(stderr, "rodeira-clock: {}\n", launch.error().Text());
    return launch.error().exit_status();
  }
  if (!parsed.options.follow.empty()) return FollowClock(launch.value(), parsed.options);
  std::signal(SIGINT, OnSignal);
  std::signal(SIGTERM, OnSignal);
  return ClockProcess(launch.value(), parsed.options).Run();
}

}  // namespace rodeira::dds
