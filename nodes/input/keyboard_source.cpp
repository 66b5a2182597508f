// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/keyboard_source.hpp"

#include <algorithm>
#include <utility>

#include "common/vehicle/input_devices/keyboard_driver.hpp"
#include "nodes/input/car_seen.hpp"

namespace rodeira::nodes {
namespace {

using input_devices::Action;

class KeyboardSource final : public Source {
 public:
  KeyboardSource(const input_devices::KeyboardSettings& settings, std::unique_ptr<launch::LiveKeysReceiver> keys)
      : settings_(settings), driver_(settings), keys_(std::move(keys)) {}

  dynamics::Controls First() override { return driver_.controls(); }

  base::Result<dynamics::Controls> Step(const lockstep::StepInfo& step, std::int64_t,
                                        const lockstep::Inbox& inbox) override {
    const auto car = SeeCar(inbox);
    if (!car) return car.error();
    const launch::KeysNow now = keys_->Take();
    input_devices::KeyboardInput input;
    for (std::size_t action = 0; action < input_devices::kActions; ++action) {
      const auto& keys = settings_.keys[action];
      input.held[action] =
          std::any_of(keys.begin(), keys.end(), [&](input_devices::Key key) { return now.Holds(key); });
    }
    input.lever.up = Presses(now, Action::kGearUp);
    input.lever.down = Presses(now, Action::kGearDown);
    input.lever.mode = Presses(now, Action::kGearboxMode);
    input.lever.engaged = car.value().gear;
    input.signals.left = Presses(now, Action::kIndicateLeft);
    input.signals.right = Presses(now, Action::kIndicateRight);
    input.signals.hazard = Presses(now, Action::kHazard);
    input.signals.headlights = Presses(now, Action::kHeadlights);
    input.signals.horn = input.held[static_cast<std::size_t>(Action::kHorn)];
    input.speed_mps = car.value().speed_mps;
    return driver_.Step(input, step.dt_s);
  }

  input_devices::Signals signals() const override { return driver_.signals(); }
  void Save(base::StateWriter& out) const override { out.Put("keyboard", driver_); }
  void Restore(base::StateReader& in) override { in.Get("keyboard", driver_); }
  void InitialiseFrom(const dynamics::Controls& last, const input_devices::Signals& signals) override {
    driver_.InitialiseFrom(last, signals);
  }

 private:
  std::uint32_t Presses(const launch::KeysNow& now, Action action) const {
    std::uint32_t presses = 0;
    for (const input_devices::Key key : settings_.KeysOf(action)) presses += now.PressesOf(key);
    return presses;
  }

  input_devices::KeyboardSettings settings_;
  input_devices::KeyboardDriver driver_;
  std::unique_ptr<launch::LiveKeysReceiver> keys_;
};

}  // namespace

base::Result<std::unique_ptr<Source>> MakeKeyboardSource(const config::Map& config, launch::NodeContext& context) {
  const std::filesystem::path file = config.Path("keyboard");
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  const auto settings = input_devices::LoadKeyboard(file);
  if (!settings) return settings.error();
  auto keys = context.KeysReceiver();
  RODEIRA_ASSERT(keys != nullptr);
  return std::unique_ptr<Source>(std::make_unique<KeyboardSource>(settings.value(), std::move(keys)));
}

}  // namespace rodeira::nodes
