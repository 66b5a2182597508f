// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/time_to_line.hpp"

#include <gtest/gtest.h>

#include "common/analysis/measures/catalogue.hpp"
#include "common/analysis/measures/given_drive.hpp"
#include "tests/common/analysis/measures/signals.hpp"

namespace rodeira::measures {
namespace {

// A straight lane, a heading psi and no yaw: (half lane - half car - |y|) / (v sin psi) of a car without a length,
// with corners' half width by cos psi.
TEST(TimeToLine, StraightLaneStraightOn) {
  for (const double heading : {0.02, -0.05}) {
    const LaneApproach a{.y_m = 0.2, .heading_rad = heading, .speed_mps = 25.0, .lane_width_m = 3.6, .width_m = 1.8};
    const double side = heading > 0.0 ? 1.0 : -1.0;
    const double expected = (1.8 - 0.9 * std::cos(heading) - side * 0.2) / (25.0 * std::abs(std::sin(heading)));
    EXPECT_NEAR(TrigonometricTlc_s(a), expected, 1e-9);
  }
}

// With a yaw rate r: cos(psi + r t) = cos(psi) - dy r / v for the point that turns; a car without width and length.
TEST(TimeToLine, StraightLaneWithYaw) {
  for (const double yaw : {0.03, 0.002, -0.0001}) {
    const LaneApproach a{.y_m = 0.3, .heading_rad = 0.01, .speed_mps = 20.0, .yaw_radps = yaw, .lane_width_m = 3.5};
    const double t = TrigonometricTlc_s(a);
    ASSERT_FALSE(std::isnan(t)) << yaw;
    EXPECT_NEAR(std::cos(0.01 + yaw * t), std::cos(0.01) - (1.75 - 0.3) * yaw / 20.0, 1e-9) << yaw;
  }
}

// On a circle of the lane's own radius no line is ever reached; straight on in such a lane the corner reaches the outer
// line where the chord does: R_o^2 = R_c^2 + s^2 for a point on the middle, s = v t.
TEST(TimeToLine, CurvedLane) {
  for (const double curvature : {1.0 / 250.0, -1.0 / 250.0}) {
    LaneApproach a{
        .speed_mps = 20.0, .yaw_radps = 20.0 * curvature, .lane_width_m = 3.5, .lane_curvature_1pm = curvature};
    EXPECT_TRUE(std::isnan(TrigonometricTlc_s(a)));
    a.yaw_radps = 0.0;
    const double way = std::sqrt(std::pow(250.0 + 1.75, 2) - 250.0 * 250.0);
    EXPECT_NEAR(TrigonometricTlc_s(a), way / 20.0, 1e-9);
  }
}

TEST(TimeToLine, BeyondALineItIsZeroAndFarAwayMissing) {
  LaneApproach a{.y_m = 1.0, .heading_rad = 0.0, .speed_mps = 20.0, .lane_width_m = 3.5, .width_m = 1.8};
  EXPECT_EQ(TrigonometricTlc_s(a), 0.0);
  a.y_m = 0.0;
  EXPECT_TRUE(std::isnan(TrigonometricTlc_s(a)));
  a.heading_rad = 1e-4;  // 425 s
  EXPECT_TRUE(std::isnan(TrigonometricTlc_s(a)));
  a.y_m = kMissing;
  EXPECT_TRUE(std::isnan(TrigonometricTlc_s(a)));
}

// d = 0.8 m, 0.5 m/s towards the line, 0.3 m/s^2 more.
TEST(TimeToLine, FirstAndSecondOrder) {
  EXPECT_DOUBLE_EQ(FirstOrderTlc_s(0.8, 0.5), 1.6);
  EXPECT_DOUBLE_EQ(SecondOrderTlc_s(0.8, 0.5, 0.3), 1.0);
  EXPECT_TRUE(std::isnan(FirstOrderTlc_s(0.8, 0.0)));
  EXPECT_TRUE(std::isnan(FirstOrderTlc_s(0.8, -0.5)));
  EXPECT_TRUE(std::isnan(SecondOrderTlc_s(0.8, 0.5, -0.6)));
  EXPECT_EQ(FirstOrderTlc_s(-0.1, 0.5), 0.0);
}

// As measures, by their option: d = 2 - 0.05 t^2 to the left line for 5 s, d' = 0.1 t, d'' = 0.1; then away from it.
TEST(TimeToLine, MeasuresByDistance) {
  GivenDrive given;
  given.rate_hz = 100.0;
  given.columns["left_line_m"] = Sampled(10.0, 100.0, [](double t) { return t < 5.0 ? 2.0 - 0.05 * t * t : 0.75; });
  given.columns["right_line_m"] = std::vector<double>(1000, 1.5);
  given.columns["lane_position_m"] = std::vector<double>(1000, 0.0);
  const Drive drive = DriveOf(given).value();
  const auto value = [&](const char* name, double method) {
    const MeasureInfo& info = *FindMeasure(name).value();
    const std::map<std::string, double> options{{"method", method}};
    return info.compute({drive, 0, drive.size(), {}}, OptionValues(info.options, options));
  };
  EXPECT_NEAR(*value("tlc_min_s", 1.0).value, 0.75 / 0.5, 0.02);
  EXPECT_NEAR(*value("tlc_min_s", 2.0).value, 0.75 / 0.6, 0.03);
  EXPECT_EQ(*value("tlc_below_share", 1.0).value, 0.0) << "never below 1 s";
  EXPECT_FALSE(value("tlc_min_s", 0.0).value) << "no heading, no width";
  EXPECT_EQ(value("tlc_min_s", 1.0).options[1], (UsedOption{"method", "TLC 1, of the footprint"}));
}

TEST(TimeToLine, EachApproachHasOneMinimum) {
  const std::vector<double> tlc{kMissing, 3.0, 2.0, 2.5, kMissing, kMissing, 0.7, 0.9, kMissing, 5.0};
  EXPECT_EQ(ApproachMinima(tlc), (std::vector<double>{2.0, 0.7, 5.0}));
}

}  // namespace
}  // namespace rodeira::measures
