// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/all_commands.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/print_error.hpp"
#include "launch/rodeira/key_values.hpp"
#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/replay/replay_command.hpp"
#include "launch/rodeira/result_files.hpp"

namespace rodeira::cli {

void AddReplay(CLI::App& app, ChosenCommand& chosen) {
  const auto options = std::make_shared<ReplayOptions>();
  const auto changes = std::make_shared<std::vector<std::string>>();
  const auto libraries = std::make_shared<std::vector<std::string>>();
  CLI::App* replay = app.add_subcommand("replay", "watch a recording, or run it again");
  replay->add_option("FILE.mcap", options->file, "recording")->required();
  CLI::Option* view = replay->add_flag("--view", options->view, "watch it, or the branch, in a window");
  replay->add_option("--speed", options->watch.speed, "times real time, 0.1 to 10")->needs(view)->capture_default_str();
  replay->add_flag("--paused", options->watch.paused, "begin paused")->needs(view);
  CLI::Option* frames =
      replay->add_option("--frames", options->watch.frames, "folder: write pictures (PNG) as the run's view would have")
          ->check(NewFolder());
  CLI::Option* at = replay->add_option("--at", options->watch.at_s, "simulated seconds of the pictures")->needs(frames);
  replay
      ->add_option("--fps", options->watch.fps,
                   "instead: a film of so many pictures a simulated second, from --from on")
      ->needs(frames)
      ->excludes(at);
  replay->add_option("--camera", options->watch.camera,
                     "chase, driver, bonnet, orbit, top or trackside; otherwise as the run's view");
  replay->add_option("--follow", options->watch.follow, "name of a vehicle node; otherwise as the run's view");
  replay->add_option("--quality", options->watch.quality, "low, medium or high; otherwise as the run's view");
  replay->add_option("--size", options->watch.size, "WIDTHxHEIGHT in pixels; otherwise as the run's view");
  replay->add_flag("--verify", options->verify, "compute everything again and compare every sample and state");
  replay->add_option("--from", options->from_s, "simulated seconds at which to begin");
  replay->add_option("--branch", *changes, "KEY=VALUE: go on from --from with another value of the launch file");
  replay->add_option("--library", *libraries,
                     "NODE=FILE.so: run this external node again, in a verification or a branch");
  replay->add_option("--for", options->for_s, "simulated seconds of the branch or film")->check(PositiveSeconds());
  replay->add_option("--record", options->record, "recording of the branch (MCAP)");
  replay->add_option("--pace", options->pace,
                     "of the branch: max, real or a factor; otherwise real where a person drives or watches, or max");
  replay->add_flag("--quiet", options->quiet, "no progress");
  chosen.When(*replay, [options, changes, libraries] {
    auto changed = KeyValues("--branch", *changes);
    if (!changed) return base::PrintError("rodeira", changed.error());
    auto named = KeyValues("--library", *libraries);
    if (!named) return base::PrintError("rodeira", named.error());
    options->changes = std::move(changed).value();
    options->libraries = std::move(named).value();
    return Replay(*options);
  });
}

}  // namespace rodeira::cli
