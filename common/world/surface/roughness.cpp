// SPDX-License-Identifier: Apache-2.0
#include "common/world/surface/roughness.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"

namespace rodeira::surface {
namespace {

constexpr double kReference_1pm = 0.1;  // n0
constexpr double kClassA_m3 = 16e-6;
constexpr double kTwelfth = 1.0594630943592953;  // of an octave: 2^(1/12)
constexpr double kTwoPi = 2.0 * geometry::kPi;

enum Purpose : std::uint64_t { kFrequency = 1, kDirection = 2, kPhase = 3 };

using Four = Eigen::Array4d;

// The nearest whole number to each, for numbers far below 2^51.
Four Nearest(const Four& x) {
  constexpr double kUnitsOnly = 0x1.8p52;
  return (x + kUnitsOnly) - kUnitsOnly;
}

// cos(2 pi x) as the power series of the sine about the nearest zero; the next term is below 1e-13.
Four CosOfTurns(const Four& x) {
  const Four turns = 0.25 - (x - Nearest(x)).abs();  // -1/4 to 1/4
  const Four angle = kTwoPi * turns;
  const Four q = angle * angle;
  const Four low = 1.0 - q * (1.0 / 6.0 - q * (1.0 / 120.0 - q * (1.0 / 5040.0 - q * (1.0 / 362880.0))));
  const Four high =
      1.0 / 39916800.0 - q * (1.0 / 6227020800.0 - q * (1.0 / 1307674368000.0 - q * (1.0 / 355687428096000.0)));
  const Four q2 = q * q;
  const Four sum = low - q2 * q2 * q * high;
  return angle * sum;
}

}  // namespace

base::Result<double> RoughnessOfClass(char letter) {
  if (letter < 'A' || letter > 'H') {
    return base::WrongInput(
        "surface.unknown_roughness",
        fmt::format("'{}' is no class of roughness; 'A' (very good) to 'H' (very poor) were expected", letter));
  }
  double density = kClassA_m3;
  for (char c = 'A'; c < letter; ++c) density *= 4.0;
  return density;
}

double Roughness::BandVariance(double density_m3, double low_1pm, double high_1pm) {
  return density_m3 * kReference_1pm * kReference_1pm * (1.0 / low_1pm - 1.0 / high_1pm);
}

double Roughness::variance_m2() const {
  return BandVariance(spec_.density_m3, kLowest_1pm, kLowest_1pm * (1 << kOctaves));
}

Roughness::Roughness(const RoughnessSpec& spec) : spec_(spec) {
  if (!(spec_.density_m3 > 0.0)) return;
  waves_.resize(kOctaves * kWavesAnOctave / 4);
  double low = kLowest_1pm;
  for (std::uint64_t i = 0; i < kOctaves * kWavesAnOctave; ++i) {
    const double high = (i + 1) % kWavesAnOctave == 0
                            ? kLowest_1pm * static_cast<double>(1u << ((i + 1) / kWavesAnOctave))
                            : low * kTwelfth;
    const double along = base::RandomUniform({spec_.seed, kFrequency, i}, low, high);
    // As steep as the shortest wave allows: n / cos a <= 1 / shortest.
    const double cosine = along * kShortest_m;
    const double steepest = std::sqrt(1.0 - cosine * cosine);
    const double sine = base::RandomUniform({spec_.seed, kDirection, i}, -steepest, steepest);
    Waves& waves = waves_[i / 4];
    const auto lane = static_cast<Eigen::Index>(i % 4);
    waves.along_1pm[lane] = along;
    waves.across_1pm[lane] = along * sine / std::sqrt(1.0 - sine * sine);
    waves.phase[lane] = base::RandomUniform({spec_.seed, kPhase, i});
    waves.amplitude_m[lane] = std::sqrt(2.0 * BandVariance(spec_.density_m3, low, high));
    low = high;
  }
}

RoughnessPoint Roughness::At(double s_m, double t_m) const {
  Four z = Four::Zero(), along = Four::Zero(), across = Four::Zero();
  for (const Waves& waves : waves_) {
    const Four turns = waves.along_1pm * s_m + waves.across_1pm * t_m + waves.phase;
    const Four sines = waves.amplitude_m * CosOfTurns(turns - 0.25);
    z += waves.amplitude_m * CosOfTurns(turns);
    along += waves.along_1pm * sines;
    across += waves.across_1pm * sines;
  }
  const auto sum = [](const Four& x) { return (x[0] + x[1]) + (x[2] + x[3]); };
  return {sum(z), -kTwoPi * sum(along), -kTwoPi * sum(across)};
}

}  // namespace rodeira::surface
