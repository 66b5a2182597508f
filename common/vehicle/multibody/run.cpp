// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rodeira::multibody {
namespace {

constexpr double kMaxValues = 1e8;
constexpr long kProgressSteps = 1000;

void AddRow(const Mechanism& mechanism, plot::Table& table) {
  table.values.push_back(mechanism.system->time_s());
  for (const Output& output : mechanism.outputs) table.values.push_back(output.ValueOf(*mechanism.system));
}

}  // namespace

base::Status RunMechanism(Mechanism& mechanism, double until_s, double step_s, plot::Table& table, RunSummary& summary,
                          const std::function<void(double)>& progress) {
  if (!(until_s > 0.0 && std::isfinite(until_s)))
    return base::WrongInput("command.wrong_value", fmt::format("--until is {}; a time over 0 s was expected", until_s));
  if (!(step_s > 0.0 && step_s <= until_s))
    return base::WrongInput(
        "command.wrong_value",
        fmt::format("--step is {}; a time over 0 and at most --until ({} s) was expected", step_s, until_s));
  table.names.assign(1, "time_s");
  for (const Output& output : mechanism.outputs) table.names.push_back(output.name);
  const double wanted = std::ceil(until_s / step_s - 1e-6);
  if (wanted * static_cast<double>(table.names.size()) > kMaxValues) {
    return base::WrongInput(
        "table.too_large",
        fmt::format("{:.3g} steps of {} outputs are too many for a table; at most 100 million values were expected",
                    wanted, table.names.size()));
  }
  System& system = *mechanism.system;
  summary = {};
  summary.steps = static_cast<long>(wanted);
  summary.step_s = until_s / wanted;
  summary.energy_start_J = system.Energy();
  AddRow(mechanism, table);
  for (long i = 0; i < summary.steps; ++i) {
    const StepReport report = system.Step(summary.step_s);
    system.set_time_s(static_cast<double>(i + 1) * summary.step_s);  // no rounding gathers
    if (!report.converged) {
      return base::Failed(
          "mechanism.no_convergence",
          fmt::format(
              "the step to {:.6g} s did not converge ({} iterations, {} projections); a shorter --step may help",
              system.time_s(), report.iterations, report.projections));
    }
    AddRow(mechanism, table);
    summary.iterations += report.iterations;
    summary.most_iterations = std::max(summary.most_iterations, report.iterations);
    summary.factorisations += report.factorisations;
    summary.violation_m = std::max(summary.violation_m, system.Violation());
    summary.violation_mps = std::max(summary.violation_mps, system.RateViolation());
    if (progress && i % kProgressSteps == 0) progress(static_cast<double>(i) / wanted);
  }
  summary.energy_end_J = system.Energy();
  return {};
}

}  // namespace rodeira::multibody
