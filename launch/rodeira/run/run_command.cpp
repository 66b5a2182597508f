// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/run_command.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <random>
#include <thread>
#include <utility>

#include "common/core/base/installation.hpp"
#include "common/core/base/print_error.hpp"
#include "common/runtime/launch/pace.hpp"
#include "common/runtime/launch/process_proposal.hpp"
#include "common/runtime/launch/shared_process.hpp"
#include "launch/rodeira/files_from_here.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/input_files.hpp"
#include "launch/rodeira/named_inputs.hpp"
#include "launch/rodeira/run/in_process_command.hpp"
#include "launch/rodeira/run/launch_path.hpp"
#include "launch/rodeira/run/node_processes.hpp"
#include "launch/rodeira/run/placement.hpp"
#include "launch/rodeira/run/process_run.hpp"
#include "launch/rodeira/run/resolve_frames.hpp"
#include "launch/rodeira/run/resolve_recording.hpp"
#include "launch/rodeira/run/run_meta.hpp"
#include "launch/rodeira/run/run_network.hpp"
#include "launch/rodeira/whole_steps.hpp"

namespace rodeira::cli {
namespace {

std::string FreshRunName() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

// A node without its program would end the run after its start: it is refused before.
base::Status CheckNodePrograms(const launch::Launch& launch, const Placement& placement) {
  for (const launch::NodeProcess& process : launch::ProcessesOf(launch)) {
    const launch::LaunchNode& node = launch.node(process.nodes.front());
    if (!placement.Has(node)) continue;
    const std::string program = base::FindProgram(ProgramOf(launch, process)).string();
    struct stat found {};
    if (::stat(program.c_str(), &found) == 0 && S_ISDIR(found.st_mode)) {
      errno = EISDIR;
    } else if (::access(program.c_str(), X_OK) == 0) {
      continue;
    }
    const std::string advice =
        process.is_shared()
            ? fmt::format("--set nodes.{}.process=~ takes the node out of process '{}'", node.name, process.name)
            : fmt::format("--set nodes.{}.kind=none leaves the node out", node.name);
    return base::WrongInput("system.cannot_start_program",
                            fmt::format("cannot start {}: {}; {}", program, std::strerror(errno), advice),
                            fmt::format("node '{}'", node.name));
  }
  return {};
}

// For a person at a terminal.
void ProposeSharedProcesses(const RunOptions& options, const Placement& placement, const launch::Launch& launch) {
  if (options.quiet || ::isatty(STDERR_FILENO) == 0) return;
  launch::RunOnOnePc pc{{}, placement.has_clock(), std::max(1U, std::thread::hardware_concurrency())};
  for (lockstep::NodeIndex n = 0; n < launch.nodes().size(); ++n) {
    if (placement.Has(launch.node(n))) pc.nodes.push_back(n);
  }
  const std::string text = launch::ProposalText(launch, pc);
  if (!text.empty()) fmt::print(stderr, "rodeira: {}\n", text);
}

}  // namespace

int Run(const RunOptions& given) {
  RunOptions options = given;
  if (options.list) {
    fmt::print("{}", ListInputFiles(InputKind::kLaunch));
    return 0;
  }
  if (options.launch_file.empty()) {
    return base::PrintError("rodeira", base::WrongInput("command.missing_argument",
                                                        "a launch file or its name was expected; `rodeira run --list` "
                                                        "prints the known ones",
                                                        "run"));
  }
  auto file = ResolveInputFile(InputKind::kLaunch, options.launch_file);
  if (!file) return base::PrintError("rodeira", file.error());
  file = LaunchPath(file.value());
  if (!file) return base::PrintError("rodeira", file.error());
  options.launch_file = std::move(file).value();
  if (const auto pace = launch::ParsePace(options.pace.empty() ? "max" : options.pace); !pace)
    return base::PrintError("rodeira", pace.error());
  const auto named = WithNamedInputs(options.overrides, options.launch_file, "--set");
  if (!named) return base::PrintError("rodeira", named.error());
  launch::Overrides overrides = WithFilesFromHere(named.value(), options.launch_file);
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
    ResolveFrames(launch.value(), placement, resolved.record, overrides);
    launch = launch::Launch::Load(options.launch_file, overrides);
  }
  if (launch.ok() && !resolved.meta.empty()) {
    if (auto status = AddMeta(launch.value(), resolved.meta, overrides); !status)
      return base::PrintError("rodeira", status.error());
    launch = launch::Launch::Load(options.launch_file, overrides);
  }
  if (!launch) return base::PrintError("rodeira", launch.error());
  if (options.duration_s) {
    const auto steps =
        WholeSteps(*options.duration_s, launch.value().roster().base_step_ns(), "--for", options.launch_file);
    if (!steps) return base::PrintError("rodeira", steps.error());
  }
  if (auto status = launch.value().CheckRecovery(); !status && !options.in_process)
    return base::PrintError("rodeira", status.error());
  if (resolved.pace.empty()) resolved.pace = launch.value().pace().empty() ? "max" : launch.value().pace();
  if (resolved.run.empty()) resolved.run = FreshRunName();
  if (options.in_process) {
    if (NeedsGraphics(launch.value()) && CanContinueInGraphics()) return ContinueInGraphics("run --in-process");
    return RunInProcess(resolved, launch.value());
  }
  if (auto status = CheckNodePrograms(launch.value(), placement); !status)
    return base::PrintError("rodeira", status.error());
  // A button of a wheel or a game pad pauses the run.
  if (std::ranges::any_of(launch.value().nodes(), ReadsDevice) && CanContinueInGraphics())
    return ContinueInGraphics("run");
  const auto network = RunNetwork::Prepare(resolved, placement, launch.value());
  if (!network) return base::PrintError("rodeira", network.error());
  resolved.domain = network.value().domain;
  if (!network.value().note.empty()) {
    fmt::print(stderr, "rodeira: {}\n", network.value().note);
    std::ranges::copy(network.value().overrides, std::back_inserter(overrides));
    launch = launch::Launch::Load(options.launch_file, overrides);
    if (!launch) return base::PrintError("rodeira", launch.error());
  }
  ProposeSharedProcesses(resolved, placement, launch.value());
  return RunProcesses(resolved, placement, launch.value(), std::move(overrides));
}

}  // namespace rodeira::cli
