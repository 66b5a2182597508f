// SPDX-License-Identifier: Apache-2.0
#include "tests/common/world/network/against_oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "tests/setting.hpp"

namespace rodeira::network {

void ExpectAgreement(const Network& network, const FileOracle& oracle, bool heights, const std::string& name) {
  const std::uint64_t points = Setting("RODEIRA_ORACLE_POINTS", 1000);
  std::uint64_t open = 0, on = 0, nearer = 0, differ = 0;
  double worst_s = 0.0, worst_t = 0.0, worst_distance = 0.0;
  for (std::uint64_t i = 0; i < points; ++i) {
    const std::size_t road = base::RandomBits({i, 11}) % oracle.roads();
    const Eigen::Vector3d about = oracle.On(road, base::RandomUniform({i, 12}, 0.0, oracle.length_m(road)));
    const double wide = i % 10 == 0 ? 100.0 : i % 3 == 0 ? 12.0 : 4.0;
    const Eigen::Vector2d p = about.head<2>() + Eigen::Vector2d(base::RandomUniform({i, 13}, -wide, wide),
                                                                base::RandomUniform({i, 14}, -wide, wide));
    std::optional<double> z;
    if (heights && i % 2 == 0) z = about.z() + base::RandomUniform({i, 15}, -6.0, 6.0);
    const FileOracle::Answer answer = oracle.Locate(p, z);
    if (answer.open) {
      ++open;
      continue;
    }
    const auto place = network.Locate(p.x(), p.y(), z);
    ASSERT_TRUE(place && answer.best);
    on += place->distance_m == 0.0 ? 1 : 0;
    const FileOracle::Foot& best = *answer.best;
    const std::string& id = network.roads()[place->lane.road].id();
    const bool same = id == best.road && place->lane.lane == best.lane && std::fabs(place->s_m - best.s_m) < 1e-6 &&
                      std::fabs(place->t_m - best.t_m) < 1e-6 && std::fabs(place->distance_m - best.distance_m) < 1e-6;
    if (same) {
      worst_distance = std::max(worst_distance, std::fabs(place->distance_m - best.distance_m));
      worst_s = std::max(worst_s, std::fabs(place->s_m - best.s_m)),
      worst_t = std::max(worst_t, std::fabs(place->t_m - best.t_m));
      continue;
    }
    // Beside all lanes, or over or under them, the nearest is taken of the feet on all parts into which a line is cut,
    // their ends too: where widths or heights change along the road one of those may be nearer than any that the oracle
    // knows.
    if (best.distance_m > 0.0 && place->distance_m > 0.0 && place->distance_m < best.distance_m) {
      ++nearer;
      continue;
    }
    if (++differ > 5) continue;
    ADD_FAILURE() << name << " (" << p.x() << ", " << p.y() << ", " << z.value_or(NAN) << "): road " << id << " lane "
                  << place->lane.lane << " s " << place->s_m << " t " << place->t_m << " distance " << place->distance_m
                  << "; the oracle: road " << best.road << " lane " << best.lane << " s " << best.s_m << " t "
                  << best.t_m << " distance " << best.distance_m << (best.past_end ? ", past an end" : "");
  }
  EXPECT_EQ(differ, 0u) << name << " of " << points;
  EXPECT_LT(open, points / 6) << name;  // most where ways through a junction begin on the same lane
  EXPECT_LT(nearer, points / 20 + 1) << name;
  EXPECT_GT(on, points / 5) << name;
  std::printf(
      "%s: %zu points, %zu open, %zu on a road, %zu beside one where another part's end is nearer, s to %.1e m, t to "
      "%.1e m, distance to %.1e m\n",
      name.c_str(), static_cast<std::size_t>(points), static_cast<std::size_t>(open), static_cast<std::size_t>(on),
      static_cast<std::size_t>(nearer), worst_s, worst_t, worst_distance);
}

}  // namespace rodeira::network
