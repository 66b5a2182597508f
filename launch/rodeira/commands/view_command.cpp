// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/view_command.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <utility>
#include <vector>

#include "common/core/base/print_error.hpp"
#include "common/core/base/suggest.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/input_files.hpp"

namespace rodeira::cli {

base::Result<RunOptions> RunOf(const ViewOptions& options) {
  const auto launch = launch::Launch::Load(options.launch_file, {});
  if (!launch) return launch.error();
  std::vector<std::string> views, screens;
  const launch::LaunchNode* chosen = nullptr;
  for (const launch::LaunchNode& node : launch.value().nodes()) {
    if (node.kind->name != "view") continue;
    views.push_back(node.name);
    const std::string screen = node.config->Peek({"config", "screen"}).value_or("");
    if (!screen.empty()) screens.push_back(screen);
    if (chosen == nullptr && (options.screen.empty() || screen == options.screen)) chosen = &node;
  }
  if (views.empty())
    return base::WrongInput("launch.no_view", "no node of kind view was found; one was expected", options.launch_file);
  if (chosen == nullptr)
    return base::WrongInput(
        "launch.unknown_screen",
        fmt::format("no view looks through a screen '{}'{}", options.screen, base::DidYouMean(options.screen, screens)),
        options.launch_file);
  RunOptions run;
  run.launch_file = options.launch_file;
  run.duration_s = options.duration_s;
  if (!options.screen.empty() && !chosen->host.empty()) {
    run.host = chosen->host;
    if (options.headset)
      return base::WrongInput(
          "command.wrong_combination",
          "--headset would make another run of this PC's part than of the others'; 'headset: true' at the view was "
          "expected",
          options.launch_file);
    return run;
  }
  for (const std::string& view : views) {
    if (!options.screen.empty() && view != chosen->name) run.overrides.emplace_back("nodes." + view + ".kind", "none");
  }
  if (options.headset) run.overrides.emplace_back("nodes." + chosen->name + ".config.headset", "true");
  return run;
}

int View(const ViewOptions& options) {
  if (options.launch_file.empty() && options.screen.empty() && !options.headset) {
    const Graphics* graphics = RegisteredGraphics();
    return graphics != nullptr ? graphics->start_window() : ContinueInGraphics("view");
  }
  if (options.launch_file.empty())
    return base::PrintError("rodeira",
                            base::WrongInput("command.missing_argument",
                                             "a launch file was expected before --screen and --headset", "view"));
  auto file = ResolveInputFile(InputKind::kLaunch, options.launch_file);
  if (!file) return base::PrintError("rodeira", file.error());
  ViewOptions resolved = options;
  resolved.launch_file = std::move(file).value();
  const auto run = RunOf(resolved);
  if (run) return Run(run.value());
  return base::PrintError("rodeira", run.error());
}

}  // namespace rodeira::cli
