// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

#include <fstream>

#include "common/core/base/random.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/driving/driver/autopilot.hpp"
#include "common/driving/driver/driver_schema.hpp"
#include "tests/common/core/config/every_key.hpp"
#include "tests/common/driving/driver/test_road.hpp"
#include "tests/lane_path.hpp"
#include "tests/tree.hpp"

namespace rodeira::driver {
namespace {

RC_GTEST_PROP(Idm, NothingAcceleratesAtTheEquilibriumGap, (std::uint32_t seed)) {
  const IdmSettings idm;
  const double v0 = base::RandomUniform({seed, 0}, 5, 40);
  const double v = v0 * base::RandomUniform({seed, 1}, 0.0, 0.99);
  RC_ASSERT(std::fabs(IdmAcceleration(idm, v, v0, IdmEquilibriumGap(idm, v, v0), v)) < 1e-9);
}

TEST(Idm, AgreesWithItsFormula) {
  const IdmSettings idm{.time_gap_s = 1.5, .min_gap_m = 2, .acceleration_mps2 = 1, .braking_mps2 = 1.5};
  // v 20, v0 30, gap 50, leader 15: s* = 2 + 30 + 20·5/(2 sqrt 1.5) = 72.8248; a = 1 - (2/3)^4 - (72.8248/50)² =
  // -1.318897
  EXPECT_NEAR(IdmAcceleration(idm, 20, 30, 50, 15), 1 - 16.0 / 81 - std::pow((32 + 100 / (2 * std::sqrt(1.5))) / 50, 2),
              1e-12);
  EXPECT_NEAR(IdmFreeAcceleration(idm, 0, 30), 1.0, 1e-12);
  EXPECT_NEAR(IdmFreeAcceleration(idm, 30, 30), 0.0, 1e-12);
  EXPECT_LT(IdmFreeAcceleration(idm, 35, 30), 0.0);
  EXPECT_EQ(IdmAcceleration(idm, 20, 30, -1, 20), -idm.max_deceleration_mps2);
}

// On a circle a lane at offset t is (R - t) long a radian; the other lane runs the other way.
TEST(LanePath, DistancesAreTheLanesOwn) {
  const double radius = 50.0, angle = 2.0;
  const Version1Road road(
      TwoLanes({{radius * angle, 1 / radius, 1 / radius}}, 20, {{0, 0, 0}, {radius * angle, 0, 0}}));
  const LanePath right(road, -1);
  const LanePath left(road, 1);
  EXPECT_NEAR(right.length_m(), (radius + 1.5) * angle, 1e-9);
  EXPECT_NEAR(left.length_m(), (radius - 1.5) * angle, 1e-9);
  EXPECT_NEAR(right.At(30).curvature_1pm, 1 / (radius + 1.5), 1e-12);
  EXPECT_NEAR(left.At(30).curvature_1pm, -1 / (radius - 1.5), 1e-12);
  EXPECT_NEAR(std::fabs(geometry::WrapAngle(left.At(0).heading_rad - right.At(right.length_m()).heading_rad)),
              geometry::kPi, 1e-9);
  // A step along the lane moves by as much.
  EXPECT_NEAR((right.Position(40.001, 0) - right.Position(40, 0)).norm(), 0.001, 1e-9);
}

RC_GTEST_PROP(LanePath, LocateLeadsBackToPosition, (std::uint32_t seed)) {
  static const Version1Road road(WindingRoad());
  static const LanePath paths[] = {LanePath(road, -1), LanePath(road, 1)};
  const LanePath& path = paths[seed % 2];
  const double d = path.length_m() * base::RandomUniform({seed, 0}, 0.001, 0.999);
  const double offset = base::RandomUniform({seed, 1}, -3, 3);
  const Eigen::Vector3d p = path.Position(d, offset);
  const auto place = path.Locate(p.x(), p.y());
  RC_ASSERT(place.has_value());
  RC_ASSERT(std::fabs(place->d_m - d) < 1e-6 && std::fabs(place->offset_m - offset) < 1e-6);
}

TEST(SpeedPlan, KeepsTheLimitTheBendsAndThePlannedBraking) {
  const Version1Road road(WindingRoad(20.0));
  const SpeedPlanSettings settings{.stop_at_end = true};
  for (const int lane : {-1, 1}) {
    const LanePath path(road, lane);
    const SpeedPlan plan(path, settings);
    double slowest = 1e9;
    for (double d = 0; d < path.length_m() - 1; d += 0.5) {
      const auto here = plan.At(d);
      EXPECT_LE(here.speed_mps, 20.0 + 1e-9);
      // Between nodes a clothoid may be a little sharper than at them.
      EXPECT_LE(here.speed_mps * here.speed_mps * std::fabs(path.At(d).curvature_1pm), settings.lateral_mps2 * 1.06)
          << d;
      EXPECT_GE(here.slope_1ps * here.speed_mps, -settings.braking_mps2 - 1e-9);
      if (d < path.length_m() - 50) slowest = std::min(slowest, here.speed_mps);
    }
    // The outer lane of the bend of 35 m, which leans outward by the roof's 2.5 %; the inner one leans inward.
    EXPECT_NEAR(slowest,
                std::sqrt(9.81 * std::tan(std::atan(settings.lateral_mps2 / 9.81) - std::atan(0.025)) * (35.0 + 1.5)),
                0.05);
    EXPECT_EQ(plan.At(path.length_m()).speed_mps, 0.0);
  }
}

// The target on a circle to which the car is tangent at its rear axle: the front wheels' angle of that circle.
TEST(Steering, PursuitOnACircleIsTheCirclesAngle) {
  SteeringSettings settings;
  settings.understeer_radps2pm = 0.0;
  for (const double radius : {30.0, -80.0}) {
    for (const double arc : {5.0, 20.0}) {
      const double turn = arc / radius;
      const Eigen::Vector2d target(radius * std::sin(turn), radius * (1 - std::cos(turn)));
      EXPECT_NEAR(PursuitAngle(settings, Eigen::Vector2d::Zero(), 0.0, target, 2.5, 10.0), std::atan(2.5 / radius),
                  1e-12);
    }
  }
}

TEST(Leader, OnlyWhatIsAheadAndInTheWay) {
  const Version1Road road(StraightRoad(300, 20));
  const LanePath path(road, -1);
  const auto at = [&](double d, double offset, double turn, double speed) {
    const Eigen::Vector3d p = path.Position(d, offset);
    return Footprint{1, p.x(), p.y(), path.At(d).heading_rad + turn, speed, 4.0, 1.7};
  };
  LeaderHints hints;
  const auto find = [&](const std::vector<Footprint>& others) {
    return FindLeader(path, others, 100, 102, 1.1, 80, hints);
  };
  EXPECT_FALSE(find({at(90, 0, 0, 5), at(150, 3.0, 0, 5), at(250, 0, 0, 5)}).has_value());
  const auto nearest = find({at(150, 0, 0, 5), at(130, 0.5, 0, 7), at(170, 0, 0, 1)});
  ASSERT_TRUE(nearest.has_value());
  EXPECT_NEAR(nearest->gap_m, 130 - 2 - 102, 1e-9);
  EXPECT_NEAR(nearest->speed_mps, 7.0, 1e-9);
  EXPECT_NEAR(find({at(130, 0, geometry::kPi, 8)})->speed_mps, -8.0, 1e-9);                // comes towards us
  EXPECT_NEAR(find({at(130, 0, 0.5 * geometry::kPi, 0)})->gap_m, 130 - 0.85 - 102, 1e-9);  // stands across
  EXPECT_LT(find({at(101, 0, 0, 0)})->gap_m, 0.0);
}

TEST(DriverFile, LoadsAndRefuses) {
  const auto driver = LoadDriver(std::filesystem::path(SourceDir()) / "configs/drivers/default.yaml");
  ASSERT_TRUE(driver.ok()) << driver.error().Text();
  EXPECT_TRUE(driver.value().speed.stop_at_end);
  const auto path = std::filesystem::temp_directory_path() / ("rodeira-driver-" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(path) << "rodeira: driver/1\nfollowing:\n  time_gap_ms: 1500\n";
  EXPECT_THAT(LoadDriver(path).error().Text(), testing::HasSubstr(":3: unknown key 'following.time_gap_ms'"));
  std::filesystem::remove(path);
}

// The first problem of a driver file; empty without one.
std::string DriverProblem(const std::string& text) {
  const auto file = config::File::Parse(text, "driver.yaml");
  if (!file) return file.error().Text();
  (void)ReadAutopilot(file.value().root());
  const base::Status status = file.value().Finish();
  return status ? "" : status.error().Text();
}

TEST(DriverFile, EveryDeclaredKeyKeepsItsTypeAndBounds) { config::ExpectEveryKey(DriverSchema(), DriverProblem); }

TEST(DriverFile, AnEmptyFileGivesTheModelsDefaults) {
  const auto file = config::File::Parse("rodeira: driver/1", "driver.yaml");
  ASSERT_TRUE(file.ok());
  const AutopilotSettings read = ReadAutopilot(file.value().root()), model;
  EXPECT_EQ(read.speed_factor, model.speed_factor);
  EXPECT_EQ(read.anticipation_s, model.anticipation_s);
  EXPECT_EQ(read.tracking_s, model.tracking_s);
  EXPECT_EQ(read.side_margin_m, model.side_margin_m);
  EXPECT_EQ(read.range_m, model.range_m);
  EXPECT_EQ(read.idm.time_gap_s, model.idm.time_gap_s);
  EXPECT_EQ(read.idm.min_gap_m, model.idm.min_gap_m);
  EXPECT_EQ(read.idm.acceleration_mps2, model.idm.acceleration_mps2);
  EXPECT_EQ(read.idm.braking_mps2, model.idm.braking_mps2);
  EXPECT_EQ(read.idm.max_deceleration_mps2, model.idm.max_deceleration_mps2);
  EXPECT_EQ(read.speed.lateral_mps2, model.speed.lateral_mps2);
  EXPECT_EQ(read.speed.vertical_mps2, model.speed.vertical_mps2);
  EXPECT_EQ(read.speed.braking_mps2, model.speed.braking_mps2);
  EXPECT_EQ(read.speed.steep_grade, model.speed.steep_grade);
  EXPECT_EQ(read.speed.steep_factor, model.speed.steep_factor);
  EXPECT_EQ(read.steering.preview_s, model.steering.preview_s);
  EXPECT_EQ(read.steering.preview_least_m, model.steering.preview_least_m);
  EXPECT_EQ(read.steering.preview_most_m, model.steering.preview_most_m);
  EXPECT_EQ(read.steering.understeer_radps2pm, model.steering.understeer_radps2pm);
  EXPECT_EQ(read.steering.rate_radps, model.steering.rate_radps);
  EXPECT_EQ(read.steering.smoothing_s, model.steering.smoothing_s);
}

}  // namespace
}  // namespace rodeira::driver
