// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/lockstep/run_controller.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/runtime/lockstep/named_node.hpp"

namespace rodeira::lockstep {
namespace {

std::string PaceText(double pace) {
  if (pace <= 0.0) return "as fast as it can";
  return pace == 1.0 ? "in real time" : fmt::format("at {:g} × real time", pace);
}

constexpr double kFastest = 16.0, kSlowest = 1.0 / 64.0;
double Faster(double pace) { return pace <= 0.0 || 2.0 * pace > kFastest ? 0.0 : 2.0 * pace; }
double Slower(double pace) { return pace <= 0.0 ? kFastest : std::max(0.5 * pace, kSlowest); }

}  // namespace

std::string RunController::Here() const {
  const Step step = clock_.grant().through;
  return fmt::format("step {} ({:.3f} s)", step, static_cast<double>(step * clock_.roster().base_step_ns()) * 1e-9);
}

std::string RunController::State() const {
  return pacer_.paused() ? "paused at " + Here() : fmt::format("runs {} at {}", PaceText(pacer_.pace()), Here());
}

std::uint32_t RunController::Note(RemarkKind kind, std::string text, const Wall& now) {
  return log_.Add(Remark{clock_.grant().through, now.utc_ns, RunNs(now), pacer_.pace(), kind, std::move(text), 0});
}

Wall ReadWall() {
  timespec asleep{};
  (void)::clock_gettime(CLOCK_BOOTTIME, &asleep);
  return {std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count(),
          std::chrono::nanoseconds(std::chrono::system_clock::now().time_since_epoch()).count(),
          static_cast<std::int64_t>(asleep.tv_sec) * 1'000'000'000 + asleep.tv_nsec};
}

void RunController::PauseAfterSleep(const Wall& now) {
  const Wall before = std::exchange(moved_, now).value_or(now);
  const std::int64_t slept_ns =
      std::max(now.monotonic_ns - before.monotonic_ns, now.awake_and_asleep_ns - before.awake_and_asleep_ns);
  if (!begun_ || slept_ns < kSleep_ns || pacer_.pace() <= 0.0 || pacer_.paused()) return;
  warning_ = fmt::format("this PC slept, or the clock was stopped, for {:.0f} s: the run is paused at {}",
                         static_cast<double>(slept_ns) * 1e-9, Here());
  NoteFault(warning_, now);
  Pause(now);
}

Grant RunController::Update(const Wall& now) {
  PauseAfterSleep(now);
  if (clock_.grant().final || clock_.grant().abort || !clock_.all_ready()) return clock_.grant();
  if (!begun_) {
    begun_ = true;
    begin_ns_ = now.monotonic_ns;
    Note(RemarkKind::kStart, "", now);
  }
  if (goes_on_) {  // time begins where it stood
    goes_on_ = false;
    pacer_.ContinueFrom(now.monotonic_ns, clock_.grant().through);
    NoteFault(fmt::format("the clock was lost; this is its incarnation {}", incarnation_ + 1), now);
  }
  const Step before = clock_.grant().through;
  const Grant grant = clock_.Update(pacer_.Limit(now.monotonic_ns, clock_.window_limit()));
  if (grant.through > before) {
    pacer_.Granted(now.monotonic_ns, grant.through);
    log_.Add(WallTime{std::max(before, clock_.first_step() - 1), grant.through, now.utc_ns, RunNs(now),
                      pacer_.late_ns(), pacer_.pace(), pacer_.paused()});
  }
  return grant;
}

void RunController::ContinueRun(std::int64_t begin_ns, bool paused, const Wall& now) {
  begun_ = true;
  goes_on_ = true;
  begin_ns_ = begin_ns;
  if (paused) pacer_.Pause(now.monotonic_ns);
}

base::Result<std::string> RunController::Do(const Command& command, const Wall& now) {
  using Kind = Command::Kind;
  if (command.kind == Kind::kRestart) {
    if (const auto node = NamedNode(clock_.roster(), command.text); !node) return node.error();
  }
  if (clock_.grant().abort) return base::Failed("run.failed", "the run has failed: " + clock_.grant().reason);
  if (command.kind == Kind::kStop && !clock_.grant().final) {
    Stop(now);
    if (clock_.grant().abort) return std::string("stopped before the first step");
    return "stops after " + Here();
  }
  if (!begun_) {
    std::string missing;
    for (const std::string& name : clock_.Missing(Phase::kReady)) missing += (missing.empty() ? "" : ", ") + name;
    return base::Failed("run.not_running",
                        "the run has not begun; it waits for " + (missing.empty() ? "no node" : missing));
  }
  if (clock_.grant().final) {
    if (command.kind == Kind::kState) return "is ending at " + Here();
    return base::Failed("run.not_running", "the run is ending at " + Here());
  }
  switch (command.kind) {
    case Kind::kPause:
      Pause(now);
      break;
    case Kind::kResume:
      Resume(now);
      break;
    case Kind::kToggle:
      pacer_.paused() ? Resume(now) : Pause(now);
      break;
    case Kind::kPace:
      SetPace(command.pace, now);
      break;
    case Kind::kFaster:
      SetPace(Faster(pacer_.pace()), now);
      break;
    case Kind::kSlower:
      SetPace(Slower(pacer_.pace()), now);
      break;
    case Kind::kStep: {
      if (!pacer_.paused()) Pause(now);
      const std::string from = Here();
      pacer_.AllowSteps(command.steps);
      Note(RemarkKind::kStep, fmt::format("{}", command.steps), now);
      return fmt::format("{} step{} from {}", command.steps, command.steps == 1 ? "" : "s", from);
    }
    case Kind::kMark: {
      const std::uint32_t number = Note(RemarkKind::kMark, command.text, now);
      return fmt::format("marked {} as remark {}", Here(), number);
    }
    case Kind::kRestart:
      return base::Failed("run.cannot_restart", "a node of a run of one process cannot be started again");
    case Kind::kState:
    case Kind::kStop:
      break;
  }
  return State();
}

void RunController::Pause(const Wall& now) {
  if (!pacer_.paused()) Note(RemarkKind::kPause, "", now);
  pacer_.Pause(now.monotonic_ns);
}

void RunController::Resume(const Wall& now) {
  if (!pacer_.paused()) return;
  pacer_.Resume(now.monotonic_ns);
  Note(RemarkKind::kResume, "", now);
}

void RunController::SetPace(double pace, const Wall& now) {
  pacer_.SetPace(now.monotonic_ns, pace);
  Note(RemarkKind::kPace, "", now);
}

void RunController::Stop(const Wall& now) {
  if (clock_.grant().final || clock_.grant().abort) return;
  if (clock_.grant().through < 0) return Abort("stopped before the first step", now);
  clock_.Stop();
  Note(RemarkKind::kStop, "", now);
}

void RunController::Abort(const std::string& reason, const Wall& now) {
  if (clock_.grant().abort) return;
  clock_.Abort(reason);
  if (log_.closed()) return;
  Note(RemarkKind::kFault, reason, now);
  log_.Close();
}

void RunController::CloseLog(const Wall& now) {
  if (log_.closed()) return;
  Note(RemarkKind::kEnd, "", now);
  log_.Close();
}

std::int64_t RunController::NextDueIn(const Wall& now) const {
  return begun_ && !clock_.grant().final ? pacer_.NextDueIn(now.monotonic_ns) : 0;
}

}  // namespace rodeira::lockstep
