// SPDX-License-Identifier: Apache-2.0
// `rodeira world build`, by the clock and in processor time of all threads: asked are 10 s for HASTE on two cores and 3
// s for Town04. Each world is read and written into a fresh folder; once more where nothing has changed; and once more
// after one sign has moved.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

#include "common/core/base/files.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/visual_database/database.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

namespace fs = std::filesystem;

// Reads and writes it; what was written is counted.
bool Build(benchmark::State& state, const fs::path& file, const fs::path& folder, DatabaseReport& report) {
  const auto world = road::World::Load(file);
  if (!world) {
    state.SkipWithError(world.error().Text().c_str());
    return false;
  }
  const auto written = WriteDatabase(*world.value(), {folder, static_cast<unsigned>(state.range(0))});
  if (!written) {
    state.SkipWithError(written.error().Text().c_str());
    return false;
  }
  report = written.value();
  return true;
}

void Count(benchmark::State& state, const DatabaseReport& report) {
  state.counters["tiles"] = static_cast<double>(report.tiles);
  state.counters["built"] = static_cast<double>(report.built);
}

void Fresh(benchmark::State& state, const fs::path& file) {
  const cli::TemporaryFolder folder;
  DatabaseReport report;
  int times = 0;
  for (auto _ : state) {
    if (!Build(state, file, folder.path() / std::to_string(times++), report)) return;
  }
  Count(state, report);
}

void Unchanged(benchmark::State& state, const fs::path& file) {
  const cli::TemporaryFolder folder;
  DatabaseReport report;
  if (!Build(state, file, folder.path() / "out", report)) return;
  for (auto _ : state) {
    if (!Build(state, file, folder.path() / "out", report)) return;
  }
  Count(state, report);
}

// One sign of HASTE's main road, a metre farther each time.
void AMovedSign(benchmark::State& state) {
  const cli::TemporaryFolder folder;
  std::string text = base::ReadText(fs::path(SourceDir()) / "configs/worlds/haste.yaml").value();
  const std::string sign = "{type: town, text: Alvite, s_m: 3918.204}";
  const std::size_t at = text.find(sign);
  if (at == std::string::npos)
    return state.SkipWithError("HASTE has no sign of Alvite where this program looks for it");
  const fs::path file = folder.Write("haste.yaml", text);
  DatabaseReport report;
  if (!Build(state, file, folder.path() / "out", report)) return;
  int moved = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::string other = text;
    folder.Write(
        "haste.yaml",
        other.replace(at, sign.size(), "{type: town, text: Alvite, s_m: " + std::to_string(3918 - ++moved) + "}"));
    state.ResumeTiming();
    if (!Build(state, file, folder.path() / "out", report)) return;
  }
  Count(state, report);
}

const fs::path kHaste = fs::path(SourceDir()) / "configs/worlds/haste.yaml";
const fs::path kTown04 = fs::path(SourceDir()) / "../shared/data/road/xodr/carla_Town04.xodr";

void FreshHaste(benchmark::State& state) { Fresh(state, kHaste); }
void UnchangedHaste(benchmark::State& state) { Unchanged(state, kHaste); }
void FreshTown04(benchmark::State& state) {
  if (!fs::exists(kTown04)) return state.SkipWithError("the real files are not beside the project");
  Fresh(state, kTown04);
}

// The argument: threads, 0 as many as the machine has.
BENCHMARK(FreshHaste)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(UnchangedHaste)->Arg(0)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(AMovedSign)->Arg(0)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();
BENCHMARK(FreshTown04)->Arg(0)->Iterations(1)->Unit(benchmark::kSecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
}  // namespace rodeira::nodes
