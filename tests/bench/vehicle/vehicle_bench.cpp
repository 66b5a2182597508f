// SPDX-License-Identifier: Apache-2.0
// What a step of the bicycle costs, and its tyre formula. Simulated seconds a second = 1e6 / (microseconds a 1 ms
// step).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <vector>

#include "common/core/base/state.hpp"
#include "common/core/ground/ground.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/car_array.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

BicycleModel DefaultCar(ground::Ground& ground, double speed_mps) {
  auto loaded = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/default.yaml");
  BicycleModel car = static_cast<BicycleModel&>(*loaded.value());
  (void)car.Initialise({.speed_mps = speed_mps}, ground);
  return car;
}

void Drive(benchmark::State& state, const Controls& controls, double speed_mps) {
  ground::PlaneGround ground;
  BicycleModel car = DefaultCar(ground, speed_mps);
  for (auto _ : state) car.Step(controls, ground, 0.001);
  state.SetItemsProcessed(state.iterations());
}

void BM_StepStanding(benchmark::State& state) { Drive(state, {.brake = 1.0}, 0.0); }
void BM_StepDriving(benchmark::State& state) { Drive(state, {.steering_wheel_rad = 0.3, .throttle = 0.5}, 20.0); }

void BM_StepWithDigest(benchmark::State& state) {
  ground::PlaneGround ground;
  BicycleModel car = DefaultCar(ground, 20.0);
  base::StateWriter writer(base::StateWriter::Names::kWithout);
  for (auto _ : state) {
    car.Step({.throttle = 0.3}, ground, 0.001);
    writer.Clear();
    car.Save(writer);
    benchmark::DoNotOptimize(writer.digest());
  }
}

void BM_Initialise(benchmark::State& state) {
  ground::PlaneGround ground(Eigen::Vector3d::Zero(), 0.1, 0.05);
  BicycleModel car = DefaultCar(ground, 0.0);
  for (auto _ : state) benchmark::DoNotOptimize(car.Initialise({.heading_rad = 0.3}, ground).ok());
}

// The 159 variables through a lane change at 20 m/s, step after step: mean, and what one in ten thousand exceeds.
void BM_PrototypeLaneChange(benchmark::State& state) {
  auto loaded = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/prototype.yaml");
  auto& car = static_cast<MultibodyModel&>(*loaded.value());
  ground::PlaneGround ground;
  std::vector<double> microseconds;
  double iterations = 0.0, projections = 0.0, factorisations = 0.0, most = 0.0;
  int step = 0;
  for (auto _ : state) {
    if (step % 4000 == 0) {
      state.PauseTiming();
      (void)car.Initialise({.speed_mps = 20.0}, ground);
      state.ResumeTiming();
    }
    const double t = 0.001 * (step++ % 4000);
    const double turn = t < 1.0 ? 0.0 : t < 3.0 ? std::sin(3.14159265 * (t - 1.0)) : 0.0;
    const auto begin = std::chrono::steady_clock::now();
    car.Step({.steering_wheel_rad = turn, .throttle = 0.2}, ground, 0.001);
    microseconds.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
    iterations += car.report().iterations;
    projections += car.report().projections;
    factorisations += car.report().factorisations;
    most = std::max(most, static_cast<double>(car.report().iterations));
  }
  const auto count = static_cast<double>(microseconds.size());
  std::sort(microseconds.begin(), microseconds.end());
  state.counters["us_median"] = microseconds[microseconds.size() / 2];
  state.counters["us_9999"] = microseconds[static_cast<std::size_t>(0.9999 * (count - 1.0))];
  state.counters["iterations"] = iterations / count;
  state.counters["iterations_most"] = most;
  state.counters["projections"] = projections / count;
  state.counters["factorisations"] = factorisations / count;
}

void BM_PrototypeInitialise(benchmark::State& state) {
  auto loaded = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/prototype.yaml");
  ground::PlaneGround ground(Eigen::Vector3d::Zero(), 0.1, 0.05);
  for (auto _ : state) benchmark::DoNotOptimize(loaded.value()->Initialise({.heading_rad = 0.3}, ground).ok());
}

void BM_MagicFormula(benchmark::State& state) {
  const MagicFormulaSettings tyre;
  double alpha = 0.0;
  for (auto _ : state) {
    alpha = alpha > 0.2 ? 0.0 : alpha + 1e-4;
    benchmark::DoNotOptimize(SteadyForces(tyre, {0.02, alpha, 0.0}, 3000.0, 1.0));
  }
}

// A decision's 10 ms of many cars: ground asked once, ten steps of 1 ms each. Argument: how many; with the slip curve's
// tyres or the file's formula. Counter: how many cars go in real time on this core.
void BM_CarArray(benchmark::State& state) {
  constexpr double kDecision_s = 0.01;
  ground::PlaneGround ground;
  auto loaded = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/default.yaml");
  BicycleSettings settings = static_cast<BicycleModel&>(*loaded.value()).settings();
  if (state.range(1) != 0) {
    for (TyreSettings& tyre : settings.tyre) tyre.slip_curve = SlipCurveSettings{};
  }
  const auto count = static_cast<std::size_t>(state.range(0));
  CarArray cars;
  const auto kind = cars.AddKind(settings);
  for (std::size_t i = 0; i < count; ++i)
    (void)cars.Add(kind.value(),
                   {.y_m = 4.0 * static_cast<double>(i), .speed_mps = 8.0 + 0.02 * static_cast<double>(i)}, ground);
  std::vector<Controls> controls(count);
  int step = 0;
  for (auto _ : state) {
    // Speeds are held at 8 to 18 m/s, by bends to and fro.
    for (std::size_t i = 0; i < count; ++i) {
      const double wanted = 8.0 + 0.02 * static_cast<double>(i % 500);
      controls[i].throttle = std::clamp(0.3 * (wanted - cars.speed_mps(i)) + 0.15, 0.0, 1.0);
      controls[i].steering_wheel_rad = 0.5 * std::sin(0.005 * step + 0.1 * static_cast<double>(i));
    }
    cars.Step(controls, ground, kDecision_s);
    ++step;
  }
  state.SetItemsProcessed(state.iterations() * static_cast<long>(count));
  state.counters["cars_in_real_time"] = benchmark::Counter(
      kDecision_s * static_cast<double>(state.iterations()) * static_cast<double>(count), benchmark::Counter::kIsRate);
  state.counters["bytes_a_car"] = sizeof(BicycleCar) + sizeof(BicycleFindings);
}

BENCHMARK(BM_CarArray)->Args({500, 0})->Args({500, 1})->Args({1000, 1})->Unit(benchmark::kMillisecond);
BENCHMARK(BM_StepStanding);
BENCHMARK(BM_StepDriving);
BENCHMARK(BM_StepWithDigest);
BENCHMARK(BM_Initialise);
BENCHMARK(BM_PrototypeLaneChange)->Iterations(60000);
BENCHMARK(BM_PrototypeInitialise)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_MagicFormula);

}  // namespace
}  // namespace rodeira::dynamics
