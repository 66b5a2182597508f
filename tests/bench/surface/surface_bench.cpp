// SPDX-License-Identifier: Apache-2.0
// Measured and made surfaces, a point at a time.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/world/surface/roughness.hpp"
#include "tests/common/world/surface/made_crg.hpp"

namespace rodeira::surface {
namespace {

constexpr std::size_t kPoints = 1 << 14;

// 100 m of road, 4 m wide, every centimetre along and every two across: 2 million heights.
const CrgSurface& Grid(bool bend) {
  const auto make = [](bool bent) {
    MadeCrg made;
    made.format = "KRBI";
    made.rows = 10'001;
    made.step = 0.01;
    made.v.clear();
    for (int i = 0; i <= 200; ++i) made.v.push_back(-2.0 + 0.02 * i);
    made.z = [](double u, double v) { return 0.01 * std::sin(3.0 * u) * std::cos(5.0 * v); };
    if (bent) made.heading = [](double u) { return 0.5 * std::sin(0.1 * u); };
    return made.Parse().value().surface;
  };
  static const auto straight = make(false), bent = make(true);
  return bend ? *bent : *straight;
}

void CrgOverUAndV(benchmark::State& state) {
  const CrgSurface& grid = Grid(false);
  std::vector<std::pair<double, double>> places;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    places.emplace_back(base::RandomUniform({i, 1}, 0.0, 100.0), base::RandomUniform({i, 2}, -2.0, 2.0));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [u, v] = places[i++ & (kPoints - 1)];
    benchmark::DoNotOptimize(grid.At(u, v));
  }
}
BENCHMARK(CrgOverUAndV);

void CrgOverXAndY(benchmark::State& state) {
  const CrgSurface& grid = Grid(state.range(0) != 0);
  std::vector<Eigen::Vector2d> places;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    places.push_back(
        grid.line().Position(base::RandomUniform({i, 1}, 0.0, 100.0), base::RandomUniform({i, 2}, -2.0, 2.0)));
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const Eigen::Vector2d& p = places[i++ & (kPoints - 1)];
    benchmark::DoNotOptimize(grid.Ground(p.x(), p.y()));
  }
}
BENCHMARK(CrgOverXAndY)->Arg(0)->Arg(1);

void RoughnessRandom(benchmark::State& state) {
  const Roughness roughness({256e-6, 1});
  std::uint64_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(roughness.At(base::RandomUniform({++i}, 0.0, 1e4), 1.5));
}
BENCHMARK(RoughnessRandom);

}  // namespace
}  // namespace rodeira::surface
