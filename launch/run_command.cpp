#include "launch/run_command.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <thread>
#include <utility>

#include "common/launch/pace.hpp"
#include "launch/in_process_command.hpp"
#include "launch/operator.hpp"
#include "launch/placement.hpp"
#include "launch/processes.hpp"
#include "launch/recording_folder.hpp"
#include "launch/run_meta.hpp"
#include "launch/run_report.hpp"
#include "launch/shared_memory.hpp"

namespace rodeira::front {
namespace {

using namespace std::chrono_literals;
using WallClock = std::chrono::steady_clock;

std::atomic<int> g_interrupts = 0;
void OnInterrupt(int) { ++g_interrupts; }

int Complain(const base::Error& error) {
  fmt::print(stderr, "rodeira: {}\n", error.Text());
  return error.exit_status();
}

std::string FreshRunName() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

// NAME-DATE-TIME-PROCESS.mcap: runs that start in the same second have names of their own.
std::string DatedRecording(const std::string& launch_name) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  std::string name = launch_name;
  std::ranges::replace(name, '/', '_');
  return (RecordingFolder() / fmt::format("{}-{:%Y%m%d-%H%M%S}-{}.mcap", name, local, ::getpid())).string();
}

// The name, or name2, name3 …: what no node of the launch file is called.
std::string FreeName(const launch::Launch& launch, const std::string& name) {
  std::string free = name;
  const auto is_it = [&free](const launch::LaunchNode& node) { return node.name == free; };
  const auto taken = [&] { return std::ranges::any_of(launch.nodes(), is_it); };
  for (int number = 2; taken(); ++number) free = fmt::format("{}{}", name, number);
  return free;
}

// The processes of a run, their clock's words, and their end.
class ProcessRun {
 public:
  ProcessRun(const RunOptions& options, const Placement& placement, const launch::Launch& launch, launch::Overrides overrides)
      : options_(options), placement_(placement), launch_(launch), overrides_(std::move(overrides)), run_(options.run),
        domain_(options.domain.value_or(static_cast<std::uint32_t>(1 + base::Hash(run_) % 200))) {
    RemoveLeftOvers({});  // of dead runs
    before_ = SharedMemoryFiles();
    if (placement.has_clock()) desk_.emplace(options.run, options.quiet);
  }

  int Run() {
    struct sigaction action {};
    action.sa_handler = OnInterrupt;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    ::signal(SIGPIPE, SIG_IGN);
    base::Status status = StartClock();
    if (status.ok() && placement_.has_clock()) status = StartNodes();
    if (!status) {
      EndAll();
      return Complain(status.error());
    }
    status = Watch();
    EndAll();
    RemoveLeftOvers(before_);
    if (!status) return Complain(status.error());
    Close();
    return ExitStatus();
  }

  const RunReport& report() const { return report_; }

 private:
  std::vector<std::string> Command(const std::string& program) const {
    std::vector<std::string> command{ProgramFolder() + "/" + program, "--launch", launch_.path().string(), "--run", run_, "--domain", std::to_string(domain_)};
    for (const auto& [key, value] : overrides_) {
      command.push_back("--set");
      command.push_back(key + "=" + value);
    }
    return command;
  }

