// SPDX-License-Identifier: Apache-2.0
// From a wheel that is turned to a changed pixel on the display: a virtual joystick, the input node, the vehicle, the
// view with its window, in real time, in this process. latency_bench [TURNS] [INPUT_PERIOD_MS] [VIEW_PERIOD_MS] [WIDTH
// HEIGHT] [WORLD]
#include <SDL.h>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "common/core/base/mathematics.hpp"
#include "common/core/base/random.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "common/vehicle/sdl_devices/sdl_devices.hpp"
#include "launch/rodeira/graphics/all_graphics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/bench/live/watched_display.hpp"
#include "tests/tree.hpp"

namespace {

using namespace rodeira;
using Wall = std::chrono::steady_clock;

struct Size {
  int width_px = 320, height_px = 180;
};

// The threads of the run go on: nothing is destroyed.
[[noreturn]] void Fail(const std::string& why) {
  fmt::print(stderr, "{}\n", why);
  std::_Exit(1);
}

std::string LaunchText(const std::string& guid, const std::string& input_ms, const std::string& view_ms,
                       const Size& size, const std::string& world) {
  return fmt::format(R"(rodeira: launch/1
world: {}
nodes:
  road: {{kind: road}}
  driver: {{kind: input, period_s: {}e-3, config: {{source: joystick, wheel: configs/drivers/wheel.yaml,
    devices: {{wheel: "{}"}}}}}}
  ego: {{kind: vehicle, config: {{vehicle: configs/vehicles/default.yaml}}}}
  view: {{kind: view, period_s: {}e-3, config: {{window: always, camera: driver, width_px: {}, height_px: {},
    mirrors: [], instruments: false, sound: false}}}}
)",
                     world, input_ms, guid, view_ms, size.width_px, size.height_px);
}

// Milliseconds from each turn of the wheel to the first other pixel in the lower middle of the picture, where the
// steering wheel is.
std::vector<double> Turn(const bench::WatchedDisplay& display, const Size& size, SDL_Joystick* wheel, int turns) {
  std::vector<double> latencies_ms;
  const auto seen = [&] {
    return display.HashOf(size.width_px / 4, size.height_px / 2, size.width_px / 2, size.height_px / 2);
  };
  for (int turn = 0; turn < turns; ++turn) {
    // Until the car has settled, and then to any phase of all periods.
    const auto rest = std::chrono::microseconds(
        200'000 + static_cast<int>(base::RandomUniform({7, static_cast<std::uint64_t>(turn)}, 0.0, 100'000.0)));
    const auto until = Wall::now() + std::chrono::seconds(10);
    auto before = seen();
    const auto is_still = [&] {
      std::this_thread::sleep_for(rest);
      return seen() == before;
    };
    while (!is_still()) {
      if (Wall::now() > until) Fail("the picture still changes 10 s after the last turn of the wheel");
      before = seen();
    }
    const auto begin = Wall::now();
    SDL_JoystickSetVirtualAxis(wheel, 0, static_cast<Sint16>(turn % 2 == 0 ? 6000 : -6000));
    while (seen() == before) {
      if (Wall::now() - begin > std::chrono::seconds(2)) Fail("no pixel has changed for two seconds");
      std::this_thread::sleep_for(std::chrono::microseconds(300));
    }
    latencies_ms.push_back(std::chrono::duration<double, std::milli>(Wall::now() - begin).count());
  }
  return latencies_ms;
}

}  // namespace

int main(int argc, char** argv) {
  base::PinMathLibrary(argv);
  sdl_devices::UseSdlDevices();
  cli::UseAllGraphics();
  const int turns = argc > 1 ? std::atoi(argv[1]) : 100;
  const Size size = argc > 5 ? Size{std::atoi(argv[4]), std::atoi(argv[5])} : Size();
  if (size.width_px < 64 || size.height_px < 64) Fail("width and height: expected pixels, at least 64");
  const std::string world = argc > 6 ? argv[6] : "configs/worlds/plane.yaml";  // a path from the project's folder
  const bench::WatchedDisplay display(97, size.width_px, size.height_px);
  ::setenv("DISPLAY", display.name().c_str(), 1);
  auto joysticks = input_devices::Joysticks::Start();
  if (!joysticks) Fail(joysticks.error().Text());
  const int index = SDL_JoystickAttachVirtual(SDL_JOYSTICK_TYPE_WHEEL, 4, 9, 0);
  char guid[33] = {};
  SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(index), guid, sizeof(guid));
  SDL_Joystick* wheel = SDL_JoystickOpen(index);
  if (wheel == nullptr) Fail(SDL_GetError());
  SDL_JoystickSetVirtualAxis(wheel, 2, 32767);   // throttle: released
  SDL_JoystickSetVirtualAxis(wheel, 3, -32768);  // brake: pressed, as the automatic gearbox creeps

  const auto launch =
      launch::Launch::Parse(LaunchText(guid, argc > 2 ? argv[2] : "10", argc > 3 ? argv[3] : "20", size, world),
                            SourceDir() + "/latency.yaml");
  if (!launch) Fail(launch.error().Text());
  auto nodes = cli::LocalNodes::Make(launch.value());
  if (!nodes) Fail(nodes.error().Text());
  lockstep::InProcessSettings settings;
  settings.pace = 1.0;
  std::atomic<bool> over = false;
  settings.stop_requested = [&] { return over.load(); };
  lockstep::RunOutcome outcome;
  std::thread run([&] { outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings); });
  std::this_thread::sleep_for(std::chrono::seconds(3));
  std::vector<double> latencies_ms = Turn(display, size, wheel, turns);
  over = true;
  run.join();
  if (!outcome.ok) Fail(outcome.fault);
  std::sort(latencies_ms.begin(), latencies_ms.end());
  fmt::print(
      "wheel to pixel, {}, {} x {}, {} turns: median {:.1f} ms, best {:.1f}, worst {:.1f}; late steps {} of {}, mean "
      "{:.2f} ms\n",
      world, size.width_px, size.height_px, latencies_ms.size(), latencies_ms[latencies_ms.size() / 2],
      latencies_ms.front(), latencies_ms.back(), outcome.lateness.late, outcome.lateness.steps,
      outcome.lateness.mean_ns() * 1e-6);
}
