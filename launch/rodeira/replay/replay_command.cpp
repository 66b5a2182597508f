// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/replay_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/print_error.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/config/quoted.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/replay/branch_command.hpp"
#include "launch/rodeira/replay/recording_text.hpp"
#include "launch/rodeira/replay/verify.hpp"
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

using lockstep::Step;
constexpr double kMost_s = 1e9;  // whatever the run: steps can be counted that far

// A line on the terminal that is written over; nothing where standard error is no terminal.
class VerifyProgress {
 public:
  VerifyProgress(bool quiet, double base_step_s, lockstep::Step last)
      : shown_(!quiet && ::isatty(STDERR_FILENO) != 0), base_step_s_(base_step_s), last_(last) {}
  ~VerifyProgress() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }
  void Show(lockstep::Step step) const {
    if (shown_)
      fmt::print(stderr, "\r\033[Kverified {:.1f} s of {:.1f} s", static_cast<double>(step) * base_step_s_,
                 static_cast<double>(last_) * base_step_s_);
  }

 private:
  bool shown_;
  double base_step_s_;
  lockstep::Step last_;
};

int ShowRecording(const ReplayOptions& options) {
  WatchOptions watch = options.watch;
  watch.file = options.file;
  watch.from_s = options.from_s.value_or(0.0);
  watch.for_s = options.for_s;
  const Graphics* graphics = RegisteredGraphics();
  if (graphics == nullptr) return ContinueInGraphics(options.view ? "replay --view" : "replay --frames");
  return options.view ? graphics->watch(watch) : graphics->write_frames(watch);
}

}  // namespace

base::Result<launch::Overrides> LibrariesOf(const ReplayOptions& options) {
  launch::Overrides overrides;
  if (options.libraries.empty()) return overrides;
  const auto run = replay::RecordedRun::Open(options.file);
  if (!run) return run.error();
  std::vector<std::string> known;
  for (const launch::LaunchNode& node : run.value().launch().nodes()) {
    if (node.is_external()) known.push_back(node.name);
  }
  for (const auto& [node, file] : options.libraries) {
    if (std::ranges::find(known, node) == known.end()) {
      return base::WrongInput("launch.unknown_node",
                              fmt::format("the recording has no external node '{}'{}", node,
                                          known.empty() ? "" : base::DidYouMean(node, known)),
                              "--library");
    }
    overrides.emplace_back(fmt::format("nodes.{}.library", node),
                           config::Quoted(std::filesystem::absolute(file).lexically_normal().string()));
  }
  return overrides;
}

int Replay(const ReplayOptions& options) {
  const int specs = (options.verify ? 1 : 0) + (options.view && options.changes.empty() ? 1 : 0) +
                    (options.watch.frames.empty() ? 0 : 1) + (options.changes.empty() ? 0 : 1);
  if (specs != 1) {
    return base::PrintError(
        "rodeira",
        base::WrongInput("command.wrong_combination",
                         fmt::format("{} to do was named; --view, --frames, --verify or --branch was expected",
                                     specs == 0 ? "nothing" : "more than one thing"),
                         "replay"));
  }
  if (const double from_s = options.from_s.value_or(0.0); !(from_s >= 0.0 && from_s <= kMost_s)) {
    return base::PrintError(
        "rodeira",
        base::WrongInput("replay.outside_of_run",
                         fmt::format("--from {} s was found; a time from 0 s to the run's end was expected", from_s),
                         "replay"));
  }
  if (!options.changes.empty() || options.verify) {
    base::TraceCrashes();  // the nodes run in this process
    CatchInterrupts();
  }
  if (!options.changes.empty()) return MakeBranch(options);
  if (!options.record.empty())
    return base::PrintError("rodeira",
                            base::WrongInput("command.wrong_combination",
                                             "--record is of a branch: nothing else makes a new recording", "replay"));
  if (options.pace)
    return base::PrintError("rodeira", base::WrongInput("command.wrong_combination",
                                                        "--pace is of a branch; --speed is --view's", "replay"));
  if (!options.verify && !options.libraries.empty())
    return base::PrintError(
        "rodeira", base::WrongInput("command.wrong_combination", "--library is of --verify and --branch", "replay"));
  if (!options.verify) return ShowRecording(options);
  const auto libraries = LibrariesOf(options);
  if (!libraries) return base::PrintError("rodeira", libraries.error());
  const auto run = replay::RecordedRun::Open(options.file, libraries.value());
  if (!run) return base::PrintError("rodeira", run.error());
  const double base_step_s = static_cast<double>(run.value().roster().base_step_ns()) * 1e-9;
  const auto from = static_cast<lockstep::Step>(std::floor(options.from_s.value_or(0.0) / base_step_s + 1e-9));
  if (from > run.value().last_step()) {
    return base::PrintError(
        "rodeira", base::WrongInput(
                       "replay.outside_of_run",
                       fmt::format("--from {} s was found, but the run ends at {:.3f} s", options.from_s.value_or(0.0),
                                   static_cast<double>(run.value().last_step()) * base_step_s),
                       options.file));
  }
  const VerifyProgress progress(options.quiet, base_step_s, run.value().last_step());
  const auto begin = WallClock::now();
  const auto verdict = Verify(
      run.value(), from, [&](lockstep::Step step) { progress.Show(step); }, Interrupted);
  if (!verdict) return base::PrintError("rodeira", verdict.error());
  const VerifyResult& found = verdict.value();
  if (!found.substituted.empty())
    fmt::print("live input taken from the recording: {}\n", fmt::join(found.substituted, ", "));
  if (!found.external.empty())
    fmt::print(
        "not computed again, their programs are not part of Rodeira: {}; their samples were taken from the "
        "recording\n",
        fmt::join(found.external, ", "));
  if (!found.without_state.empty()) fmt::print("{}", ComputedFromTheStart(found.without_state));
  if (found.difference) {
    fmt::print("{}\n{}", found.difference->Text(), RecordedByAnother(run.value().version(), run.value().commit()));
    return 1;
  }
  fmt::print("identical: {} steps, {} nodes ({} samples, {} snapshots; from {:.3f} s; {:.1f} s of wall time)\n",
             found.last_step - found.first_step, found.nodes, found.samples, found.snapshots,
             static_cast<double>(found.first_step) * base_step_s, SecondsSince(begin));
  if (found.first_step > from) {
    fmt::print("not computed: what lies before {:.3f} s is its parent's; verify that one, {}\n",
               static_cast<double>(found.first_step) * base_step_s, run.value().parent());
  }
  return 0;
}

}  // namespace rodeira::cli