  // The clock, or on the other PCs of a laboratory who follows it.
  base::Status StartClock() {
    std::vector<std::string> clock = Command("rodeira-clock");
    if (placement_.has_clock()) {
      clock.insert(clock.end(), {"--listen", "--pace", options_.pace});
      if (options_.duration_s) clock.insert(clock.end(), {"--for", fmt::format("{}", *options_.duration_s)});
    } else {
      clock.insert(clock.end(), {"--follow", placement_.host()});
    }
    auto child = Child::Start(placement_.has_clock() ? "clock" : "follower of the clock", clock, true);
    if (!child) return child.error();
    children_.push_back(std::move(child).value());
    return {};
  }
  // Another life of the clock, which learns from the nodes where the run stands.
  base::Status RestartClock(const std::string& reason) {
    if (auto status = MakeSureItIsDead(children_.front()); !status) return status;
    while (ReadClock(0)) {
    }
    pending_.clear();
    for (const auto& [number, answer] : answers_) answer("failed the clock was lost; ask again");
    answers_.clear();
    std::vector<std::string> clock = Command("rodeira-clock");
    const std::string pace = report_.begun_ns < 0 ? options_.pace : report_.pace > 0.0 ? fmt::format("{}", report_.pace) : "max";
    clock.insert(clock.end(), {"--listen", "--pace", pace, "--incarnation", std::to_string(++clocks_life_), "--clock-id", std::to_string(report_.clock_id),
                               "--begun-ns", std::to_string(report_.begun_ns)});
    if (report_.paused) clock.emplace_back("--paused");
    if (options_.duration_s) clock.insert(clock.end(), {"--for", fmt::format("{}", *options_.duration_s)});
    auto child = Child::Start("clock", clock, true);
    if (!child) return child.error();
    children_.front() = std::move(child).value();
    report_.recovered.push_back(reason + "; started again");
    Tell(report_.recovered.back());
    return {};
  }
  base::Status RestartNode(const RunReport::Restart& wish) {
    const auto child = std::find_if(children_.begin() + 1, children_.end(), [&](const Child& one) { return one.name() == wish.node; });
    if (child == children_.end()) return {};  // another host's
    if (auto status = MakeSureItIsDead(*child); !status) return status;
    const auto node = std::find_if(launch_.nodes().begin(), launch_.nodes().end(), [&](const launch::LaunchNode& one) { return one.name == wish.node; });
    std::vector<std::string> command = Command(std::string(node->kind->program));
    command.insert(command.end(), {"--node", wish.node, "--incarnation", std::to_string(wish.life)});
    auto started = Child::Start(wish.node, command, false);
    if (!started) return started.error();
    *child = std::move(started).value();
    told_.erase(wish.node);
    Tell(wish.reason + "; it is started again");
    return {};
  }
  static base::Status MakeSureItIsDead(Child& child) {
    child.Signal(SIGKILL);
    for (int i = 0; i < 2000 && !child.ended(); ++i) {
      child.Poll();
      if (!child.ended()) ::usleep(1000);
    }
    return child.ended() ? base::Status() : base::Failed(fmt::format("process {} of '{}' cannot be ended", child.pid(), child.name()));
  }
  base::Status StartNodes() {
    nodes_started_ = true;
    for (const launch::LaunchNode& node : launch_.nodes()) {
      if (!placement_.Has(node)) continue;
      std::vector<std::string> command = Command(std::string(node.kind->program));
      command.insert(command.end(), {"--node", node.name});
      auto started = Child::Start(node.name, command, false);
      if (!started) return started.error();
      children_.push_back(std::move(started).value());
    }
    return {};
  }

  // Until the clock has ended, by itself or not.
  base::Status Watch() {
    while (true) {
      ReadClock(50);
      // Beside a clock elsewhere nothing begins before it is met: this PC may wait for the others as long as it likes.
      if (report_.met && !nodes_started_) {
        if (auto status = StartNodes(); !status) return status;
      }
      for (const RunReport::Restart& wish : std::exchange(report_.wanted, {})) {
        if (auto status = RestartNode(wish); !status) return status;
      }
      for (const std::string& reason : std::exchange(report_.paused_by, {})) {
        Tell(reason + "; the run waits: it goes on when the node does; `rodeira ctl restart NODE` or `rodeira ctl stop` decide otherwise");
      }
      for (Child& child : children_) child.Poll();
      Child& clock = children_.front();
      if ((clock.ended() || clock.stopped()) && MayRestartClock()) {
        if (auto status = RestartClock(fmt::format("the clock {} at about step {}", clock.Fate(), report_.step)); !status) return status;
        continue;
      }
      if (clock.ended()) {
        while (ReadClock(0)) {
        }
        if (!report_.ended && clock.exit_status() != 2) Fault(fmt::format("the {} {} at about step {}", clock.name(), clock.Fate(), report_.step));
        return {};
      }
      if (clock.stopped()) {
        Fault(fmt::format("the {} {} at about step {}", clock.name(), clock.Fate(), report_.step));
        return {};
      }
      for (const Child& child : children_) {
        if (&child == &clock) continue;
        if (Broken(child)) {
          TellClock(child);
        } else if (!child.ended()) {
          told_.erase(child.name());  // it goes on
        }
      }
      const int interrupts = g_interrupts;
      if (interrupts > 0 && !interrupted_at_) interrupted_at_ = WallClock::now();
      for (; passed_on_ < interrupts; ++passed_on_) clock.Signal(SIGINT);
      AskClock();
      ShowProgress();
    }
  }
  // What the operator asks for goes to the clock; its answer comes among its other words.
  void AskClock() {
    while (auto asked = desk_ ? desk_->Next() : std::nullopt) {
      // What would end a line or a text is no part of a command.
      std::replace_if(asked->line.begin(), asked->line.end(), [](unsigned char c) { return c < 0x20; }, ' ');
      children_.front().Send(fmt::format("do {} {}", ++asked_, asked->line));
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
  // Dead or stopped though the run is not over. A node that left with a sentence has told the clock itself.
  bool Broken(const Child& child) const {
    if (report_.ended || !fault_.empty()) return false;
    if (child.stopped()) return true;
    if (!child.ended()) return false;
    const bool by_itself = child.exit_status() && *child.exit_status() <= 2;
    return !by_itself || WallClock::now() - child.ended_at() > 1s;
  }
  void TellClock(const Child& broken) {
    if (!told_.insert(broken.name()).second) return;
    const auto node = std::find_if(launch_.nodes().begin(), launch_.nodes().end(), [&](const launch::LaunchNode& one) { return one.name == broken.name(); });
    if (node->recovery == lockstep::Policy::kStop) Fault(fmt::format("node '{}' {} at about step {}", broken.name(), broken.Fate(), report_.step));
    children_.front().Send(fmt::format("lost {} {}", broken.name(), broken.Fate()));
  }
  // A clock that is lost again and again without the run getting on has a reason for it.
  bool MayRestartClock() {
    while (ReadClock(0)) {
    }
    const Child& clock = children_.front();
    const bool by_itself = clock.ended() && clock.exit_status() && *clock.exit_status() <= 2;
    if (by_itself || report_.ended || !fault_.empty() || g_interrupts > 0) return false;
    if (!placement_.has_clock() || launch_.recovery() != lockstep::Policy::kRestart || report_.clock_id == 0) return false;
    clocks_losses_ = report_.step > clocks_last_step_ ? 1 : clocks_losses_ + 1;
    clocks_last_step_ = report_.step;
    return clocks_losses_ < 4;
  }
  // The first fault is the cause, what follows are its consequences; it is said at once.
  void Fault(const std::string& fault) {
    if (!fault_.empty()) return;
    fault_ = fault;
    Tell(fault);
  }
  void Tell(const std::string& sentence) {
    fmt::print(stderr, "{}rodeira: {}\n", shown_ ? "\r\033[K" : "", sentence);
    std::fflush(stderr);
  }

  // Reads what the clock has said; false where there was nothing.
  bool ReadClock(int wait_ms) {
    const int out = children_.front().out();
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
      } else {
        report_.Take(line);
      }
      pending_.erase(0, end + 1);
      if (!report_.faults.empty()) Fault(report_.faults.front());
    }
    return true;
  }

