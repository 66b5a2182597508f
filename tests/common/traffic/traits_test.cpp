// SPDX-License-Identifier: Apache-2.0
// Drivers differ as their settings say: what is drawn of them is distributed evenly over its range, each apart from the
// others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/traffic/state/traffic_settings.hpp"
#include "tests/common/traffic/distance.hpp"

namespace rodeira::traffic {
namespace {

constexpr std::uint32_t kDrivers = 8000;
constexpr double kOneInHundred = 1.63;  // of Kolmogorov and Smirnov

double Correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double ma = 0.0, mb = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) ma += a[i] / n, mb += b[i] / n;
  for (std::size_t i = 0; i < a.size(); ++i)
    aa += (a[i] - ma) * (a[i] - ma), bb += (b[i] - mb) * (b[i] - mb), ab += (a[i] - ma) * (b[i] - mb);
  return ab / std::sqrt(aa * bb);
}

// As shares of their ranges, of cars: time gap, acceleration and braking within ± the variety, the share of the planned
// speed between its two bounds.
std::vector<std::vector<double>> Drawn(const TrafficSettings& settings) {
  std::vector<std::vector<double>> drawn(4);
  const auto share = [&](double value, double middle) {
    return 0.5 + (value / middle - 1.0) / (2.0 * settings.variety);
  };
  for (std::uint32_t id = 0; id < kDrivers; ++id) {
    const AgentTraits traits = TraitsOf(settings, settings.mix, id);
    drawn[0].push_back(share(traits.idm.time_gap_s, settings.idm.time_gap_s));
    drawn[1].push_back(share(traits.idm.acceleration_mps2, settings.idm.acceleration_mps2));
    drawn[2].push_back(share(traits.idm.braking_mps2, settings.idm.braking_mps2));
    drawn[3].push_back((traits.speed_factor - settings.speed_factor_low) /
                       (settings.speed_factor_high - settings.speed_factor_low));
    EXPECT_EQ(traits.idm.min_gap_m, settings.idm.min_gap_m);
  }
  return drawn;
}

TEST(Traits, AreDistributedEvenlyAndApartFromOneAnother) {
  TrafficSettings settings;
  settings.mix.shares = {1.0, 0.0, 0.0, 0.0};
  for (const auto& [seed, variety] : {std::pair{1u, 0.15}, {9u, 0.5}}) {
    settings.seed = seed, settings.variety = variety;
    const auto drawn = Drawn(settings);
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      std::vector<double> sorted = drawn[k];
      std::sort(sorted.begin(), sorted.end());
      EXPECT_GE(sorted.front(), -1e-12) << k;
      EXPECT_LE(sorted.back(), 1.0 + 1e-12) << k;
      EXPECT_LT(Distance(sorted, [](double u) { return u; }), kOneInHundred) << k;
      for (std::size_t other = 0; other < k; ++other)
        EXPECT_LT(std::fabs(Correlation(drawn[k], drawn[other])), 3.3 / std::sqrt(kDrivers)) << k << " and " << other;
      // Nor does a driver depend on the one before.
      const std::vector<double> before(drawn[k].begin(), drawn[k].end() - 1),
          after(drawn[k].begin() + 1, drawn[k].end());
      EXPECT_LT(std::fabs(Correlation(before, after)), 3.3 / std::sqrt(kDrivers)) << k;
    }
  }
}

// Each of a kind's bodies, and each paint, as often as the others; kinds by their shares: within four deviations.
TEST(Traits, BodiesPaintsAndKindsAreAsOftenAsIsSaid) {
  TrafficSettings settings;
  settings.mix.shares = {0.5, 0.2, 0.2, 0.1};
  std::map<std::uint32_t, double> bodies, paints;
  std::map<VehicleKind, double> kinds;
  for (std::uint32_t id = 0; id < kDrivers; ++id) {
    const AgentTraits traits = TraitsOf(settings, settings.mix, id);
    ++bodies[traits.body], ++paints[traits.colour_rgb], ++kinds[traits.kind];
  }
  const auto expect = [&](double count, double share) {
    EXPECT_NEAR(count, share * kDrivers, 4.0 * std::sqrt(share * (1.0 - share) * kDrivers)) << share;
  };
  const std::vector<double> of_bodies{0.125, 0.125, 0.125, 0.125, 0.2, 0.1, 0.1, 0.1};
  ASSERT_EQ(bodies.size(), of_bodies.size());
  for (const auto& [body, count] : bodies) expect(count, of_bodies[body]);
  ASSERT_EQ(paints.size(), 8u);
  for (const auto& [paint, count] : paints) expect(count, 1.0 / 8.0);
  for (std::size_t k = 0; k < 4; ++k) expect(kinds[static_cast<VehicleKind>(k)], settings.mix.shares[k]);
}

}  // namespace
}  // namespace rodeira::traffic
