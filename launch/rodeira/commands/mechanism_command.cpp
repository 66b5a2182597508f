// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/mechanism_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "common/core/base/files.hpp"
#include "common/core/base/print_error.hpp"
#include "common/vehicle/multibody/run.hpp"
#include "launch/rodeira/wall_clock.hpp"

namespace rodeira::cli {
namespace {

void PrintMechanism(const multibody::Mechanism& mechanism, const multibody::RunSummary& s, double wall_s) {
  const multibody::System& system = *mechanism.system;
  fmt::print("mechanism        {}\n", system.drawing().name.empty() ? "without a name" : system.drawing().name);
  fmt::print("variables        {} ({} degrees of freedom)\n", system.variables(), system.degrees_of_freedom());
  fmt::print("steps            {} of {:.6g} s, {:.2f} iterations a step (at most {}), {:.2f} factorisations\n", s.steps,
             s.step_s, static_cast<double>(s.iterations) / static_cast<double>(s.steps), s.most_iterations,
             static_cast<double>(s.factorisations) / static_cast<double>(s.steps));
  fmt::print("constraints      |Φ| up to {:.2g}, |dΦ/dt| up to {:.2g}\n", s.violation_m, s.violation_mps);
  fmt::print("energy           {:.9g} J to {:.9g} J\n", s.energy_start_J, s.energy_end_J);
  fmt::print("wall time        {:.3g} s, {:.3g} times real time\n", wall_s,
             static_cast<double>(s.steps) * s.step_s / wall_s);
  for (const multibody::Output& output : mechanism.outputs)
    fmt::print("{:<16} {}\n", output.name, output.ValueOf(system));
}

}  // namespace

int RunMechanismFile(const MechanismOptions& options) {
  auto mechanism = multibody::LoadMechanism(options.file);
  if (!mechanism) return base::PrintError("rodeira", mechanism.error());
  plot::Table table;
  multibody::RunSummary summary;
  const auto begin = WallClock::now();
  bool shown = false;
  const bool terminal = !options.quiet && ::isatty(STDERR_FILENO) == 1;
  const auto progress = [&](double share) {
    if (!terminal || SecondsSince(begin) < 2.0) return;
    fmt::print(stderr, "\r{:3.0f} %", 100.0 * share);
    shown = true;
  };
  const base::Status status =
      multibody::RunMechanism(mechanism.value(), options.until_s, options.step_s, table, summary, progress);
  const double wall_s = SecondsSince(begin);
  if (shown) fmt::print(stderr, "\r     \r");
  if (!status) {
    if (status.error().code == base::ErrorCode::kWrongInput) return base::PrintError("rodeira", status.error());
    return base::PrintError("rodeira", base::Failed(status.error().id, status.error().message, options.file));
  }
  if (!options.quiet) PrintMechanism(mechanism.value(), summary, wall_s);
  if (!options.csv.empty()) {
    if (auto written = base::WriteWhole(options.csv, plot::ToCsv(table)); !written)
      return base::PrintError("rodeira", written.error());
    if (!options.quiet) fmt::print("wrote            {}\n", options.csv);
  }
  if (!options.svg.empty()) {
    const std::string title = mechanism.value().system->drawing().name;
    if (auto written = base::WriteWhole(options.svg, plot::ToSvg(table, title)); !written)
      return base::PrintError("rodeira", written.error());
    if (!options.quiet) fmt::print("wrote            {}\n", options.svg);
  }
  return 0;
}

}  // namespace rodeira::cli
