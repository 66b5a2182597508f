// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/point_boxes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/core/base/random.hpp"

namespace rodeira::driver {
namespace {

// Whole numbers: many points are equally near.
Eigen::Vector3d Drawn(std::uint64_t set, std::uint64_t i) {
  const auto whole = [&](std::uint64_t purpose, double most) {
    return std::floor(base::RandomUniform({31, set, i, purpose}, 0.0, most));
  };
  return {whole(0, 30.0), whole(1, 30.0), 10.0 * whole(2, 3.0)};
}

// The oracle looks at every point in turn.
TEST(PointBoxes, TheFirstOfTheNearestIsFoundWhereverTheSearchBegins) {
  constexpr double kLevel_m = 4.0;
  std::size_t none = 0;
  for (std::uint64_t set = 0; set < 300; ++set) {
    const auto count = static_cast<std::size_t>(1.0 + std::pow(10.0, base::RandomUniform({32, set}, 0.0, 3.0)));
    std::vector<Eigen::Vector3d> points_W;
    for (std::size_t i = 0; i < count; ++i) points_W.push_back(Drawn(set, i));
    const PointBoxes boxes(points_W);
    for (std::uint64_t k = 0; k < 20; ++k) {
      const Eigen::Vector3d at = Drawn(1000 + set, k);
      const std::optional<double> z_m = k % 2 == 0 ? std::optional(at.z()) : std::nullopt;
      std::optional<std::size_t> expected;
      for (std::size_t i = 0; i < count; ++i) {
        const auto squared = [&](std::size_t j) { return (points_W[j] - at).head<2>().squaredNorm(); };
        if (z_m && std::fabs(points_W[i].z() - *z_m) > kLevel_m) continue;
        if (!expected || squared(i) < squared(*expected)) expected = i;
      }
      none += !expected;
      for (const std::size_t likely : {std::size_t{0}, count - 1, count + 7, boxes.Likely(at.head<2>())})
        EXPECT_EQ(boxes.Nearest(at.head<2>(), z_m, kLevel_m, likely), expected) << set << " " << k;
    }
  }
  EXPECT_GT(none, 10u);
}

}  // namespace
}  // namespace rodeira::driver
