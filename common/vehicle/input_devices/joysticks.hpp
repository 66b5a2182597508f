// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/vehicle/input_devices/force_device.hpp"
#include "common/vehicle/input_devices/wheel_driver.hpp"

namespace rodeira::input_devices {

// A device that is plugged in.
struct JoystickInfo {
  std::string name;
  std::string guid;
  int axes = 0;
  int buttons = 0;
  bool is_wheel = false;  // known as a steering wheel; many are not known
};

// "'G29' 030000…, 'Pedals' 0300…", or "no device is connected".
std::string ListJoysticks(const std::vector<JoystickInfo>& connected);

// Joysticks and steering wheels of this PC, raw. No function waits. One thread.
class Joysticks {
 public:
  // By the program's device access (device_access.hpp). Wrong input where the program has none, or where it cannot look
  // at devices at all.
  static base::Result<std::unique_ptr<Joysticks>> Start();
  virtual ~Joysticks() = default;

  // Reads all devices, and finds those that were plugged in or out.
  virtual void Update() = 0;
  // The devices that were there at the last Update.
  virtual std::vector<JoystickInfo> Connected() const = 0;

  // Devices to read, by GUID; their readings come in this order. Two of one GUID are taken as they come.
  virtual void Use(const std::vector<std::string>& guids) = 0;
  // The reading of a place in that list, as of the last Update; empty where the device is not there. The reference
  // holds until the next Update or Use.
  virtual const DeviceReading& reading(std::size_t place) const = 0;
  // As the device calls itself, once it was there.
  virtual const std::string& name(std::size_t place) const = 0;
  // A number that differs each time the device is plugged in; 0 where it is not there. It changes in Update.
  virtual std::uint64_t connection(std::size_t place) const = 0;
  // The motor of a device that is there; null where it has none. `inverted`: for devices with a driver that turns the
  // direction round. It must not outlive these joysticks.
  virtual std::unique_ptr<ForceDevice> OpenMotor(std::size_t place, bool inverted) = 0;
};

}  // namespace rodeira::input_devices
