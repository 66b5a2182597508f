// SPDX-License-Identifier: Apache-2.0
// What a step of traffic costs: planar mode on closed-meshed grids of streets, by the number of vehicles. The grids are
// maps that tools/make_grid.py writes; RODEIRA_GRIDS is the folder with grid4.motors, grid10.motors, grid32.motors and
// grid37.motors.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <chrono>
#include <optional>
#include <vector>

#include "common/core/base/state.hpp"
#include "common/traffic/results/lane_statistics.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "tests/bench/traffic/grid.hpp"

namespace rodeira::traffic {
namespace {

double HeapBytes() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

// A town with so many streets each way and so many vehicles, after 20 simulated seconds; nothing, and the state says
// why, where there is no town.
std::optional<TrafficModel> Warm(benchmark::State& state) {
  const auto network = traffic_map::LoadNetwork(Grid(state.range(0)));
  if (!network) {
    state.SkipWithError(kNoGrids);
    return std::nullopt;
  }
  TrafficSettings settings;
  settings.vehicles = static_cast<std::uint32_t>(state.range(1));
  TrafficModel model = TrafficModel::Make(settings, network.value(), {}).value();
  for (int i = 0; i < 200; ++i) model.Step(0.1, {});
  return model;
}

// Arguments: streets each way, vehicles. After 20 simulated seconds a step of 10 ms: decision and motion of every
// vehicle.
void BM_PlanarStep(benchmark::State& state) {
  auto warm = Warm(state);
  if (!warm) return;
  TrafficModel& model = *warm;
  double updates = 0.0, on_road = 0.0, steps = 0.0;
  for (auto _ : state) {
    model.Step(0.01, {});
    updates += static_cast<double>(model.on_road());
    on_road += static_cast<double>(model.on_road());
    steps += 1.0;
  }
  state.counters["updates"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
  state.counters["on_road"] = on_road / steps;
}
BENCHMARK(BM_PlanarStep)
    ->Args({4, 100})
    ->Args({10, 1000})
    ->Args({32, 10000})
    ->Args({37, 12700})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(4.0);

// The same where nothing of a step before is in near memory: between two steps, untimed, more is written than the
// caches hold. What a step of many vehicles costs more than one of few is compared with this.
void BM_PlanarStepFromFarMemory(benchmark::State& state) {
  auto warm = Warm(state);
  if (!warm) return;
  TrafficModel& model = *warm;
  constexpr std::size_t kLine_bytes = 64;
  std::vector<char> far(64u << 20u);
  double updates = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    for (std::size_t at = 0; at < far.size(); at += kLine_bytes) ++far[at];
    benchmark::DoNotOptimize(far.data());
    benchmark::ClobberMemory();
    state.ResumeTiming();
    model.Step(0.01, {});
    updates += static_cast<double>(model.on_road());
  }
  state.counters["updates"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
}
BENCHMARK(BM_PlanarStepFromFarMemory)
    ->Args({4, 100})
    ->Args({10, 1000})
    ->Args({32, 10000})
    ->Args({37, 12700})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(0.4);

// Full physics, 1 kHz below decisions of 100 Hz, SUELO under every wheel: 10 ms of the town of 10 × 10 on one thread,
// and how many of such cars one core drives in real time.
void BM_FullPhysics(benchmark::State& state) {
  const auto network = traffic_map::LoadNetwork(Grid(10));
  if (!network) return state.SkipWithError(kNoGrids);
  TrafficSettings settings;
  settings.vehicles = static_cast<std::uint32_t>(state.range(0));
  settings.physics = Physics::kFull;
  TrafficModel model = TrafficModel::Make(settings, network.value(), {}).value();
  constexpr double kStep_s = 0.01;
  for (int i = 0; i < 200; ++i) model.Step(kStep_s, {});
  double updates = 0.0, steps = 0.0;
  for (auto _ : state) {
    model.Step(kStep_s, {});
    updates += static_cast<double>(model.on_road());
    steps += 1.0;
  }
  state.counters["updates"] = benchmark::Counter(updates, benchmark::Counter::kIsRate);
  state.counters["cars_in_real_time"] = benchmark::Counter(updates * kStep_s, benchmark::Counter::kIsRate);
  state.counters["on_road"] = updates / steps;
}
BENCHMARK(BM_FullPhysics)->Arg(100)->Arg(500)->Arg(1000)->Unit(benchmark::kMillisecond)->MinTime(4.0);

// What the sums of every metre of lane add to a step: both are timed in the same run, one after the other.
void BM_HeatMapOfAMetre(benchmark::State& state) {
  auto warm = Warm(state);
  if (!warm) return;
  TrafficModel& model = *warm;
  LaneStatistics statistics(model);
  using Clock = std::chrono::steady_clock;
  Clock::duration stepping{}, summing{};
  for (auto _ : state) {
    const auto begin = Clock::now();
    model.Step(0.01, {});
    const auto stepped = Clock::now();
    statistics.Add(model, 0.01);
    stepping += stepped - begin;
    summing += Clock::now() - stepped;
  }
  state.counters["added_share"] = static_cast<double>(summing.count()) / static_cast<double>(stepping.count());
}
BENCHMARK(BM_HeatMapOfAMetre)
    ->Args({4, 100})
    ->Args({10, 1000})
    ->Args({32, 10000})
    ->Unit(benchmark::kMillisecond)
    ->MinTime(2.0);

// The heap that vehicles take beyond the map, a vehicle.
void BM_Memory(benchmark::State& state) {
  const auto network = traffic_map::LoadNetwork(Grid(10));
  if (!network) return state.SkipWithError(kNoGrids);
  const auto bytes = [&](std::uint32_t vehicles) {
    TrafficSettings settings;
    settings.vehicles = vehicles;
    const double before = HeapBytes();
    TrafficModel model = TrafficModel::Make(settings, network.value(), {}).value();
    for (int i = 0; i < 200; ++i) model.Step(0.1, {});
    return HeapBytes() - before;
  };
  double a_vehicle = 0.0;
  for (auto _ : state) a_vehicle = (bytes(2000) - bytes(0)) / 2000.0;
  state.counters["bytes_a_vehicle"] = a_vehicle;
}
BENCHMARK(BM_Memory)->Iterations(1);

}  // namespace
}  // namespace rodeira::traffic
