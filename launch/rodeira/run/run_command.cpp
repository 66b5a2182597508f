// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/run_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <utility>

#include "common/core/base/print_error.hpp"
#include "common/runtime/launch/pace.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/run/in_process_command.hpp"
#include "launch/rodeira/run/placement.hpp"
#include "launch/rodeira/run/process_run.hpp"
#include "launch/rodeira/run/resolve_recording.hpp"
#include "launch/rodeira/run/run_meta.hpp"

namespace rodeira::cli {
namespace {

std::string FreshRunName() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

}  // namespace

int Run(const RunOptions& options) {
  if (const auto pace = launch::ParsePace(options.pace.empty() ? "max" : options.pace); !pace)
    return base::PrintError("rodeira", pace.error());
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
    if (!found) return base::PrintError("rodeira", found.error());
    placement = std::move(found).value();
    if (auto status = ResolveRecording(launch.value(), placement, resolved, overrides); !status)
      return base::PrintError("rodeira", status.error());
    launch = launch::Launch::Load(options.launch_file, overrides);
  }
  if (launch.ok() && !resolved.meta.empty()) {
    if (auto status = AddMeta(launch.value(), resolved.meta, overrides); !status)
      return base::PrintError("rodeira", status.error());
    launch = launch::Launch::Load(options.launch_file, overrides);
  }
  if (!launch) return base::PrintError("rodeira", launch.error());
  if (auto status = launch.value().CheckRecovery(); !status && !options.in_process)
    return base::PrintError("rodeira", status.error());
  if (resolved.pace.empty()) resolved.pace = launch.value().pace().empty() ? "max" : launch.value().pace();
  if (resolved.run.empty()) resolved.run = FreshRunName();
  if (options.in_process) {
    if (NeedsGraphics(launch.value()) && CanContinueInGraphics()) return ContinueInGraphics("run --in-process");
    return RunInProcess(resolved, launch.value());
  }
  // A button of a wheel or a game pad pauses the run.
  if (std::ranges::any_of(launch.value().nodes(), ReadsDevice) && CanContinueInGraphics())
    return ContinueInGraphics("run");
  return RunProcesses(resolved, placement, launch.value(), std::move(overrides));
}

}  // namespace rodeira::cli
