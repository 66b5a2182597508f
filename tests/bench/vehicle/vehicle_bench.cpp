// What a step of the bicycle costs, and its tyre formula. Simulated seconds a second = 1e6 / (microseconds a 1 ms step).
#include <benchmark/benchmark.h>

#include <cmath>
#include <filesystem>

#include "common/base/state.hpp"
#include "common/terrain/ground.hpp"
#include "common/vehicle/bicycle_model.hpp"

namespace rodeira::vehicle {
namespace {

BicycleModel DefaultCar(terrain::Ground& ground, double speed_mps) {
  auto loaded = LoadVehicle(std::filesystem::path(RODEIRA_SOURCE_DIR) / "configs/vehicles/default.yaml");
  BicycleModel car = static_cast<BicycleModel&>(*loaded.value());
  (void)car.Initialise({.speed_mps = speed_mps}, ground);
  return car;
}

void Drive(benchmark::State& state, const Controls& controls, double speed_mps) {
  terrain::PlaneGround ground;
  BicycleModel car = DefaultCar(ground, speed_mps);
  for (auto _ : state) car.Step(controls, ground, 0.001);
  state.SetItemsProcessed(state.iterations());
}

void BM_StepStanding(benchmark::State& state) { Drive(state, {.brake = 1.0}, 0.0); }
void BM_StepDriving(benchmark::State& state) { Drive(state, {.steering_wheel_rad = 0.3, .throttle = 0.5}, 20.0); }

void BM_StepWithDigest(benchmark::State& state) {
  terrain::PlaneGround ground;
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
  terrain::PlaneGround ground(Eigen::Vector3d::Zero(), 0.1, 0.05);
  BicycleModel car = DefaultCar(ground, 0.0);
  for (auto _ : state) benchmark::DoNotOptimize(car.Initialise({.heading_rad = 0.3}, ground).ok());
}

void BM_MagicFormula(benchmark::State& state) {
  const MagicFormulaSettings tyre;
  double alpha = 0.0;
  for (auto _ : state) {
    alpha = alpha > 0.2 ? 0.0 : alpha + 1e-4;
    benchmark::DoNotOptimize(SteadyForces(tyre, {0.02, alpha, 0.0}, 3000.0, 1.0));
  }
}

BENCHMARK(BM_StepStanding);
BENCHMARK(BM_StepDriving);
BENCHMARK(BM_StepWithDigest);
BENCHMARK(BM_Initialise);
BENCHMARK(BM_MagicFormula);

}  // namespace
}  // namespace rodeira::vehicle
