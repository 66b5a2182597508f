// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/automatic_gearbox.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

constexpr double kMaxSelectorSpeed_mps = 1.5;  // above it the gearbox does not change between D and R
constexpr double kMatched_radps = 10.0;        // near enough to the new gear's speed
constexpr double kMatchGain = 0.02;            // throttle a rad/s that the engine is too slow
constexpr double kLoadSmoothing_s = 0.4;
constexpr double kTouched = 0.05;      // less throttle than this is coasting
constexpr double kAnotherPedal = 0.1;  // a pedal that is held differs by less
constexpr double kKeeps = 0.9;         // of the load: a gear that gives as much nearly keeps the speed
constexpr double kSlowed = 0.9;        // by a change of gear on a steep slope
constexpr double kDeadPedal = 0.02;
// Torque of the clutch below the bite, of the engine's full load there: by the pedal, at most, and none towards a
// stall.
constexpr double kCreepShare = 2.0, kMaxCreep = 0.35;

double CreepTorque(const AutomaticSettings& settings, const EngineSettings& engine, double throttle,
                   double engine_radps) {
  if (throttle <= kDeadPedal) return 0.0;
  const double low = 1.3 * engine.stall_radps;
  const double turns = std::clamp((engine_radps - low) / std::max(engine.idle_radps - low, 1.0), 0.0, 1.0);
  return turns * std::min(kCreepShare * throttle, kMaxCreep) * FullLoadTorque(engine, settings.bite_radps);
}

double Interpolate(double light, double full, double throttle) { return light + (full - light) * throttle; }

// Torque at the wheels in this gear with this pedal.
double WheelTorque(const GearboxSettings& gearbox, const EngineSettings& engine, int gear, double wheel_radps,
                   double throttle) {
  const double ratio = TotalRatio(gearbox, gear);
  const double drag = DragTorque(engine, ratio * wheel_radps);
  return gearbox.efficiency * ratio * (throttle * (FullLoadTorque(engine, ratio * wheel_radps) + drag) - drag);
}

}  // namespace

void AutomaticGearbox::Adopt(int gear) {
  *this = AutomaticGearbox();
  gear_ = gear;
  target_ = gear;
}

void AutomaticGearbox::Start(const AutomaticSettings& settings, const GearboxSettings& gearbox, double wheel_radps) {
  int gear = 1;
  if (wheel_radps < 0.0) gear = -1;
  const int top = static_cast<int>(gearbox.forward.size());
  while (gear > 0 && gear < top &&
         TotalRatio(gearbox, gear + 1) * wheel_radps > 0.5 * (settings.down_light_radps + settings.up_light_radps))
    ++gear;
  Adopt(gear);
}

bool AutomaticGearbox::MayShiftUp(const AutomaticSettings& settings, const GearboxSettings& gearbox,
                                  const EngineSettings& engine, const AutomaticInput& input) const {
  const int next = gear_ + 1;
  const double load = load_Nm_ * settings.margin;
  const double most = WheelTorque(gearbox, engine, next, input.wheel_radps, 1.0);
  const double least = WheelTorque(gearbox, engine, next, input.wheel_radps, 0.0);
  if (load > most) return false;
  if (input.throttle > kTouched &&
      WheelTorque(gearbox, engine, gear_, input.wheel_radps, input.throttle) > kKeeps * load_Nm_ &&
      WheelTorque(gearbox, engine, next, kSlowed * input.wheel_radps, input.throttle) < load_Nm_)
    return false;
  if (next == weak_gear_ && load > WheelTorque(gearbox, engine, next, input.wheel_radps, input.throttle)) return false;
  const double pedal = std::clamp((load - least) / (most - least), pedal_, 1.0);
  const double leave = Interpolate(settings.down_light_radps, settings.down_full_radps, pedal);
  return TotalRatio(gearbox, next) * input.wheel_radps > leave * settings.margin;
}

int AutomaticGearbox::WantedForward(const AutomaticSettings& settings, const GearboxSettings& gearbox,
                                    const EngineSettings& engine, const AutomaticInput& input) const {
  const int top = static_cast<int>(gearbox.forward.size());
  const double up = Interpolate(settings.up_light_radps, settings.up_full_radps, pedal_);
  const double down =
      Interpolate(settings.down_light_radps, settings.down_full_radps, std::min(pedal_, input.throttle));
  const auto speed_in = [&](int gear) { return TotalRatio(gearbox, gear) * input.wheel_radps; };
  const bool pausing = driven_s_ < settings.pause_s;

  if (gear_ < top && speed_in(gear_) > up && (!pausing || speed_in(gear_) > engine.resume_radps)) {
    return MayShiftUp(settings, gearbox, engine, input) ? gear_ + 1 : gear_;
  }
  if (gear_ > 1 && speed_in(gear_) < down && (!pausing || speed_in(gear_) < settings.bite_radps)) {
    // The highest gear that the law keeps; first gear is always good.
    for (int gear = gear_ - 1; gear >= 1; --gear) {
      if (speed_in(gear) * settings.margin > up) break;
      if (speed_in(gear) > down || gear == 1) return gear;
    }
  }
  return gear_;
}

int AutomaticGearbox::Wanted(const AutomaticSettings& settings, const GearboxSettings& gearbox,
                             const EngineSettings& engine, const AutomaticInput& input) const {
  if (input.selector == 0) return 0;
  if (input.selector < 0) return input.speed_mps > kMaxSelectorSpeed_mps ? 0 : -1;
  if (gear_ >= 1) return WantedForward(settings, gearbox, engine, input);
  if (input.speed_mps < -kMaxSelectorSpeed_mps) return 0;
  AutomaticGearbox fresh;
  fresh.Start(settings, gearbox, std::max(0.0, input.wheel_radps));
  return fresh.gear_;
}

