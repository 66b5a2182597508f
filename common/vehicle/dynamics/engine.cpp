// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/engine.hpp"

#include <algorithm>
#include <cmath>

namespace rodeira::dynamics {
namespace {

constexpr double kIdleGain_Nmspr = 0.6;
constexpr double kIdleMost_Nm = 40.0;        // what idle control may add above the drag
constexpr double kStarterEnds_radps = 60.0;  // the pinion leaves the ring

// The throttle that holds the idling speed: covers the drag there and pulls in proportion to what is missing.
double IdleThrottle(const EngineSettings& engine, double speed_radps, double available_Nm) {
  const double missing = kIdleGain_Nmspr * (engine.idle_radps - speed_radps);
  const double wanted = DragTorque(engine, speed_radps) + std::min(missing, kIdleMost_Nm);
  return available_Nm > 0.0 ? std::clamp(wanted / available_Nm, 0.0, 1.0) : 0.0;
}

// Hermite's cubic.
double HermiteTorque(const TorqueSample& a, double slope_a, const TorqueSample& b, double slope_b, double speed_radps) {
  const double width = b.speed_radps - a.speed_radps, u = (speed_radps - a.speed_radps) / width, v = 1.0 - u;
  return v * v * ((1.0 + 2.0 * u) * a.torque_Nm + u * width * slope_a) +
         u * u * ((1.0 + 2.0 * v) * b.torque_Nm - v * width * slope_b);
}

}  // namespace

std::vector<double> SmoothSlopes(const std::vector<TorqueSample>& samples) {
  const std::size_t n = samples.size();
  std::vector<double> slopes(n, 0.0);
  if (n < 2) return slopes;
  std::vector<double> chords;
  for (std::size_t i = 1; i < n; ++i)
    chords.push_back((samples[i].torque_Nm - samples[i - 1].torque_Nm) /
                     (samples[i].speed_radps - samples[i - 1].speed_radps));
  slopes.front() = chords.front();
  slopes.back() = chords.back();
  for (std::size_t i = 1; i + 1 < n; ++i)
    slopes[i] = chords[i - 1] * chords[i] > 0.0 ? 0.5 * (chords[i - 1] + chords[i]) : 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (chords[i] == 0.0) {
      slopes[i] = slopes[i + 1] = 0.0;
      continue;
    }
    const double a = slopes[i] / chords[i], b = slopes[i + 1] / chords[i], size = std::hypot(a, b);
    if (size <= 3.0) continue;
    slopes[i] = 3.0 * a / size * chords[i];
    slopes[i + 1] = 3.0 * b / size * chords[i];
  }
  return slopes;
}

double FullLoadTorque(const EngineSettings& engine, double speed_radps) {
  const auto& curve = engine.full_load;
  if (curve.empty() || speed_radps <= 0.0) return 0.0;
  if (speed_radps <= curve.front().speed_radps)
    return curve.front().torque_Nm * speed_radps / curve.front().speed_radps;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (speed_radps > curve[i].speed_radps) continue;
    const TorqueSample& a = curve[i - 1];
    const TorqueSample& b = curve[i];
    if (!engine.full_load_Nmspr.empty())
      return HermiteTorque(a, engine.full_load_Nmspr[i - 1], b, engine.full_load_Nmspr[i], speed_radps);
    return a.torque_Nm + (b.torque_Nm - a.torque_Nm) * (speed_radps - a.speed_radps) / (b.speed_radps - a.speed_radps);
  }
  return curve.back().torque_Nm;
}

double DragTorque(const EngineSettings& engine, double speed_radps) {
  return engine.drag_Nm + engine.drag_Nmspr * std::fabs(speed_radps);
}

void Engine::Start(double speed_radps) {
  *this = Engine();
  speed_radps_ = speed_radps;
  running_ = true;
}

void Engine::Hold(const EngineSettings& engine, double torque_Nm) {
  drag_Nm_ = DragTorque(engine, speed_radps_);
  const double available = FullLoadTorque(engine, speed_radps_) + drag_Nm_;
  throttle_ = available > 0.0 ? std::clamp((torque_Nm + drag_Nm_) / available, 0.0, 1.0) : 0.0;
  indicated_Nm_ = throttle_ * available;
}

void Engine::Prepare(const EngineSettings& engine, double throttle, bool starter) {
  if (running_ && speed_radps_ < engine.stall_radps && !starter) running_ = false;
  if (!running_ && starter && speed_radps_ >= engine.stall_radps) running_ = true;
  if (speed_radps_ >= engine.cut_radps) limited_ = true;
  if (speed_radps_ <= engine.resume_radps) limited_ = false;

  drag_Nm_ = DragTorque(engine, speed_radps_);
  starter_Nm_ = starter && speed_radps_ < kStarterEnds_radps ? engine.starter_Nm : 0.0;
  throttle_ = 0.0;
  indicated_Nm_ = 0.0;
  if (!running_ || limited_) return;
  const double available = FullLoadTorque(engine, speed_radps_) + drag_Nm_;
  const double idle = IdleThrottle(engine, speed_radps_, available);
  throttle_ = idle + (1.0 - idle) * throttle;
  indicated_Nm_ = throttle_ * available;
}

void Engine::Finish(const EngineSettings& engine, double speed_radps, double dt_s) {
  const double mean = 0.5 * (speed_radps_ + speed_radps);
  fuel_rate_kgps_ = engine.throttle_fuel_kgps > 0.0 ? throttle_ * engine.throttle_fuel_kgps
                                                    : std::max(0.0, indicated_Nm_ * mean) /
                                                          (engine.indicated_efficiency * engine.heating_value_Jpkg);
  fuel_kg_ += fuel_rate_kgps_ * dt_s;
  speed_radps_ = speed_radps;
}

void Engine::Save(base::StateWriter& writer) const {
  writer.Put("speed_radps", speed_radps_);
  writer.Put("running", running_);
  writer.Put("limited", limited_);
  writer.Put("throttle", throttle_);
  writer.Put("indicated_Nm", indicated_Nm_);
  writer.Put("starter_Nm", starter_Nm_);
  writer.Put("drag_Nm", drag_Nm_);
  writer.Put("fuel_rate_kgps", fuel_rate_kgps_);
  writer.Put("fuel_kg", fuel_kg_);
}

void Engine::Restore(base::StateReader& reader) {
  reader.Get("speed_radps", speed_radps_);
  reader.Get("running", running_);
  reader.Get("limited", limited_);
  reader.Get("throttle", throttle_);
  reader.Get("indicated_Nm", indicated_Nm_);
  reader.Get("starter_Nm", starter_Nm_);
  reader.Get("drag_Nm", drag_Nm_);
  reader.Get("fuel_rate_kgps", fuel_rate_kgps_);
  reader.Get("fuel_kg", fuel_kg_);
}

}  // namespace rodeira::dynamics
