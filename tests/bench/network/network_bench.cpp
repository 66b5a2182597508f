// SPDX-License-Identifier: Apache-2.0
// Where a point lies in Town04 (9.75 km, 242 roads): at most 2 µs cold, 300 ns with a hint; ten times the roads cost at
// most 1.3 times as much a query. Needs the real file beside the project.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/opendrive/import.hpp"
#include "tests/tree.hpp"

namespace rodeira::network {
namespace {

constexpr std::size_t kPoints = 1 << 16;

std::filesystem::path Town04() {
  const std::filesystem::path root(SourceDir());
  const char* file = "shared/data/road/xodr/carla_Town04.xodr";
  return std::filesystem::exists(root / ".." / file) ? root / ".." / file : root / "../.." / file;
}

// The town `copies` times, each 2 km east of the one before.
std::shared_ptr<const Network> Towns(int copies) {
  const auto town = opendrive::LoadNetwork(Town04());
  if (!town) return nullptr;
  NetworkSpec spec;
  for (int copy = 0; copy < copies; ++copy) {
    for (const Road& road : town.value()->roads()) {
      RoadSpec moved = road.spec();
      moved.id += "/" + std::to_string(copy);
      std::vector<geometry::PlanElement> elements = road.axis().elements();
      for (geometry::PlanElement& element : elements) element.start_W.x() += 2000.0 * copy;
      spec.roads.emplace_back(std::move(moved), *geometry::PlanAxis::Make(std::move(elements)));
    }
  }
  return std::make_shared<const Network>(std::move(spec));
}

// Anywhere on the lanes.
std::vector<Eigen::Vector3d> OnLanes(const Network& network) {
  const auto lanes = network.Lanes();
  std::vector<Eigen::Vector3d> points;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const LaneKey key = lanes[base::RandomBits({i, 1}) % lanes.size()];
    const LaneSection& section = network.Section(key);
    const double s = base::RandomUniform({i, 2}, section.s_m, section.end_s_m);
    points.push_back(network.Centre(key, s));
  }
  return points;
}

void QueryAll(benchmark::State& state, const Network& network, const std::vector<Eigen::Vector3d>& points,
              bool hinted) {
  std::size_t i = 0;
  Hint hint;
  for (auto _ : state) {
    const Eigen::Vector3d& p = points[i++ & (kPoints - 1)];
    benchmark::DoNotOptimize(network.Locate(p.x(), p.y(), p.z(), hinted ? &hint : nullptr));
  }
}

void Town04Cold(benchmark::State& state) {
  const auto network = Towns(static_cast<int>(state.range(0)));
  if (network == nullptr) return state.SkipWithError("no Town04");
  QueryAll(state, *network, OnLanes(*network), false);
}
BENCHMARK(Town04Cold)->Arg(1)->Arg(10);

// In one town of ten: what more roads cost that are not asked for.
void Town04OneOfTen(benchmark::State& state) {
  const auto town = Towns(1), ten = Towns(10);
  if (town == nullptr) return state.SkipWithError("no Town04");
  QueryAll(state, *ten, OnLanes(*town), false);
}
BENCHMARK(Town04OneOfTen);

// Beside the roads, to 30 m.
void Town04Beside(benchmark::State& state) {
  const auto network = Towns(static_cast<int>(state.range(0)));
  if (network == nullptr) return state.SkipWithError("no Town04");
  auto points = OnLanes(*network);
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    points[i] +=
        Eigen::Vector3d(base::RandomUniform({i, 3}, -30.0, 30.0), base::RandomUniform({i, 4}, -30.0, 30.0), 0.0);
  }
  QueryAll(state, *network, points, false);
}
BENCHMARK(Town04Beside)->Arg(1)->Arg(10);

// Along a lane at 20 m/s and 1 kHz, with the hint of the question before.
void Town04Hinted(benchmark::State& state) {
  const auto network = Towns(static_cast<int>(state.range(0)));
  if (network == nullptr) return state.SkipWithError("no Town04");
  std::vector<Eigen::Vector3d> points;
  const auto lanes = network->Lanes();
  for (std::uint64_t n = 0; points.size() < kPoints; ++n) {
    const LaneKey key = lanes[base::RandomBits({n, 7}) % lanes.size()];
    const LaneSection& section = network->Section(key);
    if (!IsDrivable(network->Find(key)->type)) continue;
    for (double s = section.s_m; s < section.end_s_m && points.size() < kPoints; s += 0.02)
      points.push_back(network->Centre(key, s));
  }
  QueryAll(state, *network, points, true);
}
BENCHMARK(Town04Hinted)->Arg(1)->Arg(10);

// As traffic asks: forty cars a town, each in turn, 0.2 m farther along its lane (20 m/s, 100 Hz) than the last time,
// without hints.
void Town04Cars(benchmark::State& state) {
  const auto network = Towns(static_cast<int>(state.range(0)));
  if (network == nullptr) return state.SkipWithError("no Town04");
  const std::size_t cars = 40 * static_cast<std::size_t>(state.range(0));
  const auto lanes = network->Lanes();
  std::vector<std::pair<LaneKey, double>> places;
  for (std::uint64_t n = 0; places.size() < cars; ++n) {
    const LaneKey key = lanes[base::RandomBits({n, 8}) % lanes.size()];
    if (IsDrivable(network->Find(key)->type)) places.emplace_back(key, network->Section(key).s_m);
  }
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; points.size() < kPoints; ++i) {
    auto& [key, s] = places[i % cars];
    const LaneSection& section = network->Section(key);
    points.push_back(network->Centre(key, s));
    s = s + 0.2 < section.end_s_m ? s + 0.2 : section.s_m;
  }
  QueryAll(state, *network, points, false);
}
BENCHMARK(Town04Cars)->Arg(1)->Arg(10);

void Town04Surfaces(benchmark::State& state) {
  const auto network = Towns(1);
  if (network == nullptr) return state.SkipWithError("no Town04");
  const auto points = OnLanes(*network);
  std::vector<Surfacing> surfaces;
  std::size_t i = 0;
  for (auto _ : state) {
    const Eigen::Vector3d& p = points[i++ & (kPoints - 1)];
    network->Surfaces(p.x(), p.y(), surfaces);
    benchmark::DoNotOptimize(surfaces.data());
  }
}
BENCHMARK(Town04Surfaces);

void LoadTown04(benchmark::State& state) {
  const auto text = base::ReadText(Town04());
  if (!text) return state.SkipWithError("no Town04");
  for (auto _ : state) benchmark::DoNotOptimize(opendrive::Read(text.value(), "Town04.xodr"));
}
BENCHMARK(LoadTown04)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rodeira::network
