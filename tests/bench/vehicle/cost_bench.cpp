// SPDX-License-Identifier: Apache-2.0
// What aligning moment, anti-lock brakes and edges cost of a step: processor time with over without, in turns in one
// run. Prints a table with tabs between the columns; tests/bench/vehicle/costs.tsv is one.
//
//   bin/vehicle_cost_bench [ROUNDS]
#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/vehicle/dynamics/multibody_model.hpp"
#include "common/vehicle/dynamics/ode_model.hpp"
#include "tests/common/vehicle/dynamics/contact_energy.hpp"
#include "tests/tree.hpp"

namespace rodeira::dynamics {
namespace {

struct Parts {
  bool aligning_moment = true;
  bool abs = false;
};

template <class Settings>
void Set(const Parts& parts, Settings& tyres, assists::AssistSettings& assists) {
  if (!parts.aligning_moment) {
    for (TyreSettings& tyre : tyres) {
      tyre.aligning.reset();
      tyre.pneumatic_trail_m = 0.0;
    }
  }
  assists = {};
  assists.abs = parts.abs;
}

std::unique_ptr<VehicleModel> Make(const std::string& file, const Parts& parts) {
  auto loaded = LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles" / file);
  if (const auto* bicycle = dynamic_cast<BicycleModel*>(loaded.value().get())) {
    BicycleSettings settings = bicycle->settings();
    Set(parts, settings.tyre, settings.assists);
    return std::make_unique<BicycleModel>(settings);
  }
  if (const auto* ode = dynamic_cast<OdeModel*>(loaded.value().get())) {
    OdeSettings settings = ode->settings();
    Set(parts, settings.car.tyre, settings.car.assists);
    auto made = std::make_unique<OdeModel>(settings);
    if (!made->Build().ok()) std::abort();
    return made;
  }
  MultibodySettings settings = dynamic_cast<MultibodyModel&>(*loaded.value()).settings();
  Set(parts, settings.tyre, settings.assists);
  auto made = std::make_unique<MultibodyModel>(settings);
  if (!made->Build().ok()) std::abort();
  return made;
}

// Microseconds of processor time a step, from 20 m/s on.
double Cost(VehicleModel& car, ground::Ground& ground, double brake) {
  constexpr int kSteps = 400;
  if (!car.Initialise({.speed_mps = 20.0}, ground).ok()) std::abort();
  Controls controls;
  controls.gearbox = GearboxMode::kManual;
  controls.brake = brake;
  std::timespec begin{}, end{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begin);
  for (int i = 0; i < kSteps; ++i) {
    controls.steering_wheel_rad = 0.3 * std::sin(0.01 * i);
    car.Step(controls, ground, 0.001);
  }
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &end);
  return (static_cast<double>(end.tv_sec - begin.tv_sec) * 1e6 +
          static_cast<double>(end.tv_nsec - begin.tv_nsec) * 1e-3) /
         kSteps;
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void Compare(const char* model, const char* what, VehicleModel& with, ground::Ground& ground_with,
             VehicleModel& without, ground::Ground& ground_without, double brake, int rounds) {
  std::vector<double> with_us, without_us, ratios;
  for (int round = 0; round < rounds; ++round) {
    const bool first = round % 2 == 0;
    const double a = first ? Cost(with, ground_with, brake) : 0.0;
    const double b = Cost(without, ground_without, brake);
    const double now = first ? a : Cost(with, ground_with, brake);
    with_us.push_back(now);
    without_us.push_back(b);
    ratios.push_back(now / b);
  }
  std::printf("%s\t%s\t%.3f\t%.3f\t%.3f\n", model, what, Median(without_us), Median(with_us), Median(ratios));
}

}  // namespace
}  // namespace rodeira::dynamics

int main(int argc, char** argv) {
  using namespace rodeira::dynamics;
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 101;
  std::printf("model\tpart\twithout_us\twith_us\tratio\n");
  rodeira::ground::PlaneGround plane;
  // A kerb up and down each metre: some wheel is at an edge at all times.
  std::vector<ProfileGround::Corner> corners{{1.0, 0.0}};
  for (int i = 0; i < 30; ++i) {
    const double x_m = 1.0 + i, from_m = i % 2 == 0 ? 0.0 : 0.03;
    corners.push_back({x_m, from_m});
    corners.push_back({x_m, 0.03 - from_m});
  }
  ProfileGround kerbs(corners), level({{1.0, 0.0}, {31.0, 0.0}});
  for (const auto& [model, file] :
       {std::pair{"bicycle", "default.yaml"}, std::pair{"ode", "ode.yaml"}, std::pair{"multibody", "prototype.yaml"}}) {
    const auto plain = Make(file, {}), no_moment = Make(file, {.aligning_moment = false}),
               abs = Make(file, {.abs = true});
    Compare(model, "aligning moment", *plain, plane, *no_moment, plane, 0.0, rounds);
    Compare(model, "anti-lock brakes, coasting", *abs, plane, *plain, plane, 0.0, rounds);
    Compare(model, "anti-lock brakes, full brake", *abs, plane, *plain, plane, 1.0, rounds);
    Compare(model, "both, coasting", *abs, plane, *no_moment, plane, 0.0, rounds);
    Compare(model, "both, full brake", *abs, plane, *no_moment, plane, 1.0, rounds);
    Compare(model, "kerbs", *plain, kerbs, *plain, level, 0.0, rounds);
  }
  return 0;
}