void AutomaticGearbox::Advance(const AutomaticSettings& settings, const GearboxSettings& gearbox,
                               const AutomaticInput& input, double dt_s) {
  phase_s_ += dt_s;
  driven_s_ += dt_s;
  const auto enter = [&](Phase phase) {
    phase_ = phase;
    phase_s_ = 0.0;
  };
  if (phase_ == Phase::kOpen && phase_s_ >= settings.open_s) {
    gear_ = target_;
    enter(Phase::kSwap);
  } else if (phase_ == Phase::kSwap) {
    const double gap = TotalRatio(gearbox, gear_) * input.wheel_radps - input.engine_radps;
    if (std::fabs(gap) < kMatched_radps || phase_s_ >= settings.swap_s) enter(Phase::kClose);
  } else if (phase_ == Phase::kClose && phase_s_ >= settings.close_s) {
    enter(Phase::kDrive);
    driven_s_ = 0.0;
  }
}

double AutomaticGearbox::ThrottleFor(const AutomaticSettings& settings, const GearboxSettings& gearbox,
                                     const AutomaticInput& input) const {
  switch (phase_) {
    case Phase::kDrive:
      return input.throttle;
    case Phase::kOpen:
      return input.throttle * std::max(0.0, 1.0 - 2.0 * phase_s_ / settings.open_s);
    case Phase::kSwap: {
      const double gap = TotalRatio(gearbox, gear_) * input.wheel_radps - input.engine_radps;
      return gear_ == 0 ? input.throttle : std::clamp(kMatchGain * gap, 0.0, 1.0);
    }
    case Phase::kClose:
      return input.throttle * std::min(1.0, phase_s_ / settings.close_s);
  }
  return 0.0;
}

AutomaticOutput AutomaticGearbox::Step(const AutomaticSettings& settings, const GearboxSettings& gearbox,
                                       const EngineSettings& engine, const AutomaticInput& input, double dt_s) {
  Advance(settings, gearbox, input, dt_s);
  const double smoothing = input.throttle > pedal_ ? settings.press_s : settings.release_s;
  pedal_ += (input.throttle - pedal_) * dt_s / (smoothing + dt_s);
  if (std::fabs(input.throttle - weak_throttle_) > kAnotherPedal) weak_gear_ = 0;
  if (phase_ == Phase::kDrive) load_Nm_ += (input.load_Nm - load_Nm_) * dt_s / (kLoadSmoothing_s + dt_s);
  if (phase_ == Phase::kDrive || phase_ == Phase::kClose) {
    const int wanted = Wanted(settings, gearbox, engine, input);
    // Neutral and reverse are the driver's wish and come at once; other changes wait for the one under way.
    if (wanted != gear_ && (phase_ == Phase::kDrive || wanted <= 0 || gear_ <= 0)) {
      const bool weak = wanted > 0 && wanted < gear_ && input.throttle > kTouched && load_Nm_ > 0.0;
      weak_gear_ = weak ? gear_ : 0;
      weak_throttle_ = input.throttle;
      target_ = wanted;
      phase_ = Phase::kOpen;
      phase_s_ = 0.0;
    }
  }
  AutomaticOutput output;
  output.gear = gear_;
  output.throttle = ThrottleFor(settings, gearbox, input);
  // The clutch of the launch closes with the faster of its two sides; that of a change follows its ramp.
  const double input_radps = TotalRatio(gearbox, gear_) * input.wheel_radps;
  const double faster = std::max(input.engine_radps, input_radps);
  const double bitten =
      std::clamp((faster - settings.bite_radps) / (settings.closed_radps - settings.bite_radps), 0.0, 1.0);
  const double creep = CreepTorque(settings, engine, input.throttle, input.engine_radps) / input.clutch_capacity_Nm;
  const double launch = 1.0 - std::min(1.0, std::max(bitten, creep));
  double ramp = 0.0;
  if (phase_ == Phase::kOpen) ramp = phase_s_ / settings.open_s;
  if (phase_ == Phase::kSwap) ramp = 1.0;
  if (phase_ == Phase::kClose) ramp = 1.0 - phase_s_ / settings.close_s;
  output.clutch = gear_ == 0 ? 1.0 : std::clamp(std::max(launch, ramp), 0.0, 1.0);
  return output;
}

void AutomaticGearbox::Save(base::StateWriter& writer) const {
  writer.Put("gear", gear_);
  writer.Put("target", target_);
  writer.Put("phase", phase_);
  writer.Put("phase_s", phase_s_);
  writer.Put("driven_s", driven_s_);
  writer.Put("load_Nm", load_Nm_);
  writer.Put("pedal", pedal_);
  writer.Put("weak_gear", weak_gear_);
  writer.Put("weak_throttle", weak_throttle_);
}

void AutomaticGearbox::Restore(base::StateReader& reader) {
  reader.Get("gear", gear_);
  reader.Get("target", target_);
  reader.Get("phase", phase_);
  reader.Get("phase_s", phase_s_);
  reader.Get("driven_s", driven_s_);
  reader.Get("load_Nm", load_Nm_);
  reader.Get("pedal", pedal_);
  reader.Get("weak_gear", weak_gear_);
  reader.Get("weak_throttle", weak_throttle_);
}

}  // namespace rodeira::dynamics
