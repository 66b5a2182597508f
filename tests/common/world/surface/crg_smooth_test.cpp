// SPDX-License-Identifier: Apache-2.0
// Measured surfaces without their short waves: what is bilinear stays, waves shorter than the reach go, missing heights
// stay missing.
#include "common/world/surface/crg_smooth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "tests/common/world/surface/made_crg.hpp"

namespace rodeira::surface {
namespace {

CrgSurface Made(const std::function<double(double, double)>& z) {
  MadeCrg made;
  made.format = "LDFI";
  made.rows = 401, made.step = 0.05;
  made.v = {-2.0, -1.8, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.4, 2.0};  // not evenly spaced
  made.z = z;
  const auto file = made.Parse();
  EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().Text());
  return *file.value().surface;
}

TEST(CrgSmooth, WavesShorterThanTheReachGo) {
  const CrgSurface rough = Made([](double u, double v) { return 0.06 + 0.05 * std::sin(2.0 * M_PI * u / 0.43 + v); });
  const CrgSurface smooth = Smoothed(rough, 1.0);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double u = base::RandomUniform({i, 1}, 2.0, 18.0), v = base::RandomUniform({i, 2}, -2.0, 2.0);
    // A mean over r to either side of a wave of length l is at most l / (2 pi r) of its height; of two means that is
    // squared.
    ASSERT_NEAR(smooth.At(u, v).z_m, 0.06, 0.05 * std::pow(0.43 / (2.0 * M_PI), 2.0)) << u << " " << v;
  }
}

// In pairs around each height, so on an even grid along u a slope stays; across, where the file's lines are not even,
// what does not change.
TEST(CrgSmooth, WhatIsStraightStays) {
  const CrgSurface straight = Made([](double u, double) { return 0.3 + 0.02 * u; });
  const CrgSurface smooth = Smoothed(straight, 1.0);
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double u = base::RandomUniform({i, 3}, 0.0, 20.0), v = base::RandomUniform({i, 4}, -2.0, 2.0);
    ASSERT_NEAR(smooth.At(u, v).z_m, 0.3 + 0.02 * u, 1e-9) << u << " " << v;
    ASSERT_NEAR(smooth.At(u, v).dz_du, 0.02, 1e-9) << u << " " << v;
  }
}

TEST(CrgSmooth, MissingHeightsStayMissingAndCountForNothing) {
  CrgShape shape = Made([](double, double) { return 0.25; }).shape();
  const std::size_t sections = shape.v_m.size();
  for (const std::size_t hole : {200 * sections + 4, 201 * sections + 4, 300 * sections})
    shape.heights[hole] = std::nan("");
  const CrgShape smooth = Smoothed(CrgSurface(shape), 1.0).shape();
  for (std::size_t i = 0; i < shape.heights.size(); ++i) {
    ASSERT_EQ(std::isnan(smooth.heights[i]), std::isnan(shape.heights[i])) << i;
    if (!std::isnan(shape.heights[i])) {
      ASSERT_NEAR(smooth.heights[i], 0.25, 1e-12) << i;
    }
  }
}

}  // namespace
}  // namespace rodeira::surface
