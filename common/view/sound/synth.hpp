// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "common/view/sound/engine_wave.hpp"

namespace rodeira::sound {

inline constexpr int kRate_Hz = 48'000;
inline constexpr double kLowHorn_Hz = 420.0, kHighHorn_Hz = 500.0;  // of a pair of electric horns

// A car as it is heard.
struct Voice {
  double engine_rpm = 0.0;  // 0: it stands still
  double load = 0.0;        // 0 … 1
  double speed_mps = 0.0;
  double sliding = 0.0;  // of its tyres: 0 they roll … 1
  double gain = 1.0;     // 1: as loud as from inside of it
  double pan = 0.0;      // -1 left … 1 right
  double horn = 0.0;     // 0 … 1: it sounds
};

// All that sounds at a moment.
struct Heard {
  Voice own;                              // its wind is heard too
  std::map<std::uint64_t, Voice> others;  // by id
  double rain = 0.0;                      // 0 … 1
  double crash = 0.0;                     // of a blow now: 0 none … 1
  double volume = 1.0;
};

// From numbers to samples. What changes between two calls changes evenly over the samples of the later one, so that
// nothing clicks; what comes fades in, what goes fades out. Where nothing changes, the samples do not depend on how
// many are asked for at once.
class Synth {
 public:
  // Left and right in turn, each in [-1, 1].
  void Render(const Heard& heard, std::span<float> stereo);

 private:
  struct Filtered {  // noise through one pole, and through a resonance
    double low = 0.0, band = 0.0, second = 0.0;
  };
  struct State {
    Voice last;
    double cycle = 0.0;                      // share of the engine's
    double low_horn = 0.0, high_horn = 0.0;  // shares of the two notes' cycles
    Filtered road, squeal;
  };
  double Noise();  // in [-1, 1)
  double OneSample(const Voice& voice, State& state);

  EngineWave coasting_{0.0}, pulling_{1.0};
  State own_;
  std::map<std::uint64_t, State> others_;
  Heard last_;
  double wind_ = 0.0, rain_ = 0.0, crash_ = 0.0, crash_low_ = 0.0;
  std::uint64_t noise_ = 1;
};

}  // namespace rodeira::sound
