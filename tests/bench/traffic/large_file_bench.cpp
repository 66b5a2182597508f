// SPDX-License-Identifier: Apache-2.0
// An OpenDRIVE file of 9 MB with 4608 roads, of which 952 are U-turns that miss their lanes: asked are 2 s to read and
// check it, and 4 s to the first step of traffic. SUMO's netgenerate makes it: 16 x 16 junctions with lights. Where
// SUMO is not installed the benchmark says so.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <string>

#include "common/core/base/temporary_folder.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/opendrive/import.hpp"

namespace rodeira::traffic {
namespace {

// The argument: steps of traffic after reading.
void BM_LargeFile(benchmark::State& state) {
  const auto scratch = base::TemporaryFolder::Make("large");
  if (!scratch) return state.SkipWithError(scratch.error().message.c_str());
  const std::string file = (scratch.value().path() / "grid.xodr").string();
  const std::string make =
      "netgenerate --grid --grid.number 16 --default-junction-type traffic_light --seed 1 --opendrive-output " + file +
      " >/dev/null 2>&1";
  if (std::system(make.c_str()) != 0) return state.SkipWithError("SUMO is not installed (package sumo)");
  for (auto _ : state) {
    const auto network = opendrive::LoadNetwork(file);
    if (!network) return state.SkipWithError(network.error().message.c_str());
    state.counters["roads"] = static_cast<double>(network.value()->roads().size());
    if (state.range(0) == 0) continue;
    TrafficSettings settings;
    settings.vehicles = 40;
    TrafficModel model = TrafficModel::Make(settings, network.value(), {}).value();
    for (int i = 0; i < state.range(0); ++i) model.Step(0.1, {});
  }
}
BENCHMARK(BM_LargeFile)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kSecond)->MeasureProcessCPUTime();

}  // namespace
}  // namespace rodeira::traffic
