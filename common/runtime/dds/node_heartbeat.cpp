// SPDX-License-Identifier: Apache-2.0
// What a node's process does beside its steps: it reports, watches its clock and itself, and ends.
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <utility>

#include "common/core/base/wait.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/dds/shared_memory_room.hpp"
#include "common/runtime/dds/stop_signals.hpp"
#include "common/runtime/dds/wall_clock.hpp"

namespace rodeira::dds {

using lockstep::LifeEvent;

namespace {

constexpr std::chrono::milliseconds kTimeToEnd{500};
constexpr std::chrono::milliseconds kShownWait{500};
constexpr std::chrono::milliseconds kTimeToRead{5};
constexpr std::chrono::milliseconds kHeldUpLong{1000};
constexpr std::chrono::milliseconds kStartsLong{1000};
constexpr std::chrono::milliseconds kTimeToMeet{5000};  // of a participant and the clock, on a PC under load
// From the end of the run, or of this node, to that of its process; a recorder has a file to close.
constexpr std::chrono::milliseconds kTimeToLeave{3000}, kTimeToClose{30'000};

volatile std::sig_atomic_t g_terminated = 0;

void OnTerminate(int) {
  g_terminated = 1;
  EndProcessWithin(kEndWithoutSupervisor);
}

}  // namespace

void NodeBus::HandleSignals() {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, OnTerminate);
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is an error to report, not the process' end
}

void NodeBus::ListenMeanwhile() {
  if (listener_) return;
  listens_since_ = WallClock::now();
  listener_.emplace(settings_.domain, [this](base::Bytes&& bytes) { OnGrantMeanwhile(bytes); });
}

bool NodeBus::CanHear(bool held_up) const {
  return !held_up || heard_meanwhile_ || (listens_since_ && WallClock::now() - *listens_since_ > kTimeToMeet);
}

void NodeBus::LookAtAddressSpace(const lockstep::Grant& grant) {
  const bool waits = grant.through < 0 && !grant.abort && WallClock::now() - opened_ > kStartsLong;
  if (!waits || settings_.domain.transport != launch::Transport::kSharedMemory) return;
  if (const auto status = CheckAddressSpace(settings_.domain.largest_segment_kib); !status)
    EndEarly(LifeEvent::kFailed, status.error().Text());
}

void NodeBus::EndIfItHangs(const lockstep::Grant& grant) {
  if (!grant.over && !grant.abort) return;
  if (!leaves_since_) leaves_since_ = WallClock::now();
  const lockstep::RosterNode& spec = roster_.node(settings_.node);
  const auto limit = spec.is_sink() || settings_.has_sink ? kTimeToClose : kTimeToLeave;
  if (WallClock::now() - *leaves_since_ < limit) return;
  const std::string sentence = fmt::format(
      "rodeira: node '{}' hangs {} s after it was told to end ({}); its process is ended\n", spec.name,
      std::chrono::duration_cast<std::chrono::seconds>(limit).count(), grant.reason.substr(0, grant.reason.find('\n')));
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, sentence.data(), sentence.size());
  ::_exit(1);
}

// Where the node stands. A node that has to end and does not come to it, because it loads, computes or hangs, is
// reported as ended after a while: its process has a second.
lockstep::Report NodeBus::ReportNow() {
  const std::lock_guard lock(mutex_);
  lockstep::Report report = runner_ != nullptr ? runner_->report() : last_;
  const auto end = mailbox_.early_end();
  if (runner_ == nullptr && report.phase == lockstep::Phase::kRunning && held_up_since_) {  // of a server: a request
    report.waiting = lockstep::Waiting::kNothing;
    report.since_ms = std::chrono::duration_cast<std::chrono::milliseconds>(WallClock::now() - *held_up_since_).count();
  }
  if (!lockstep::IsTerminal(report.phase)) {
    const bool is_alone = settings_.exchange == nullptr;
    report.message = base::LongestWait(kShownWait, is_alone ? std::string_view() : roster_.node(settings_.node).name);
  }
  if (!end || lockstep::IsTerminal(report.phase)) return report;
  if (!ends_since_) ends_since_ = WallClock::now();
  if (runner_ != nullptr && WallClock::now() - *ends_since_ < kTimeToEnd) return report;
  report.phase = lockstep::NextPhase(report.phase, end->event);
  report.message = end->reason;
  return report;
}

void NodeBus::Heartbeat() {
  std::unique_lock lock(mutex_);
  std::uint64_t begun_before = 0, all_begun_before = 0;
  std::optional<WallClock::time_point> deaf_since;  // a receiving thread of the process is held up
  auto looked = WallClock::now();
  while (!stop_) {
    // A step may run on the receiving thread: one that hangs keeps all further messages, also the clock's, waiting.
    const std::uint64_t done = messages_done_, begun = messages_begun_;
    const bool was_stopped = WallClock::now() - looked > settings_.longest_gap;
    const bool held_up = begun == begun_before && begun != done;
    if (!held_up || !held_up_since_) held_up_since_ = held_up ? std::optional(looked) : std::nullopt;
    // Of a thread that receives for several nodes, the message of one keeps those of all waiting.
    const LocalExchange* shared = settings_.exchange;
    const std::uint64_t all_done = shared == nullptr ? done : shared->messages_done.load();
    const std::uint64_t all_begun = shared == nullptr ? begun : shared->messages_begun.load();
    const bool deaf = all_begun == all_begun_before && all_begun != all_done;
    if (!deaf || !deaf_since) deaf_since = deaf ? std::optional(looked) : std::nullopt;
    begun_before = begun;
    all_begun_before = all_begun;
    looked = WallClock::now();
    if (deaf && WallClock::now() - *deaf_since > kHeldUpLong) ListenMeanwhile();
    const bool silent = clock_silence_.IsSilent(NowMs(), CanHear(deaf));
    lock.unlock();
    const lockstep::Grant grant = mailbox_.grant();
    EndIfItHangs(grant);
    LookAtAddressSpace(grant);
    if (silent && !grant.over && !grant.abort)
      EndEarly(LifeEvent::kFailed,
               fmt::format("the clock has sent nothing for {:.1f} s: it was killed, stopped or cut off",
                           static_cast<double>(settings_.clock_silence.count()) / 1e3));
    if (g_terminated != 0 && !grant.over)
      EndEarly(LifeEvent::kLost, fmt::format("was told to end by signal {} (Terminated)", SIGTERM));
    lock.lock();
    // What has come while this process was stopped is read before it reports.
    if (was_stopped) woken_.wait_for(lock, kTimeToRead, [this] { return stop_; });
    lock.unlock();
    Tell(ReportNow());
    lock.lock();
    woken_.wait_for(lock, settings_.heartbeat, [this] { return stop_; });
  }
}

void NodeBus::Linger(const lockstep::Report& last, std::optional<std::chrono::milliseconds> limit) {
  Follow(nullptr);
  const auto begin = WallClock::now();
  Tell(last);
  std::unique_lock lock(mutex_);
  while (!limit || WallClock::now() < begin + *limit) {
    lock.unlock();
    const lockstep::Grant grant = mailbox_.grant();
    if (clock_id() == 0) Tell(last);  // not met yet: what was said may have reached no node
    lock.lock();
    if (grant.over) return;
    if (grant.abort && WallClock::now() > begin + std::chrono::milliseconds(100))
      return;  // the last word had time to go
    woken_.wait_for(lock, std::chrono::milliseconds(10));
  }
}

}  // namespace rodeira::dds