  // Everybody goes: by themselves, or by force before two seconds have passed since Ctrl-C.
  void EndAll() {
    const bool orderly = report_.ended;
    for (Child& child : children_) {
      child.Poll();
      if (!orderly) child.Signal(SIGTERM);
      if (child.stopped() || (!orderly && &child == &children_.front())) child.Signal(SIGKILL);
    }
    auto until = WallClock::now() + 1500ms;
    if (interrupted_at_) until = std::min(until, *interrupted_at_ + 1700ms);
    while (WallClock::now() < until && std::any_of(children_.begin(), children_.end(), [](const Child& child) { return !child.ended(); })) {
      std::this_thread::sleep_for(5ms);
      for (Child& child : children_) child.Poll();
    }
    for (Child& child : children_) child.Signal(SIGKILL);
    for (int i = 0; i < 200; ++i) {
      bool all = true;
      for (Child& child : children_) {
        child.Poll();
        all = all && child.ended();
      }
      if (all) return;
      std::this_thread::sleep_for(5ms);
    }
  }

  void ShowProgress() {
    if (options_.quiet || ::isatty(STDERR_FILENO) == 0 || WallClock::now() - start_ < 2s) return;
    if (!report_.ready) {
      fmt::print(stderr, "\r\033[Kwaiting for {}{}", report_.waiting_for, nodes_started_ ? "" : " on " + placement_.ClocksPlace());
    } else {
      const double simulated_s = static_cast<double>(report_.step) * static_cast<double>(launch_.roster().base_step_ns()) * 1e-9;
      fmt::print(stderr, "\r\033[K{:.1f} s simulated, {:.1f} s passed, {:.2f} × real time{}{}", simulated_s, report_.wall_s,
                 report_.wall_s > 0.0 ? simulated_s / report_.wall_s : 0.0, report_.paused ? ", paused" : "", desk_ && desk_->has_keys() ? " (h: keys)" : "");
    }
    shown_ = true;
  }

  void Close() {
    if (shown_) fmt::print(stderr, "\r\033[K");
    report_.faults = fault_.empty() ? std::vector<std::string>() : std::vector<std::string>{fault_};
    for (const std::string& remark : report_.remarks) fmt::print(stderr, "rodeira: {}\n", remark);
    if (!report_.ready || options_.quiet) return;
    fmt::print("{}", report_.Table(static_cast<double>(launch_.roster().base_step_ns()) * 1e-9, options_.record));
  }

  int ExitStatus() const {
    if (report_.ok && fault_.empty()) return 0;
    for (const Child& child : children_) {
      if (child.exit_status() == 2) return 2;
    }
    return 1;
  }

