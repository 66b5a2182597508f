// SPDX-License-Identifier: Apache-2.0
#include "common/view/sound/engine_wave.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/core/base/random.hpp"

namespace rodeira::sound {

EngineWave::EngineWave(double load) {
  std::array<double, kPoints> wave{};
  for (int k = 1; k <= kHarmonics; ++k) {
    const bool firing = k % kFirings == 0;
    const double amplitude =
        firing ? std::pow(static_cast<double>(k) / kFirings, -1.7 + 0.9 * load) : 0.11 * std::pow(k, -0.6);
    const double phase = base::RandomUniform({17, static_cast<std::uint64_t>(k)}, 0.0, 2.0 * base::kPi);
    for (std::size_t i = 0; i < kPoints; ++i)
      wave[i] += amplitude * std::sin(2.0 * base::kPi * k * static_cast<double>(i) / kPoints + phase);
  }
  const double most = std::fabs(
      *std::max_element(wave.begin(), wave.end(), [](double a, double b) { return std::fabs(a) < std::fabs(b); }));
  for (std::size_t i = 0; i < kPoints; ++i) wave_[i] = static_cast<float>(wave[i] / most);
  wave_[kPoints] = wave_[0];
}

float EngineWave::At(double share) const {
  const double at = share * kPoints;
  const auto i = std::min(static_cast<std::size_t>(at), kPoints - 1);
  const auto part = static_cast<float>(at - static_cast<double>(i));
  return wave_[i] + part * (wave_[i + 1] - wave_[i]);
}

}  // namespace rodeira::sound
