// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/core/base/result.hpp"

namespace rodeira::surface {

// ISO 8608: how uneven a road is, by the one-sided power spectral density of its height along a track,
// G(n) = G(n0) (n / n0)^-2 at n cycles a metre, n0 = 0.1.
struct RoughnessSpec {
  double density_m3 = 0.0;  // G(n0), cubic metres
  std::uint64_t seed = 0;
};

// The geometric mean of a class, 'A' (very good, 16e-6 m3) to 'H' (262144e-6 m3), four times the one before. Wrong
// input for another letter.
base::Result<double> RoughnessOfClass(char letter);

// The height beside an even road, and its change.
struct RoughnessPoint {
  double z_m = 0.0;
  double dz_ds = 0.0;
  double dz_dt = 0.0;
};

// An uneven surface z(s, t): a sum of plane waves from 0.01 to 10.24 cycles a metre along s, twelve an octave. A wave's
// frequency along s is drawn within its twelfth of an octave, its amplitude carries exactly the power of that twelfth,
// and it goes at an angle a to s, with sin a drawn evenly: the directions of the waves of a surface without grain; its
// tracks have G(n) ~ n^-2. So every track along s has exactly the spectrum, and the coherence of two tracks d apart is
// 2 pi n d K1(2 pi n d), as for an isotropic road (Kamash and Robson, J. Sound and Vibration 54, 1977). Waves shorter
// than kShortest_m in any direction are left out, as a tyre's patch cannot follow them.
// A pure function of (spec, s, t), by sums, products and square roots only: any place, in any order, the same bits on
// every machine. For |s| and |t| up to 1e6 m.
class Roughness {
 public:
  static constexpr double kLowest_1pm = 0.01;
  static constexpr int kOctaves = 10;
  static constexpr int kWavesAnOctave = 12;
  static constexpr double kShortest_m = 0.04;

  explicit Roughness(const RoughnessSpec& spec);

  // s and t in metres; dz_ds and dz_dt are exact derivatives.
  RoughnessPoint At(double s_m, double t_m) const;
  const RoughnessSpec& spec() const { return spec_; }
  // The mean square height, m2: the density's integral over the frequencies, G(n0) n0^2 (1/n_low - 1/n_high).
  double variance_m2() const;
  // The part of it between two frequencies, cycles a metre.
  static double BandVariance(double density_m3, double low_1pm, double high_1pm);

 private:
  struct Waves {                           // four of them
    Eigen::Array4d along_1pm, across_1pm;  // cycles a metre
    Eigen::Array4d phase;                  // cycles
    Eigen::Array4d amplitude_m;
  };
  RoughnessSpec spec_;
  std::vector<Waves> waves_;
};

}  // namespace rodeira::surface
