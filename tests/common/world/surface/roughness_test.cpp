// SPDX-License-Identifier: Apache-2.0
// ISO 8608 against its own formula: Welch's estimate of the spectrum of sampled tracks, the variance, the structure of
// the surface along and across, the coherence of two tracks.
#include "common/world/surface/roughness.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>

#include "common/core/base/random.hpp"

namespace rodeira::surface {
namespace {

constexpr double kPi = 3.14159265358979323846;
using Complex = std::complex<double>;

// Radix-2 Fourier transform in place; the size is a power of two.
void Fourier(std::vector<Complex>& x) {
  const std::size_t n = x.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  for (std::size_t size = 2; size <= n; size *= 2) {
    for (std::size_t k = 0; k < size / 2; ++k) {
      const Complex turn = std::polar(1.0, -2.0 * kPi * static_cast<double>(k) / static_cast<double>(size));
      for (std::size_t begin = 0; begin < n; begin += size) {
        const Complex a = x[begin + k], b = turn * x[begin + k + size / 2];
        x[begin + k] = a + b;
        x[begin + k + size / 2] = a - b;
      }
    }
  }
}

struct Spectrum {
  double step_1pm;                 // between two values
  std::vector<double> density_m3;  // one-sided

  double Power(double low, double high) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < density_m3.size(); ++i) {
      const double n = static_cast<double>(i) * step_1pm;
      if (n >= low && n < high) sum += density_m3[i] * step_1pm;
    }
    return sum;
  }
};

// Welch (1967): halves overlapping, Hann's window.
Spectrum Welch(const std::vector<double>& z, double spacing_m, std::size_t size) {
  Spectrum spectrum{1.0 / (static_cast<double>(size) * spacing_m), std::vector<double>(size / 2)};
  std::vector<double> window(size);
  double power = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * kPi * static_cast<double>(i) / static_cast<double>(size));
    power += window[i] * window[i];
  }
  int pieces = 0;
  for (std::size_t begin = 0; begin + size <= z.size(); begin += size / 2, ++pieces) {
    std::vector<Complex> x(size);
    for (std::size_t i = 0; i < size; ++i) x[i] = window[i] * z[begin + i];
    Fourier(x);
    for (std::size_t i = 0; i < size / 2; ++i) spectrum.density_m3[i] += 2.0 * std::norm(x[i]) * spacing_m / power;
  }
  for (double& density : spectrum.density_m3) density /= pieces;
  return spectrum;
}

TEST(Roughness, TheSpectrumOfATrackIsThatOfItsClass) {
  // 16 km every 3.125 cm; pieces of 4.1 km resolve a twelfth of the lowest octave (0.0006 cycles/m) into two values.
  constexpr double spacing = 1.0 / 32.0;
  const double density = RoughnessOfClass('E').value();
  const Roughness roughness({density, 7});
  std::vector<double> z;
  for (std::size_t i = 0; i < (1u << 19); ++i) z.push_back(roughness.At(spacing * static_cast<double>(i), -1.6).z_m);
  const Spectrum spectrum = Welch(z, spacing, 1u << 17);
  // Octave by octave G(n) = G(n0) (n / n0)^-2; at an octave's edge a wave may count to the neighbour by leakage, at
  // most half of a twelfth on either side.
  double low = Roughness::kLowest_1pm;
  for (int octave = 0; octave < Roughness::kOctaves; ++octave, low *= 2.0) {
    const double expected = density * 0.1 * 0.1 * (1.0 / low - 0.5 / low);
    EXPECT_NEAR(spectrum.Power(low, 2.0 * low) / expected, 1.0, 0.05) << "octave from " << low;
  }
  EXPECT_LT(spectrum.Power(0.0, 0.95 * Roughness::kLowest_1pm), 1e-3 * spectrum.Power(0.0, 20.0));
  EXPECT_LT(spectrum.Power(1.02 * 10.24, 16.0), 1e-3 * spectrum.Power(5.0, 10.0));
  // Another class of the same seed is the same road, higher by the root of the densities.
  const Roughness even({RoughnessOfClass('A').value(), 7});
  for (const double s : {0.0, 12.3, 4567.8}) EXPECT_NEAR(16.0 * even.At(s, 1.0).z_m, roughness.At(s, 1.0).z_m, 1e-15);
}

