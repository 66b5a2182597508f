// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/commands/input_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "common/core/base/print_error.hpp"
#include "common/vehicle/input_devices/device_access.hpp"
#include "launch/rodeira/commands/wheel_wizard.hpp"
#include "launch/rodeira/graphics/graphics.hpp"
#include "launch/rodeira/interrupt.hpp"

namespace rodeira::cli {
namespace {

constexpr double kTick_s = 0.01;

}  // namespace

int SetUpInput(const InputOptions& options, const std::function<void(const std::string&)>& say,
               const std::function<bool()>& wait) {
  auto begun = WheelWizard::Begin();
  if (!begun) return base::PrintError("rodeira", begun.error());
  WheelWizard& wizard = *begun.value();
  for (const input_devices::JoystickInfo& info : wizard.devices())
    say(fmt::format("{}: {} axes, {} buttons", info.name, info.axes, info.buttons));
  std::string said_prompt, said_remark;
  while (!wizard.done()) {
    if (wizard.remark() != said_remark && !wizard.remark().empty()) say(wizard.remark());
    said_remark = wizard.remark();
    if (wizard.prompt() != said_prompt) {
      said_prompt = wizard.prompt();
      say(fmt::format("{}. {}", wizard.number(), said_prompt));
    }
    if (!wait())
      return base::PrintError("rodeira", base::Failed("run.interrupted", "setup cancelled; nothing was written"));
    if (const auto went = wizard.Step(kTick_s); !went) return base::PrintError("rodeira", went.error());
  }
  const auto file = wizard.Write(options.out, options.lock_deg);
  if (!file) return base::PrintError("rodeira", file.error());
  say(fmt::format("written: {}", file.value().string()));
  say(options.out ? fmt::format("drive with it: rodeira run launch/wheel.yaml --set nodes.driver.config.wheel={}",
                                file.value().string())
                  : "drive with it: rodeira run launch/wheel.yaml");
  return 0;
}

int SetUpInput(const InputOptions& options) {
  if (!input_devices::HasDeviceAccess()) return ContinueInGraphics("input setup");
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

}  // namespace rodeira::cli
