#include "launch/input_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numbers>
#include <thread>

#include "common/base/files.hpp"
#include "common/hands/wheel_setup.hpp"
#include "launch/interrupt.hpp"
#include "nodes/input/joysticks.hpp"

namespace rodeira::front {
namespace {

constexpr double kTick_s = 0.01;
constexpr double kPatience_s = 60.0;  // without any progress

int Refuse(const base::Error& error) {
  fmt::print(stderr, "rodeira: {}\n", error.Text());
  return error.exit_status();
}

base::Status Write(const InputOptions& options, const hands::WheelSettings& settings, const std::string& name, std::filesystem::path& file) {
  const std::string& guid = settings.devices[settings.AxisOf(hands::WheelAxis::kSteering)->device].guid;
  file = options.out.value_or(hands::WheelFileOf(guid));
  std::error_code problem;
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), problem);
  return base::WriteWhole(file, hands::WheelText(settings, name));
}

}  // namespace

int SetUpInput(const InputOptions& options, const std::function<void(const std::string&)>& say, const std::function<bool()>& wait) {
  auto joysticks = nodes::Joysticks::Start();
  if (!joysticks) return Refuse(joysticks.error());
  joysticks.value()->Update();
  const auto connected = joysticks.value()->Connected();
  if (connected.empty()) return Refuse(base::WrongInput("no wheel is connected, or none that you may read (`rodeira doctor` says which)"));
  std::vector<std::string> guids;
  std::vector<hands::DeviceUse> devices;
  for (const nodes::JoystickInfo& info : connected) {
    guids.push_back(info.guid);
    devices.push_back({fmt::format("device{}", devices.size() + 1), info.guid, ""});
    say(fmt::format("{}: {} axes, {} buttons", info.name, info.axes, info.buttons));
  }
  joysticks.value()->Use(guids);
  hands::WheelSetup setup(devices, options.lock_deg * std::numbers::pi / 180.0);
  std::string said_prompt, said_remark;
  double waited_s = 0.0;
  std::vector<hands::DeviceReading> readings(guids.size());
  for (int number = 0; setup.stage() != hands::WheelSetup::Stage::kDone;) {
    if (setup.remark() != said_remark && !setup.remark().empty()) say(setup.remark());
    said_remark = setup.remark();
    if (setup.Prompt() != said_prompt) {
      said_prompt = setup.Prompt();
      say(fmt::format("{}. {}", ++number, said_prompt));
      waited_s = 0.0;
    }
    if (!wait()) return Refuse(base::Failed("the setup was broken off; nothing was written"));
    waited_s += kTick_s;
    if (waited_s > kPatience_s) return Refuse(base::Failed(fmt::format("for {:.0f} s nothing that was asked for has happened; nothing was written", kPatience_s)));
    joysticks.value()->Update();
    for (std::size_t place = 0; place < readings.size(); ++place) readings[place] = joysticks.value()->reading(place);
    setup.Step(readings, kTick_s);
  }
  const hands::WheelSettings settings = setup.settings();
  std::filesystem::path file;
  const std::string& steers = settings.devices[settings.AxisOf(hands::WheelAxis::kSteering)->device].guid;
  const auto wheel = std::find(guids.begin(), guids.end(), steers);
  const std::string& name = connected[static_cast<std::size_t>(wheel - guids.begin())].name;
  if (const auto written = Write(options, settings, name, file); !written) return Refuse(written.error());
  say(fmt::format("written: {}", file.string()));
  say(options.out ? fmt::format("drive with it: rodeira run launch/wheel.yaml --set nodes.driver.config.wheel={}", file.string())
                  : "drive with it: rodeira run launch/wheel.yaml --set nodes.driver.config.wheel=~");
  return 0;
}

int SetUpInput(const InputOptions& options) {
  CatchInterrupts();
  const auto say = [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  return SetUpInput(options, say, [] {
    std::this_thread::sleep_for(std::chrono::duration<double>(kTick_s));
    return !Interrupted();
  });
}

}  // namespace rodeira::front
