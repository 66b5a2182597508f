// SPDX-License-Identifier: Apache-2.0
#include "common/view/sound/synth.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"

namespace rodeira::sound {
namespace {

constexpr double kSample_s = 1.0 / kRate_Hz;
constexpr double kSqueal_Hz = 850.0, kSquealSharpness = 12.0;
constexpr double kCrashDecay_s = 0.22;
constexpr double kIdle_rpm = 400.0;  // below it an engine is not heard

// Of a filter with one pole.
double PoleOf(double cut_Hz) { return 1.0 - std::exp(-2.0 * base::kPi * cut_Hz * kSample_s); }

double Between(double a, double b, double share) { return a + (b - a) * share; }

Voice Between(const Voice& a, const Voice& b, double share) {
  return {Between(a.engine_rpm, b.engine_rpm, share),
          Between(a.load, b.load, share),
          Between(a.speed_mps, b.speed_mps, share),
          Between(a.sliding, b.sliding, share),
          Between(a.gain, b.gain, share),
          Between(a.pan, b.pan, share),
          Between(a.horn, b.horn, share)};
}

// A membrane's note: bright, its n-th overtone falling as 1/n; `cycle` goes on by one sample.
double HornNote(double& cycle, double frequency_Hz) {
  cycle += frequency_Hz * kSample_s;
  cycle -= std::floor(cycle);
  double note = 0.0;
  for (int overtone = 1; overtone <= 8; ++overtone) note += std::sin(2.0 * base::kPi * overtone * cycle) / overtone;
  return note;
}

}  // namespace

double Synth::Noise() {
  noise_ = noise_ * 6364136223846793005ULL + 1442695040888963407ULL;  // Knuth's MMIX
  return static_cast<double>(static_cast<std::int64_t>(noise_)) * 0x1.0p-63;
}

// Engine and tyres, without pan.
double Synth::OneSample(const Voice& voice, State& state) {
  state.cycle += voice.engine_rpm / 120.0 * kSample_s;
  state.cycle -= std::floor(state.cycle);
  const double running = std::clamp(voice.engine_rpm / kIdle_rpm - 1.0, 0.0, 1.0);
  const double tone = Between(static_cast<double>(coasting_.At(state.cycle)),
                              static_cast<double>(pulling_.At(state.cycle)), voice.load);
  double out = running * (0.10 + 0.16 * voice.load + 0.10 * std::min(voice.engine_rpm / 6000.0, 1.0)) * tone;

  const double fast = std::min(std::fabs(voice.speed_mps) / 40.0, 1.5);
  static const double kRoadPole = PoleOf(320.0);
  state.road.low += kRoadPole * (Noise() - state.road.low);
  out += 1.5 * std::pow(fast, 1.3) * state.road.low;

  // A resonator (Chamberlin's state variable filter) on noise.
  static const double kTune = 2.0 * std::sin(base::kPi * kSqueal_Hz * kSample_s);
  Filtered& q = state.squeal;
  q.second += kTune * q.band;
  q.band += kTune * (Noise() - q.second - q.band / kSquealSharpness);
  out += 0.32 * voice.sliding * q.band;
  if (voice.horn > 0.0)
    out += 0.22 * voice.horn * (HornNote(state.low_horn, kLowHorn_Hz) + HornNote(state.high_horn, kHighHorn_Hz));
  return voice.gain * out;
}

void Synth::Render(const Heard& heard, std::span<float> stereo) {
  const std::size_t count = stereo.size() / 2;
  for (const auto& [id, voice] : heard.others) {
    if (others_.contains(id)) continue;
    State& state = others_[id];
    state.last = voice;
    state.last.gain = 0.0;
  }
  static const double kWindPole = PoleOf(700.0), kCrashPole = PoleOf(1400.0), kRainPole = PoleOf(2500.0),
                      kCrashFall = std::exp(-kSample_s / kCrashDecay_s);
  crash_ = std::max(crash_, heard.crash);
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(count);
    double left = 0.0, right = 0.0;
    const auto add = [&](const Voice& voice, State& state) {
      const double sample = OneSample(voice, state), angle = (voice.pan + 1.0) * 0.25 * base::kPi;
      left += sample * std::cos(angle);
      right += sample * std::sin(angle);
    };
    add(Between(own_.last, heard.own, share), own_);
    for (auto& [id, state] : others_) {
      const auto now = heard.others.find(id);
      Voice to = now == heard.others.end() ? state.last : now->second;
      if (now == heard.others.end()) to.gain = 0.0;
      add(Between(state.last, to, share), state);
    }
    const double fast = std::fabs(Between(own_.last.speed_mps, heard.own.speed_mps, share)) / 40.0;
    wind_ += kWindPole * (Noise() - wind_);
    rain_ += kRainPole * (Noise() - rain_);
    crash_low_ += kCrashPole * (Noise() - crash_low_);
    const double drops = 0.10 * Between(last_.rain, heard.rain, share) * (Noise() - rain_);
    const double everywhere =
        0.55 * std::min(fast * fast, 2.0) * wind_ * Between(own_.last.gain, heard.own.gain, share) + drops +
        2.2 * crash_ * crash_low_;
    crash_ *= kCrashFall;
    const double volume = Between(last_.volume, heard.volume, share);
    stereo[2 * i] = static_cast<float>(std::tanh(volume * (left + everywhere)));
    stereo[2 * i + 1] = static_cast<float>(std::tanh(volume * (right + everywhere)));
  }
  own_.last = heard.own;
  for (auto at = others_.begin(); at != others_.end();) {
    const auto now = heard.others.find(at->first);
    if (now == heard.others.end()) {
      at = others_.erase(at);
    } else {
      at->second.last = now->second;
      ++at;
    }
  }
  last_ = heard;
  if (crash_ < 1e-5) crash_ = 0.0;
}

}  // namespace rodeira::sound
