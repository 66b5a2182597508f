// SPDX-License-Identifier: Apache-2.0
#include "common/core/geometry/clothoid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/assert.hpp"

namespace rodeira::geometry {
namespace {

// The Gauss-Legendre rule of 12 nodes on [-1, 1]: the positive nodes and their weights.
constexpr std::array<double, 6> kGauss12Nodes = {0.12523340851146891547, 0.36783149899818019375,
                                                 0.58731795428661744730, 0.76990267419430468704,
                                                 0.90411725637047485668, 0.98156063424671925069};
constexpr std::array<double, 6> kGauss12Weights = {0.24914704581340278500, 0.23349253653835480876,
                                                   0.20316742672306592175, 0.16007832854334622633,
                                                   0.10693932599531843096, 0.04717533638651182719};
constexpr double kLargestPanels = 1e7;  // more than a million turns: no road

}  // namespace

Eigen::Vector2d ClothoidIntegral(double k0_1pm, double k1_1pm2, double length_m) {
  const double steepest = std::max(std::fabs(k0_1pm), std::fabs(k0_1pm + k1_1pm2 * length_m));
  const double panels = std::ceil(steepest * std::fabs(length_m));
  RODEIRA_ASSERT(panels < kLargestPanels);  // false for NaN too
  const int count = std::max(1, static_cast<int>(panels));
  const double half = 0.5 * length_m / count;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int panel = 0; panel < count; ++panel) {
    const double middle = (2 * panel + 1) * half;
    for (std::size_t node = 0; node < kGauss12Nodes.size(); ++node) {
      for (const double side : {-1.0, 1.0}) {
        const double s = middle + side * half * kGauss12Nodes[node];
        const double heading = (k0_1pm + 0.5 * k1_1pm2 * s) * s;
        sum += kGauss12Weights[node] * Eigen::Vector2d(std::cos(heading), std::sin(heading));
      }
    }
  }
  return half * sum;
}

}  // namespace rodeira::geometry
