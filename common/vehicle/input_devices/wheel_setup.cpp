// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/wheel_setup.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/base/assert.hpp"

namespace rodeira::input_devices {
namespace {

constexpr double kWhole = 65535.0;         // an axis' whole range
constexpr double kFar = 0.20 * kWhole;     // from where it stood: a movement with a direction
constexpr double kEnough = 0.25 * kWhole;  // of a way: less is an accident
constexpr double kNoise = 0.01 * kWhole;
constexpr double kBack = 0.15;           // share of its way: back at an end, or (from half of it) in the middle
constexpr double kTurn = 0.05 * kWhole;  // back from a leg's end: the next leg
constexpr double kMost = 0.75;           // share of its way: there and back
constexpr double kMargin = 0.02;         // of a pedal's way: the floor is reached before its very end
constexpr double kDeadZone = 0.02;
constexpr double kStill_s = 0.5;

AxisUse PedalUse(std::size_t device, std::size_t axis, double released, double pressed) {
  AxisUse use;
  use.device = device;
  use.axis = axis;
  const double floor = pressed - kMargin * (pressed - released);
  use.min = std::min(released, floor);
  use.max = std::max(released, floor);
  use.inverted = pressed < released;
  use.dead_zone = kDeadZone;
  return use;
}

// A pedal's released end is where it stands still after it was pressed; nothing where that is no end.
std::optional<std::pair<double, double>> ReleasedAndPressed(double low, double high, double now) {
  const double share = (now - low) / (high - low);
  if (share <= kBack) return std::pair(now, high);
  if (share >= 1.0 - kBack) return std::pair(now, low);
  return std::nullopt;
}

}  // namespace

void WheelSetup::Track::Go() {
  const double leg = leg_to - leg_from;
  if (std::fabs(leg) <= kTurn || (now - leg_to) * leg > 0.0) {
    leg_to = now;
  } else if (std::fabs(now - leg_to) > kTurn) {
    double& longest = leg > 0.0 ? longest_up : longest_down;
    longest = std::max(longest, std::fabs(leg));
    leg_from = leg_to;
    leg_to = now;
  }
}

bool WheelSetup::Track::has_come_back() const {
  const double leg = leg_to - leg_from;
  return std::fabs(leg) >= kMost * way() && (leg > 0.0 ? longest_down : longest_up) >= kMost * way();
}

WheelSetup::WheelSetup(std::vector<DeviceUse> devices, double lock_rad) {
  settings_.devices = std::move(devices);
  settings_.lock_rad = lock_rad;
}

std::string WheelSetup::Prompt() const {
  switch (stage_) {
    case Stage::kSteering:
      return "Turn the steering wheel to the left as far as it goes, then to the right, then back to the middle, and "
             "let go.";
    case Stage::kThrottle:
      return "Press the throttle to the floor and release it.";
    case Stage::kBrake:
      return "Press the brake to the floor and release it.";
    case Stage::kClutch:
      return "Press the clutch to the floor and release it. There is none? Press any button.";
    case Stage::kGears:
      return "Press the button for a higher gear, then the one for a lower gear. There are none? Press the throttle "
             "and release it.";
    case Stage::kWindow:
      return "Press the button for another camera, then the one that pauses the run and lets it go on. There are none? "
             "Press the throttle and release it.";
    case Stage::kDone:
      break;
  }
  return "";
}

void WheelSetup::Begin(Stage stage) {
  stage_ = stage;
  remark_.clear();
  fresh_ = true;
}

void WheelSetup::Refuse(std::string remark) {
  Begin(stage_);
  remark_ = std::move(remark);
}

// Whether nothing has moved for long enough.
bool WheelSetup::Still(std::span<const DeviceReading> devices, double dt_s) {
  reference_.resize(devices.size());
  bool moved = false;
  for (std::size_t d = 0; d < devices.size(); ++d) {
    const auto& axes = devices[d].axes;
    if (reference_[d].size() != axes.size()) reference_[d] = axes, moved = true;
    for (std::size_t a = 0; a < axes.size(); ++a) {
      if (std::fabs(axes[a] - reference_[d][a]) <= kNoise) continue;
      reference_[d][a] = axes[a];
      moved = true;
    }
  }
  still_s_ = moved ? 0.0 : still_s_ + dt_s;
  return still_s_ >= kStill_s;
}

void WheelSetup::Follow(std::span<const DeviceReading> devices) {
  if (fresh_) {
    tracks_.clear();
    for (std::size_t d = 0; d < devices.size(); ++d) {
      for (std::size_t a = 0; a < devices[d].axes.size(); ++a) {
        const double now = devices[d].axes[a];
        tracks_.push_back({d, a, now, now, now, 0.0, now, now, now});
      }
    }
    fresh_ = false;
    still_s_ = 0.0;
    return;
  }
  for (Track& track : tracks_) {
    if (track.axis >= devices[track.device].axes.size()) continue;  // unplugged: as it was
    track.now = devices[track.device].axes[track.axis];
    track.low = std::min(track.low, track.now);
    track.high = std::max(track.high, track.now);
    track.Go();
    if (track.first == 0.0 && std::fabs(track.now - track.begin) > kFar)
      track.first = track.now > track.begin ? 1.0 : -1.0;
  }
}

// The axis that moved most; null where none moved enough.
const WheelSetup::Track* WheelSetup::Widest() const {
  const auto widest = std::max_element(tracks_.begin(), tracks_.end(),
                                       [](const Track& a, const Track& b) { return a.way() < b.way(); });
  return widest == tracks_.end() || widest->way() < kEnough ? nullptr : &*widest;
}

bool WheelSetup::IsReleased(const Track& track, const char* pedal) {
  if (track.has_come_back()) return true;
  remark_ = std::string("The ") + pedal + " has not come back yet: release it, or press it once more.";
  return false;
}

bool WheelSetup::IsTaken(const Track& track, WheelAxis axis) const {
  const auto& use = settings_.AxisOf(axis);
  return use && use->device == track.device && use->axis == track.axis;
}

void WheelSetup::TakeSteering(const Track& track) {
  const double middle = (track.now - track.low) / track.way();
  if (middle < 0.5 - kBack || middle > 0.5 + kBack)
    return Refuse("The wheel was not turned to both sides and back; once more.");
  AxisUse use;
  use.device = track.device;
  use.axis = track.axis;
  use.min = track.low;
  use.max = track.high;
  use.centre = track.now;
  use.inverted = track.first > 0.0;  // the left came first, and a device's axis goes to the right
  settings_.axes[static_cast<std::size_t>(WheelAxis::kSteering)] = use;
  Begin(Stage::kThrottle);
}

void WheelSetup::TakeThrottle(const Track& track) {
  if (IsTaken(track, WheelAxis::kSteering))
    return Refuse("That was the steering wheel; the throttle alone was asked for.");
  const auto ends = ReleasedAndPressed(track.low, track.high, track.now);
  if (!ends) return Refuse("The throttle was not released; once more.");
  if (!IsReleased(track, "throttle")) return;
  settings_.axes[static_cast<std::size_t>(WheelAxis::kThrottle)] =
      PedalUse(track.device, track.axis, ends->first, ends->second);
  Begin(Stage::kBrake);
}

void WheelSetup::TakeBrake(const Track& track) {
  if (IsTaken(track, WheelAxis::kSteering))
    return Refuse("That was the steering wheel; the brake alone was asked for.");
  const auto ends = ReleasedAndPressed(track.low, track.high, track.now);
  if (!ends) return Refuse("The brake was not released; once more.");
  if (!IsReleased(track, "brake")) return;
  if (!IsTaken(track, WheelAxis::kThrottle)) {
    settings_.axes[static_cast<std::size_t>(WheelAxis::kBrake)] =
        PedalUse(track.device, track.axis, ends->first, ends->second);
    return Begin(Stage::kClutch);
  }
  // Both on one axis, at rest in its middle: `pedals`.
  auto& throttle = settings_.axes[static_cast<std::size_t>(WheelAxis::kThrottle)];
  const double throttle_floor = throttle->inverted ? throttle->min : throttle->max,
               brake_floor = ends->second - kMargin * (ends->second - ends->first);
  if ((throttle_floor > ends->first) == (brake_floor > ends->first))
    return Refuse("That was the throttle again; the brake was asked for.");
  AxisUse both;
  both.device = track.device;
  both.axis = track.axis;
  both.min = std::min(throttle_floor, brake_floor);
  both.max = std::max(throttle_floor, brake_floor);
  both.centre = ends->first;
  both.inverted = throttle_floor < brake_floor;
  both.dead_zone = kDeadZone;
  settings_.axes[static_cast<std::size_t>(WheelAxis::kPedals)] = both;
  throttle.reset();
  Begin(Stage::kClutch);
}

void WheelSetup::TakeClutch(const Track& track) {
  for (const WheelAxis other : {WheelAxis::kSteering, WheelAxis::kThrottle, WheelAxis::kBrake, WheelAxis::kPedals}) {
    if (IsTaken(track, other)) return Refuse("That was not the clutch, but what has its work already; once more.");
  }
  const auto ends = ReleasedAndPressed(track.low, track.high, track.now);
  if (!ends) return Refuse("The clutch was not released; once more.");
  if (!IsReleased(track, "clutch")) return;
  settings_.axes[static_cast<std::size_t>(WheelAxis::kClutch)] =
      PedalUse(track.device, track.axis, ends->first, ends->second);
  Begin(Stage::kGears);
}

// Buttons that went down since the step before.
void WheelSetup::TakeButtons(std::span<const DeviceReading> devices) {
  down_.resize(devices.size());
  for (std::size_t d = 0; d < devices.size(); ++d) {
    const auto& buttons = devices[d].buttons;
    down_[d].resize(buttons.size(), false);
    for (std::size_t b = 0; b < buttons.size(); ++b) {
      const bool now = buttons[b] != 0, pressed = now && !down_[d][b];
      down_[d][b] = now;
      if (pressed) TakeButton({d, b, ""});
    }
  }
}

void WheelSetup::TakeButton(const ButtonUse& pressed) {
  if (stage_ == Stage::kClutch) return Begin(Stage::kGears);
  if (stage_ == Stage::kGears) return TakePair(pressed, WheelButton::kGearUp, WheelButton::kGearDown, Stage::kWindow);
  if (stage_ != Stage::kWindow) return;
  if (!Is(pressed, WheelButton::kGearUp) && !Is(pressed, WheelButton::kGearDown))
    return TakePair(pressed, WheelButton::kCamera, WheelButton::kPause, Stage::kDone);
  remark_ = "That button changes gears; another one was asked for.";
}

void WheelSetup::TakePair(const ButtonUse& pressed, WheelButton first, WheelButton second, Stage next) {
  auto& one = settings_.buttons[static_cast<std::size_t>(first)];
  if (!one) {
    one = pressed;
  } else if (Is(pressed, first)) {
    remark_ = "That was the same button; another one was asked for.";
  } else {
    settings_.buttons[static_cast<std::size_t>(second)] = pressed;
    Begin(next);
  }
}

bool WheelSetup::Is(const ButtonUse& pressed, WheelButton button) const {
  const auto& use = settings_.buttons[static_cast<std::size_t>(button)];
  return use && use->device == pressed.device && use->button == pressed.button;
}

void WheelSetup::Step(std::span<const DeviceReading> devices, double dt_s) {
  RODEIRA_ASSERT(devices.size() == settings_.devices.size() && dt_s > 0.0);
  if (stage_ == Stage::kDone) return;
  Follow(devices);
  TakeButtons(devices);
  if (!Still(devices, dt_s) || fresh_ || stage_ == Stage::kDone) return;
  const Track* moved = Widest();
  if (moved == nullptr) return;
  const Track track = *moved;
  switch (stage_) {
    case Stage::kSteering:
      return TakeSteering(track);
    case Stage::kThrottle:
      return TakeThrottle(track);
    case Stage::kBrake:
      return TakeBrake(track);
    case Stage::kClutch:
      return TakeClutch(track);
    case Stage::kGears:
      settings_.buttons[static_cast<std::size_t>(WheelButton::kGearUp)].reset();  // one alone is none
      return Begin(Stage::kWindow);
    case Stage::kWindow:
      return Begin(Stage::kDone);  // with the camera's alone, if that was pressed
    case Stage::kDone:
      break;
  }
}

WheelSettings WheelSetup::settings() const {
  RODEIRA_ASSERT(stage_ == Stage::kDone);
  WheelSettings out = settings_;
  std::vector<std::size_t> place(settings_.devices.size());
  out.devices.clear();
  const auto used = [&](std::size_t device) {
    const auto is = [device](const auto& use) { return use && use->device == device; };
    return std::any_of(std::begin(settings_.axes), std::end(settings_.axes), is) ||
           std::any_of(std::begin(settings_.buttons), std::end(settings_.buttons), is);
  };
  for (std::size_t device = 0; device < settings_.devices.size(); ++device) {
    place[device] = out.devices.size();
    if (used(device)) out.devices.push_back(settings_.devices[device]);
  }
  for (auto& axis : out.axes) {
    if (axis) axis->device = place[axis->device];
  }
  for (auto& button : out.buttons) {
    if (button) button->device = place[button->device];
  }
  return out;
}

}  // namespace rodeira::input_devices
