// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace rodeira::sound {

// One cycle (two turns) of a four-stroke engine with four cylinders as a wave, without its mean, at most 1: it fires
// four times, so that the fourth harmonic of the cycle leads; the others are the unevenness of its cylinders. The more
// load, the more of the high ones.
class EngineWave {
 public:
  explicit EngineWave(double load);

  // At a share of the cycle, in [0, 1).
  float At(double share) const;

 private:
  static constexpr std::size_t kPoints = 2048;
  std::array<float, kPoints + 1> wave_;
};

// Harmonics of the cycle that it is made of. At 7200 turns a minute the highest is at 1440 Hz.
inline constexpr int kHarmonics = 24;
inline constexpr int kFirings = 4;  // a cycle

}  // namespace rodeira::sound
