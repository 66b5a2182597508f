// SPDX-License-Identifier: Apache-2.0
#include "nodes/input/pad_source.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

#include "common/core/base/log.hpp"
#include "common/vehicle/input_devices/joysticks.hpp"
#include "nodes/input/car_seen.hpp"

namespace rodeira::nodes {
namespace {

class PadSource final : public Source {
 public:
  PadSource(std::string node, std::unique_ptr<input_devices::GamePad> pad)
      : node_(std::move(node)), pad_(std::move(pad)) {}

  dynamics::Controls First() override { return driver_.controls(); }

  base::Result<dynamics::Controls> Step(const lockstep::StepInfo& step, std::int64_t,
                                        const lockstep::Inbox& inbox) override {
    const auto car = SeeCar(inbox);
    if (!car) return car.error();
    pad_->Update();
    Tell(pad_->reading().connected);
    return driver_.Step(pad_->reading(), car.value().gear, car.value().speed_mps, step.dt_s);
  }

  input_devices::Signals signals() const override { return driver_.signals(); }
  bool runs_inline() const override { return false; }  // SDL must be called by one thread
  void Save(base::StateWriter& out) const override { out.Put("pad", driver_); }
  void Restore(base::StateReader& in) override { in.Get("pad", driver_); }
  void InitialiseFrom(const dynamics::Controls& last, const input_devices::Signals& signals) override {
    driver_.InitialiseFrom(last, signals);
  }

 private:
  // To the person, once for each time.
  void Tell(bool there) {
    if (there_ == there) return;
    there_ = there;
    base::Log(there ? base::LogLevel::kInfo : base::LogLevel::kWarning, node_,
              fmt::format("game pad '{}' {}", pad_->name(),
                          there ? "is there" : "was unplugged: pedals released, steering held"));
  }

  std::string node_;
  input_devices::PadDriver driver_;
  std::unique_ptr<input_devices::GamePad> pad_;
  bool there_ = true;
};

}  // namespace

std::unique_ptr<Source> MakePadSource(const std::string& node, std::unique_ptr<input_devices::GamePad> pad) {
  return std::make_unique<PadSource>(node, std::move(pad));
}

base::Result<std::unique_ptr<Source>> MakePadSource(const config::Map& config, launch::NodeContext& context) {
  if (auto status = context.launch().file().Finish(); !status) return status.error();
  auto pad = input_devices::GamePad::Start();
  if (!pad) return pad.error();
  if (pad.value()->reading().connected) return MakePadSource(context.spec().name, std::move(pad).value());
  auto joysticks = input_devices::Joysticks::Start();
  if (!joysticks) return joysticks.error();
  joysticks.value()->Update();
  return base::WrongInput(
      "device.not_found",
      fmt::format("no game pad is there; {}", input_devices::ListJoysticks(joysticks.value()->Connected())),
      config.Place());
}

}  // namespace rodeira::nodes
