// SPDX-License-Identifier: Apache-2.0
// The autopilot's step on N222 among twenty cars, half of them oncoming: at most 15 us. Prints the processor time a
// step and a digest of all controls, which stays when the step becomes faster: with the cars spread over the whole
// road, and with all of them within 200 m. driver_bench [STEPS]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/driving/driver/autopilot.hpp"
#include "common/driving/driver/way_from_start.hpp"
#include "common/world/road/world.hpp"
#include "tests/tree.hpp"

namespace {

using namespace rodeira;

constexpr int kCars = 20;
constexpr double kStep_s = 0.01, kSpeed_mps = 14.0, kLane_m = 3.5;

// The cars at a time, spread over `over_m` from `first_m` on: those with an odd number come towards us on the other
// lane.
std::vector<driver::Footprint> CarsAt(const driver::Way& way, double time_s, double first_m, double over_m) {
  std::vector<driver::Footprint> cars;
  for (std::uint32_t i = 0; i < kCars; ++i) {
    const bool oncoming = i % 2 == 1;
    const double speed = kSpeed_mps - 0.1 * i, moved = (oncoming ? -speed : speed) * time_s;
    const double spread = std::fmod(over_m * (i + 1e6) / kCars + moved, over_m);
    const double d = std::fmod(first_m + spread, way.length_m());
    const Eigen::Vector3d p_W = way.Position(d, oncoming ? kLane_m : 0.1 * std::sin(time_s + i));
    const double heading = way.At(d).heading_rad;
    cars.push_back({i, p_W.x(), p_W.y(), oncoming ? heading + M_PI : heading, speed, 4.4, 1.8});
  }
  return cars;
}

double ProcessorTime_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

// Kept apart so that a profiler can be told to look at it alone.
__attribute__((noinline)) rodeira::dynamics::Controls MeasuredStep(rodeira::driver::Autopilot& autopilot,
                                                                   const rodeira::driver::DriverView& view) {
  return autopilot.Step(view, kStep_s);
}

void Measure(const char* name, int steps, double from_m, double over_m) {
  const auto world = road::World::Load(std::filesystem::path(SourceDir()) / "configs/worlds/n222.yaml").value();
  auto found = driver::WayFromStart(*world, std::nullopt, "bench").value();
  const driver::Way& way = *found.way;
  driver::Autopilot autopilot(driver::AutopilotSettings{}, std::move(found.way));
  const dynamics::VehicleDimensions dimensions{.wheelbase_m = 2.6,
                                               .front_m = 2.1,
                                               .rear_m = 2.2,
                                               .width_m = 1.8,
                                               .steering_ratio = 15.0,
                                               .steering_wheel_limit_rad = 9.0};
  base::Digest digest = 0;
  std::vector<double> times_s;
  for (int k = 0; k < steps; ++k) {
    const double time_s = k * kStep_s, d = std::fmod(20.0 + kSpeed_mps * time_s, way.length_m() - 40.0);
    const auto cars = CarsAt(way, time_s, over_m > 0.0 ? d + from_m : 0.0, over_m > 0.0 ? over_m : way.length_m());
    const driver::LaneFrame frame = way.At(d);
    dynamics::VehicleState state;
    state.p_WB_W = way.Position(d, 0.3 * std::sin(0.5 * time_s));
    state.q_WB = Eigen::AngleAxisd(frame.heading_rad + 0.02 * std::cos(time_s), Eigen::Vector3d::UnitZ());
    state.v_WB_W = state.q_WB * Eigen::Vector3d(kSpeed_mps, 0.0, 0.0);
    const double begin_s = ProcessorTime_s();
    const dynamics::Controls controls = MeasuredStep(autopilot, {state, dimensions, cars});
    times_s.push_back(ProcessorTime_s() - begin_s);
    const double gap_m = autopilot.leader() ? autopilot.leader()->gap_m : -1.0;
    const std::array values{controls.steering_wheel_rad, controls.throttle, controls.brake, gap_m};
    digest = base::Combine(digest, base::Hash(std::as_bytes(std::span(values))));
  }
  std::sort(times_s.begin(), times_s.end());
  fmt::print("{}: {} steps, median {:.2f} us, 99 % {:.2f} us; digest {}\n", name, steps,
             1e6 * times_s[times_s.size() / 2], 1e6 * times_s[times_s.size() * 99 / 100], base::Hex(digest));
}

int main(int argc, char** argv) {
  const int steps = argc > 1 ? std::atoi(argv[1]) : 6000;
  Measure("spread", steps, 0.0, 0.0);
  Measure("near", steps, -100.0, 200.0);
  return 0;
}
