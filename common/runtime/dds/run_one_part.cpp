// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/dds/run_one_part.hpp"

#include <fmt/format.h>

#include "common/core/base/crash_trace.hpp"
#include "common/core/base/exhaustion.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/print_error.hpp"
#include "common/runtime/dds/node_bus.hpp"
#include "common/runtime/dds/options.hpp"

namespace rodeira::dds {

int RunOnePart(const std::string& program, std::string_view kind, int argc, char** argv, const OpenPart& open) {
  base::PinMathLibrary(argv);
  base::TraceCrashes();
  base::NameExhaustion(program);
  const ParsedOptions parsed = ParseOptions(program, ProgramOf::kNode, argc, argv);
  if (parsed.leave_with) return *parsed.leave_with;
  NodeBus::HandleSignals();
  const ProcessOptions& options = parsed.options;
  const auto launch = launch::Launch::Load(options.launch_file, options.overrides);
  if (!launch) return base::PrintError(program, launch.error());
  const auto& roster = launch.value().roster();
  const lockstep::NodeIndex index = roster.Find(options.node);
  if (index == roster.nodes().size() || roster.node(index).kind != kind) {
    return base::PrintError(
        program, base::WrongInput("launch.unknown_node",
                                  fmt::format("--node {}: the launch file has no node of this name and of kind '{}'",
                                              options.node, kind),
                                  options.launch_file));
  }
  const DomainSettings domain = DomainOf(options, launch.value(), options.node, {&index, 1});
  auto participant = Participant::Open(domain);
  if (!participant) return base::PrintError(program, participant.error());
  const auto part = open({launch.value(), *participant.value(), domain}, index, options.incarnation);
  if (!part) return base::PrintError(program, part.error());
  part.value()->Make();
  return part.value()->Run();
}

}  // namespace rodeira::dds