  const RunOptions& options_;
  const Placement& placement_;
  const launch::Launch& launch_;
  launch::Overrides overrides_;
  std::string run_;
  std::uint32_t domain_;
  std::set<std::string> before_;
  std::vector<Child> children_;  // the clock first
  RunReport report_;
  std::string fault_;
  std::string pending_;
  std::optional<Operator> desk_;  // where the clock is
  std::size_t asked_ = 0;
  std::map<std::size_t, std::function<void(const std::string&)>> answers_;
  int passed_on_ = 0;
  std::optional<WallClock::time_point> interrupted_at_;
  bool nodes_started_ = false;
  std::set<std::string> told_;  // nodes of which the clock was told that they are lost
  std::uint32_t clocks_life_ = 0;
  std::int64_t clocks_last_step_ = -1;  // where it was lost …
  int clocks_losses_ = 0;               // … so often
  bool shown_ = false;
  WallClock::time_point start_ = WallClock::now();
};

// Where the recording goes: --record, else the launch file's own, else a dated file in the user's data folder. A recorder
// that the launch file does not have is added; --no-record takes those away that it has. On a PC of a laboratory only its own
// recorder counts, and none is added: all PCs must agree on who takes part.
base::Status ResolveRecording(const launch::Launch& launch, const Placement& placement, RunOptions& options, launch::Overrides& overrides) {
  std::string recorder;
  std::string own;  // what the launch file says
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name != "recorder") continue;
    if (options.no_record) overrides.emplace_back("nodes." + node.name + ".kind", std::string(launch::kNoKind));
    if (options.no_record || !recorder.empty()) continue;
    if (!placement.Has(node)) {
      if (options.record.empty()) return {};
      return base::WrongInput(fmt::format("the recorder '{}' runs on another host; say it there", node.name), "--record");
    }
    recorder = node.name;
    own = node.config->OptionalChild("config").Peek({"file"}).value_or("");
    if (!own.empty()) own = node.config->OptionalChild("config").Path("file").string();
  }
  if (options.no_record) return {};
  if (options.record.empty()) options.record = own;
  if (!own.empty() && options.record == own) return {};
  if (options.record.empty() && recorder.empty() && !placement.host().empty()) return {};
  std::error_code problem;
  if (options.record.empty()) {
    options.record = DatedRecording(launch.name());
    std::filesystem::create_directories(RecordingFolder(), problem);
    if (problem) {
      const std::string what = fmt::format("the folder for recordings cannot be made: {}; name a file by --record, or say --no-record", problem.message());
      return base::Failed(what, RecordingFolder().string());
    }
  }
  options.record = std::filesystem::absolute(options.record, problem).string();
  if (std::filesystem::exists(options.record, problem)) return base::WrongInput("the file exists; a recording is never overwritten", options.record);
  if (recorder.empty()) {
    if (!placement.host().empty()) {
      return base::WrongInput("the launch file has no recorder; with several PCs it must have one, 'recorder: {kind: recorder}'", "--record");
    }
    recorder = FreeName(launch, "recorder");
    overrides.emplace_back("nodes." + recorder + ".kind", "recorder");
  }
  overrides.emplace_back("nodes." + recorder + ".config.file", "\"" + options.record + "\"");
  return {};
}

}  // namespace

int Run(const RunOptions& options) {
  if (const auto pace = launch::ParsePace(options.pace.empty() ? "max" : options.pace); !pace) return Complain(pace.error());
  launch::Overrides overrides = options.overrides;
  if (options.seed) overrides.emplace_back("seed", std::to_string(*options.seed));
  RunOptions resolved = options;
  Placement placement;
  auto launch = launch::Launch::Load(options.launch_file, overrides);
  if (launch.ok() && options.headless) {
    for (const launch::LaunchNode& node : launch.value().nodes()) {
      if (node.kind->name == "view") overrides.emplace_back("nodes." + node.name + ".config.window", "never");
    }
  }
  if (launch.ok()) {
    auto found = Placement::Find(launch.value(), resolved, overrides);
    if (!found) return Complain(found.error());
    placement = std::move(found).value();
    if (auto status = ResolveRecording(launch.value(), placement, resolved, overrides); !status) return Complain(status.error());
    launch = launch::Launch::Load(options.launch_file, overrides);
  }
  if (launch.ok() && !resolved.meta.empty()) {
    if (auto status = AddMeta(launch.value(), resolved.meta, overrides); !status) return Complain(status.error());
    launch = launch::Launch::Load(options.launch_file, overrides);
  }
  if (!launch) return Complain(launch.error());
  if (auto status = launch.value().CheckRecovery(); !status && !options.in_process) return Complain(status.error());
  if (resolved.pace.empty()) resolved.pace = launch.value().pace().empty() ? "max" : launch.value().pace();
  if (resolved.run.empty()) resolved.run = FreshRunName();
  if (options.in_process) return RunInProcess(resolved, launch.value());
  return ProcessRun(resolved, placement, launch.value(), std::move(overrides)).Run();
}

}  // namespace rodeira::front
