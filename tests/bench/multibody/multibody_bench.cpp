// SPDX-License-Identifier: Apache-2.0
// What a step of a mechanism costs.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

#include "common/vehicle/multibody/mechanism.hpp"
#include "tests/tree.hpp"

namespace rodeira::multibody {
namespace {

void Step(benchmark::State& state, const std::string& name, double step_s) {
  auto mechanism = LoadMechanism(std::filesystem::path(SourceDir()) / "configs/mechanisms" / (name + ".yaml"));
  System& system = *mechanism.value().system;
  double iterations = 0.0, projections = 0.0, factorisations = 0.0;
  for (auto _ : state) {
    const StepReport report = system.Step(step_s);
    iterations += report.iterations;
    projections += report.projections;
    factorisations += report.factorisations;
  }
  const auto count = static_cast<double>(state.iterations());
  state.counters["variables"] = system.variables();
  state.counters["iterations"] = iterations / count;
  state.counters["projections"] = projections / count;
  state.counters["factorisations"] = factorisations / count;
}

BENCHMARK_CAPTURE(Step, pendulum, "pendulum", 1e-3);
BENCHMARK_CAPTURE(Step, four_bar_2, "four_bar_2", 1e-3);
BENCHMARK_CAPTURE(Step, four_bar_40, "four_bar_40", 1e-3);
BENCHMARK_CAPTURE(Step, andrews, "andrews", 1e-5);

// A02 with 40 loops, 20 s at 1 ms: the benchmark library's measure of cost.
void FourBar40For20s(benchmark::State& state) {
  for (auto _ : state) {
    auto mechanism = LoadMechanism(std::filesystem::path(SourceDir()) / "configs/mechanisms/four_bar_40.yaml");
    for (int i = 0; i < 20000; ++i) (void)mechanism.value().system->Step(1e-3);
    benchmark::DoNotOptimize(mechanism.value().system->q()[0]);
  }
}
BENCHMARK(FourBar40For20s)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rodeira::multibody
