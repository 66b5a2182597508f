// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/force_device.hpp"

#include <utility>

namespace rodeira::input_devices {

void ForceDriver::Tell(const ForceMoment& moment, double now_s) {
  if (device_ == nullptr || (now_s >= told_s_ && now_s - told_s_ < kAgain_s)) return;
  told_s_ = now_s;
  if (!device_->Push(law_.Step(moment, now_s), kFor_s)) Change(nullptr);
}

void ForceDriver::Change(std::unique_ptr<ForceDevice> device) {
  device_ = std::move(device);
  law_.Forget();
}

}  // namespace rodeira::input_devices
