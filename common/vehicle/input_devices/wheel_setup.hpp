// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/vehicle/input_devices/wheel_driver.hpp"

namespace rodeira::input_devices {

// Finds out what turns, what is pressed and where its ends are, by asking for one movement after the other. A movement
// counts when everything has stood still for half a second after it; no key is needed. What a device says before it
// first moves is not believed. A pedal that is held down is waited for: released is where it comes back to.
class WheelSetup {
 public:
  enum class Stage { kSteering, kThrottle, kBrake, kClutch, kGears, kWindow, kDone };

  // All devices that are plugged in; `lock_rad`: of the car's steering wheel where the axis is at its end.
  WheelSetup(std::vector<DeviceUse> devices, double lock_rad);

  // What the person is asked to do now; empty when done.
  std::string Prompt() const;
  // Why the last movement did not do; empty otherwise.
  const std::string& remark() const { return remark_; }
  Stage stage() const { return stage_; }
  // The readings of all devices in their order, dt_s after those before.
  void Step(std::span<const DeviceReading> devices, double dt_s);
  // Once done: only the devices that are used.
  WheelSettings settings() const;

 private:
  struct Track {  // of an axis, during a stage
    std::size_t device = 0, axis = 0;
    double low = 0.0, high = 0.0, now = 0.0;
    double first = 0.0;  // +1 or -1: where it first went far; 0: nowhere yet
    double begin = 0.0;
    // It goes to and fro in legs: where this one began and how far it has come, and the longest one before it of each
    // direction.
    double leg_from = 0.0, leg_to = 0.0, longest_up = 0.0, longest_down = 0.0;

    double way() const { return high - low; }
    void Go();                   // by `now`
    bool has_come_back() const;  // over most of its way, after it went there
  };
  void Begin(Stage stage);
  bool Still(std::span<const DeviceReading> devices, double dt_s);
  void Follow(std::span<const DeviceReading> devices);
  const Track* Widest() const;
  void TakeSteering(const Track& track);
  void TakeThrottle(const Track& track);
  void TakeBrake(const Track& track);
  void TakeClutch(const Track& track);
  void TakeButtons(std::span<const DeviceReading> devices);
  void TakeButton(const ButtonUse& pressed);
  // The first of a stage's two buttons, or the second one, behind which the next stage begins.
  void TakePair(const ButtonUse& pressed, WheelButton first, WheelButton second, Stage next);
  bool Is(const ButtonUse& pressed, WheelButton button) const;
  void Refuse(std::string remark);
  // Whether a pedal that is still at an end of its way was pressed and released; a remark where it is only held.
  bool IsReleased(const Track& track, const char* pedal);
  bool IsTaken(const Track& track, WheelAxis axis) const;

  WheelSettings settings_;
  Stage stage_ = Stage::kSteering;
  std::string remark_;
  bool fresh_ = true;  // the stage has not seen a reading yet
  std::vector<Track> tracks_;
  std::vector<std::vector<double>> reference_;  // since when it is still: by device and axis
  double still_s_ = 0.0;
  std::vector<std::vector<bool>> down_;  // buttons, by device
};

// The settings as a wheel file, which LoadWheel reads as the same.
std::string WheelText(const WheelSettings& settings, const std::string& name);

// Where files made by setting up lie: $XDG_CONFIG_HOME/rodeira/wheels, else ~/.config/rodeira/wheels; named by the
// steering device's GUID.
std::filesystem::path WheelFolder();
// The file's path; it need not exist.
std::filesystem::path WheelFileOf(const std::string& guid);

}  // namespace rodeira::input_devices