TEST(Roughness, ItsVarianceIsTheIntegralOfTheDensity) {
  EXPECT_NEAR(RoughnessOfClass('A').value(), 16e-6, 1e-18);
  EXPECT_NEAR(RoughnessOfClass('H').value(), 262144e-6, 1e-12);
  EXPECT_FALSE(RoughnessOfClass('I').ok());
  EXPECT_FALSE(RoughnessOfClass('a').ok());
  const Roughness roughness({256e-6, 3});
  EXPECT_NEAR(roughness.variance_m2(), 256e-6 * 0.01 * (1.0 / 0.01 - 1.0 / 10.24), 1e-15);
  double sum = 0.0, squares = 0.0;
  constexpr int count = 400'000;  // over 200 km: what is left of the mean and of cross products is below 1 %
  for (int i = 0; i < count; ++i) {
    const double z = roughness.At(0.5 * i, 1.0).z_m;
    sum += z;
    squares += z * z;
  }
  EXPECT_NEAR(sum / count, 0.0, 1e-3 * std::sqrt(roughness.variance_m2()));
  EXPECT_NEAR(squares / count / roughness.variance_m2(), 1.0, 0.01);
}

// The mean of (z(p + d) - z(p))^2, over the surfaces of many seeds.
double Structure(double ds, double dt, std::uint64_t seeds) {
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Roughness roughness({1.0, seed});
    const double s = base::RandomUniform({seed, 99}, 0.0, 1000.0);
    const double difference = roughness.At(s + ds, dt).z_m - roughness.At(s, 0.0).z_m;
    sum += difference * difference;
  }
  return sum / static_cast<double>(seeds);
}

// The integral over the surface's frequencies of G(n) f(2 pi n d), for G(n0) = 1.
double Integral(double d, double (*f)(double)) {
  constexpr int steps = 100'000;
  const double low = std::log(0.01), high = std::log(10.24);
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double n = std::exp(low + (high - low) * (i + 0.5) / steps);
    sum += 0.01 / n * f(2.0 * kPi * n * d) * (high - low) / steps;
  }
  return sum;
}

TEST(Roughness, AlongAndAcrossItHasTheStructureOfItsSpectrum) {
  // Along s the mean square of a difference is the integral of 2 G(n) (1 - cos(2 pi n d)); across, where the coherence
  // of tracks is x K1(x), that of 2 G(n) (1 - x K1(x)); K1 is the library's. (20 000 draws of a square: a standard
  // error of 1 %.)
  for (const double d : {0.2, 1.0, 3.0}) {
    EXPECT_NEAR(Structure(d, 0.0, 20'000) / Integral(d, [](double x) { return 2.0 * (1.0 - std::cos(x)); }), 1.0, 0.04)
        << d;
    EXPECT_NEAR(
        Structure(0.0, d, 20'000) / Integral(d, [](double x) { return 2.0 * (1.0 - x * std::cyl_bessel_k(1.0, x)); }),
        1.0, 0.04)
        << d;
  }
}

TEST(Roughness, ItsSlopesAreThoseOfNeighbouringPoints) {
  const Roughness roughness({1024e-6, 11});
  constexpr double h = 1e-5;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double s = base::RandomUniform({i, 1}, -3000.0, 3000.0), t = base::RandomUniform({i, 2}, -10.0, 10.0);
    const RoughnessPoint point = roughness.At(s, t);
    EXPECT_NEAR(point.dz_ds, (roughness.At(s + h, t).z_m - roughness.At(s - h, t).z_m) / (2.0 * h), 2e-6);
    EXPECT_NEAR(point.dz_dt, (roughness.At(s, t + h).z_m - roughness.At(s, t - h).z_m) / (2.0 * h), 2e-6);
  }
}

RC_GTEST_PROP(Roughness, EverySeedIsAnotherRoadAndTheSameOneAgain, (std::uint64_t seed, std::uint64_t other)) {
  RC_PRE(seed != other);
  const Roughness a({64e-6, seed}), again({64e-6, seed}), b({64e-6, other});
  double difference = 0.0;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const double s = base::RandomUniform({seed, i, 1}, -1e5, 1e5), t = base::RandomUniform({seed, i, 2}, -10.0, 10.0);
    RC_ASSERT(a.At(s, t).z_m == again.At(s, t).z_m && a.At(s, t).dz_dt == again.At(s, t).dz_dt);
    difference += std::fabs(a.At(s, t).z_m - b.At(s, t).z_m);
  }
  RC_ASSERT(difference > 1e-3);
}

TEST(Roughness, ItsBitsAreKnown) {  // the same on every machine, whatever its mathematics library
  const RoughnessPoint point = Roughness({256e-6, 42}).At(1234.5, -1.75);
  EXPECT_EQ(point.z_m, -0x1.0da73971471p-12);
  EXPECT_EQ(point.dz_ds, -0x1.cc233f505ea2p-10);
  EXPECT_EQ(point.dz_dt, -0x1.1b6afd43f4a61p-6);
}

}  // namespace
}  // namespace rodeira::surface
