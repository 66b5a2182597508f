// SPDX-License-Identifier: Apache-2.0
// How even what a window shows is: a car at 30 m/s straight ahead on the plane, real time, a real window on a display
// of its own, by the window's own frame log against the car's own samples. motion_bench [SECONDS] [POSE_PERIOD_MS]
// [WIDTH HEIGHT]
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/launch/live_keys.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/graphics/all_graphics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/bench/live/shown.hpp"
#include "tests/bench/live/watched_display.hpp"
#include "tests/tree.hpp"

namespace {

using namespace rodeira;

constexpr double kRefresh_Hz =
    60.0;                        // the display does not say: the window counts itself (scene::PicturePace::kUnknown_Hz)
constexpr double kFrom_s = 3.0;  // until then windows open and clocks settle

[[noreturn]] void Fail(const std::string& why) {
  fmt::print(stderr, "{}\n", why);
  std::exit(1);
}

std::string LaunchText(const std::filesystem::path& folder, const std::string& period_ms, const std::string& width,
                       const std::string& height) {
  return fmt::format(R"(rodeira: launch/1
world: configs/worlds/plane.yaml
nodes:
  road: {{kind: road}}
  driver: {{kind: input, config: {{source: script, script: "{}/straight.csv"}}}}
  ego: {{kind: vehicle, config: {{vehicle: configs/vehicles/default.yaml, start: {{x_m: 0, y_m: 0, heading_deg: 0,
    speed_mps: 30}}}}}}
  view: {{kind: view, period_s: {}e-3, config: {{window: always, camera: driver, width_px: {}, height_px: {},
    mirrors: [], instruments: false, sound: false, frame_log: "{}/frames.csv"}}}}
)",
                     folder.string(), period_ms, width, height, folder.string());
}

// A sample of the car: when it came, where it was, how fast.
struct Sample {
  double wall_s = 0.0, x_m = 0.0, speed_mps = 0.0;
};

// Between two samples, a millisecond apart.
Sample At(const std::map<std::int64_t, Sample>& samples, double time_s) {
  const auto step = static_cast<std::int64_t>(std::floor(time_s * 1e3));
  const auto before = samples.find(step), after = samples.find(step + 1);
  if (before == samples.end()) Fail(fmt::format("no sample of the car at {} s", time_s));
  if (after == samples.end()) return before->second;
  const double share = time_s * 1e3 - static_cast<double>(step);
  const auto mix = [share](double a, double b) { return a + share * (b - a); };
  return {mix(before->second.wall_s, after->second.wall_s), mix(before->second.x_m, after->second.x_m),
          mix(before->second.speed_mps, after->second.speed_mps)};
}

void Report(const std::vector<bench::Shown>& shown, const std::map<std::int64_t, Sample>& samples) {
  std::vector<double> even_pc, on_wall_pc, off_mm, eye_mm, delay_ms;
  std::size_t missed = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const bench::Shown& now = shown[i];
    const Sample car = At(samples, now.simulated_s);
    off_mm.push_back(1e3 * std::fabs(now.x_m - car.x_m));
    delay_ms.push_back(1e3 * (now.wall_s - car.wall_s));
    const bench::Shown& first = shown.front();
    eye_mm.push_back(1e3 * std::hypot(now.eye_x_m - now.x_m - (first.eye_x_m - first.x_m),
                                      now.eye_y_m - now.y_m - (first.eye_y_m - first.y_m)));
    if (i == 0) continue;
    const double way_m = now.x_m - shown[i - 1].x_m, passed_s = now.wall_s - shown[i - 1].wall_s;
    const double refreshes = std::max(std::round((now.simulated_s - shown[i - 1].simulated_s) * kRefresh_Hz), 1.0);
    missed += refreshes > 1.5 ? static_cast<std::size_t>(refreshes) - 1 : 0;
    if (refreshes < 1.5) even_pc.push_back(100.0 * std::fabs(way_m / (car.speed_mps / kRefresh_Hz) - 1.0));
    on_wall_pc.push_back(100.0 * std::fabs(way_m / (car.speed_mps * passed_s) - 1.0));
  }
  if (even_pc.empty()) Fail("no two pictures of refreshes that follow one another");
  const double speed_mps = At(samples, shown.back().simulated_s).speed_mps;
  fmt::print("{} pictures in {:.1f} s at {:.1f} m/s, {} refreshes without one\n", shown.size(),
             shown.back().simulated_s - shown.front().simulated_s, speed_mps, missed);
  const auto line = [](const char* what, const char* unit, const std::vector<double>& v) {
    fmt::print("  {:<58} median {:.3f} {}, 99 % {:.3f}, worst {:.3f}\n", what, bench::Quantile(v, 0.5), unit,
               bench::Quantile(v, 0.99), bench::Quantile(v, 1.0));
  };
  line("way from picture to picture against speed / 60 Hz, off by", "%", even_pc);
  line("the same against speed x the wall's time between them", "%", on_wall_pc);
  line("car shown against its own samples at that time", "mm", off_mm);
  line("eye against car, in the plane", "mm", eye_mm);
  line("shown behind the car's sample of that time", "ms", delay_ms);
}

}  // namespace

int main(int argc, char** argv) {
  base::PinMathLibrary(argv);
  cli::UseAllGraphics();
  const double seconds = argc > 1 ? std::atof(argv[1]) : 20.0;
  const std::string period_ms = argc > 2 ? argv[2] : "20", width = argc > 4 ? argv[3] : "320",
                    height = argc > 4 ? argv[4] : "180";
  const bench::WatchedDisplay display(96, std::atoi(width.c_str()), std::atoi(height.c_str()));
  ::setenv("DISPLAY", display.name().c_str(), 1);
  const auto folder = base::TemporaryFolder::Make("motion");
  if (!folder) Fail(folder.error().Text());
  const auto written =
      base::WriteWhole(folder.value().path() / "straight.csv",
                       std::string_view("time_s,steering_wheel_deg,throttle,brake\n0,0,0.35,0\n1000,0,0.35,0\n"));
  if (!written) Fail(written.error().Text());
  const auto launch =
      launch::Launch::Parse(LaunchText(folder.value().path(), period_ms, width, height), SourceDir() + "/motion.yaml");
  if (!launch) Fail(launch.error().Text());
  std::map<std::int64_t, Sample> samples;
  {
    auto nodes = cli::LocalNodes::Make(launch.value());
    if (!nodes) Fail(nodes.error().Text());
    lockstep::InProcessSettings settings;
    settings.pace = 1.0;
    settings.last_step = static_cast<lockstep::Step>((kFrom_s + seconds) * 1e3);
    settings.on_sample = [&](const lockstep::Sample& sample) {
      if (launch.value().roster().source(sample.source()).topic != idl::topics::kVehicleState) return;
      const auto state = idl::Decode<msg::VehicleState>(*sample.payload).value();
      samples[sample.valid()] = {launch::WallSeconds(), state.position_w_m().x(), state.velocity_w_mps().x()};
    };
    const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
    if (!outcome.ok) Fail(outcome.fault);
    fmt::print("pose every {} ms, {} x {}: late steps {} of {}, mean {:.2f} ms\n", period_ms, width, height,
               outcome.lateness.late, outcome.lateness.steps, outcome.lateness.mean_ns() * 1e-6);
  }
  Report(bench::ReadShown(folder.value().path() / "frames.csv", kFrom_s, kFrom_s + seconds), samples);
}
