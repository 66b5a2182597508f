// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/replay/watch_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/print_error.hpp"
#include "launch/rodeira/interrupt.hpp"
#include "launch/rodeira/replay/marks_reader.hpp"
#include "launch/rodeira/replay/recorded_moments.hpp"
#include "launch/rodeira/replay/recorded_view.hpp"
#include "nodes/view/playback/replay_window.hpp"
#include "nodes/view/window/render_thread.hpp"

namespace rodeira::cli {
namespace {

using lockstep::Step;

base::Status CheckTime(const replay::RecordedRun& run, const char* option, double time_s) {
  const double last_s = static_cast<double>(run.last_step()) * static_cast<double>(run.roster().base_step_ns()) * 1e-9;
  if (time_s >= 0.0 && time_s <= last_s + 1e-9) return {};
  return base::WrongInput("replay.outside_of_run",
                          fmt::format("{} {} s was found, but the run goes from 0 to {:.3f} s", option, time_s, last_s),
                          run.path().string());
}

base::Status Watch(const WatchOptions& options) {
  if (!(options.speed >= scene::Player::kSlowest && options.speed <= scene::Player::kFastest)) {
    return base::WrongInput("command.wrong_value",
                            fmt::format("{} was found; {} to {} times real time was expected", options.speed,
                                        scene::Player::kSlowest, scene::Player::kFastest),
                            "--speed");
  }
  const auto run = replay::RecordedRun::Open(options.file);
  if (!run) return run.error();
  if (auto status = CheckTime(run.value(), "--from", options.from_s); !status) return status;
  const auto seen = LookAt(run.value(), options);
  if (!seen) return seen.error();
  if (!nodes::HasDisplay()) {
    return base::WrongInput("view.no_display",
                            "a window is requested, but no display answers; set DISPLAY, or let --frames FOLDER --at S "
                            "write pictures without "
                            "one",
                            "--view");
  }
  MarksReader marks(options.file);
  auto window = nodes::ReplayWindow::Open(seen.value().settings, [&]() -> base::Result<nodes::ReadWorld> {
    auto world = nodes::WorldOf(run.value().launch());
    if (!world) return run.value().Named(world.error());
    return nodes::ReadWorld{std::move(world).value(), {}};
  });
  if (!window) return window.error();
  const std::int64_t base_step_ns = run.value().roster().base_step_ns();
  scene::Player player(run.value().last_step() * base_step_ns, seen.value().period * base_step_ns);
  player.set_speed(options.speed);
  player.Seek(std::llround(options.from_s * 1e9));
  if (options.paused) player.Pause();
  RecordedMoments moments(run.value(), seen.value().sources, seen.value().period);
  return window.value()->Watch(
      player, [&] { return marks.Take(); }, [&](std::int64_t time_ns) { return moments.At(time_ns); }, Interrupted);
}

base::Result<std::vector<Step>> FrameSteps(const replay::RecordedRun& run,
                                           const std::vector<lockstep::SourceIndex>& cars,
                                           const std::vector<double>& at_s) {
  std::vector<Step> steps;
  for (const double time_s : at_s) {
    if (auto status = CheckTime(run, "--at", time_s); !status) return status.error();
    const auto step = nodes::FrameStep(run.roster(), cars, time_s);
    if (!step) return step.error().WithContext("--at");
    steps.push_back(step.value());
  }
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

// Of single times, or of a film.
base::Result<std::vector<Step>> StepsOf(const replay::RecordedRun& run, const std::vector<lockstep::SourceIndex>& cars,
                                        const WatchOptions& options) {
  if (!options.at_s.empty()) return FrameSteps(run, cars, options.at_s);
  if (!options.fps)
    return base::WrongInput("command.missing_option", "--at S or --fps N was expected beside it", "--frames");
  if (auto status = CheckTime(run, "--from", options.from_s); !status) return status.error();
  const double last_s = static_cast<double>(run.last_step() * run.roster().base_step_ns()) * 1e-9;
  auto steps = nodes::FilmSteps(run.roster(), cars, *options.fps, options.from_s,
                                std::min(last_s, options.from_s + options.for_s.value_or(last_s)));
  if (!steps) return steps.error().WithContext("--fps");
  std::erase_if(steps.value(), [&](Step step) {
    return step > run.last_step();
  });  // the sample nearest to the run's end may lie behind it
  return steps;
}

base::Status WriteFrames(const WatchOptions& options) {
  const auto run = replay::RecordedRun::Open(options.file);
  if (!run) return run.error();
  auto seen = LookAt(run.value(), options);
  if (!seen) return seen.error();
  nodes::ViewSettings& settings = seen.value().settings;
  auto steps = StepsOf(run.value(), seen.value().cars, options);
  if (!steps) return steps.error();
  settings.frame_steps = std::move(steps).value();
  settings.folder = options.frames;
  settings.window = nodes::WindowMode::kNever;
  if (auto status = nodes::PrepareFolder(settings.folder); !status) return status.error().WithContext("--frames");
  auto world = nodes::WorldOf(run.value().launch());
  if (!world) return run.value().Named(world.error());
  auto render_thread = nodes::RenderThread::Open(settings, std::move(world).value());
  if (!render_thread) return render_thread.error();
  RecordedMoments moments(run.value(), seen.value().sources, seen.value().period);
  for (const Step step : settings.frame_steps) {
    if (Interrupted()) break;
    auto moment = moments.Exactly(step);
    if (!moment) return moment.error();
    const auto file = settings.folder / nodes::FrameName(step);
    if (auto status = render_thread.value()->Order(nodes::PictureOf(settings, std::move(moment).value()), file);
        !status)
      return status;
  }
  return render_thread.value()->Drain();
}

// Ctrl-C ends in order: what was unpacked is removed.
int InOrder(base::Status (*work)(const WatchOptions&), const WatchOptions& options) {
  CatchInterrupts();
  const base::Status status = work(options);
  return status ? 0 : base::PrintError("rodeira", status.error());
}

}  // namespace

int WatchRecording(const WatchOptions& options) { return InOrder(Watch, options); }
int WriteRecordedFrames(const WatchOptions& options) { return InOrder(WriteFrames, options); }

}  // namespace rodeira::cli
