#include "launch/replay_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "launch/branch.hpp"
#include "launch/interrupt.hpp"
#include "launch/verify.hpp"

namespace rodeira::front {
namespace {

using lockstep::Step;

int Complain(const base::Error& error) {
  fmt::print(stderr, "rodeira: {}\n", error.Text());
  return error.exit_status();
}

// A line on the terminal that is written over; nothing where standard error is no terminal.
class Progress {
 public:
  Progress(bool quiet, double base_step_s, lockstep::Step last) : shown_(!quiet && ::isatty(STDERR_FILENO) != 0), base_step_s_(base_step_s), last_(last) {}
  ~Progress() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }
  void Show(lockstep::Step step) const {
    if (shown_) fmt::print(stderr, "\r\033[Kverified {:.1f} s of {:.1f} s", static_cast<double>(step) * base_step_s_, static_cast<double>(last_) * base_step_s_);
  }

 private:
  bool shown_;
  double base_step_s_;
  lockstep::Step last_;
};

Step ToStep(double seconds, double base_step_s) { return static_cast<Step>(std::llround(seconds / base_step_s)); }

int MakeBranch(const ReplayOptions& options) {
  if (!options.from_s) return Complain(base::WrongInput("--from is missing: where does the branch leave its parent?", "rodeira replay --branch"));
  if (options.record.empty()) return Complain(base::WrongInput("--record is missing: into which file?", "rodeira replay --branch"));
  BranchWish wish;
  {
    const auto parent = replay::RecordedRun::Open(options.file);
    if (!parent) return Complain(parent.error());
    const double base_step_s = static_cast<double>(parent.value().roster().base_step_ns()) * 1e-9;
    wish.at = ToStep(*options.from_s, base_step_s);
    if (options.for_s) wish.last_step = wish.at + ToStep(*options.for_s, base_step_s);
  }
  wish.parent = options.file;
  for (const auto& [key, value] : options.changes) {
    std::error_code problem;  // a file is meant as seen from here, not from the recorded launch file
    const bool file = std::filesystem::is_regular_file(value, problem);
    wish.changes.emplace_back(key, file ? "\"" + std::filesystem::absolute(value).lexically_normal().string() + "\"" : value);
  }
  wish.recording = options.record;
  wish.stop_requested = Interrupted;
  const auto outcome = Branch(wish);
  if (!outcome) return Complain(outcome.error());
  if (outcome.value().difference) {
    fmt::print(stderr, "rodeira: {}: the parent could not be repeated up to the branch; {}\n", options.file, outcome.value().difference->Text());
    return 1;
  }
  fmt::print("parent    {} (repeated from step {} to {}, identical)\nbranch    steps {} to {}\n", options.file, outcome.value().recomputed_from, outcome.value().at,
             outcome.value().at, outcome.value().last_step);
  for (const auto& [key, value] : options.changes) fmt::print("changed   {} = {}\n", key, value);
  if (!outcome.value().taken_over.empty()) fmt::print("began from what was published: {}\n", fmt::join(outcome.value().taken_over, ", "));
  fmt::print("wrote     {}\n", options.record);
  return 0;
}

int Watch(const ReplayOptions& options) {
  WatchOptions watch = options.watch;
  watch.file = options.file;
  watch.from_s = options.from_s.value_or(0.0);
  return options.view ? WatchRecording(watch) : WriteRecordedFrames(watch);
}

}  // namespace

int Replay(const ReplayOptions& options) {
  const int wishes = (options.verify ? 1 : 0) + (options.view ? 1 : 0) + (options.watch.frames.empty() ? 0 : 1) + (options.changes.empty() ? 0 : 1);
  if (wishes != 1) {
    return Complain(base::WrongInput(fmt::format("{} to do was named; --view, --frames, --verify or --branch was expected", wishes == 0 ? "nothing" : "more than one thing"), "rodeira replay"));
  }
  if (!options.changes.empty() || options.verify) CatchInterrupts();
  if (!options.changes.empty()) return MakeBranch(options);
  if (!options.verify) return Watch(options);
  const auto run = replay::RecordedRun::Open(options.file);
  if (!run) return Complain(run.error());
  const double base_step_s = static_cast<double>(run.value().roster().base_step_ns()) * 1e-9;
  const auto from = static_cast<lockstep::Step>(std::floor(options.from_s.value_or(0.0) / base_step_s + 1e-9));
  if (from > run.value().last_step()) {
    return Complain(base::WrongInput(fmt::format("--from {} s was found, but the run ends at {:.3f} s", options.from_s.value_or(0.0),
                                                 static_cast<double>(run.value().last_step()) * base_step_s), options.file));
  }
  const Progress progress(options.quiet, base_step_s, run.value().last_step());
  const auto begin = std::chrono::steady_clock::now();
  const auto verdict = Verify(run.value(), from, [&](lockstep::Step step) { progress.Show(step); }, Interrupted);
  if (!verdict) return Complain(verdict.error());
  const Verdict& found = verdict.value();
  if (!found.substituted.empty()) fmt::print("live input taken from the recording: {}\n", fmt::join(found.substituted, ", "));
  if (found.difference) {
    fmt::print("{}\n", found.difference->Text());
    return 1;
  }
  fmt::print("identical: {} steps, {} nodes ({} samples, {} snapshots; from {:.3f} s; {:.1f} s of wall time)\n", found.last_step - found.first_step, found.nodes,
             found.samples, found.snapshots, static_cast<double>(found.first_step) * base_step_s,
             std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  return 0;
}

}  // namespace rodeira::front
