// SPDX-License-Identifier: Apache-2.0
// Anti-lock brakes, traction and stability control of the cars by the criteria of UN regulations 13-H and 140.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/common/vehicle/dynamics/same_bits.hpp"
#include "tests/common/vehicle/dynamics/with_assists.hpp"

namespace rodeira::dynamics {
namespace {

constexpr double kStep = 0.001;
constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kKmh = 1.0 / 3.6;

class SplitRoad final : public ground::Ground {
 public:
  SplitRoad(double left, double right) : left_(left), right_(right) {}
  void Query(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      points[i] = {};
      points[i].friction = queries[i].y_m > 0.0 ? left_ : right_;
      points[i].surface = ground::Surface::kAsphalt;
      points[i].inside = true;
    }
  }

 private:
  double left_, right_;
};

constexpr assists::AssistSettings With(bool abs, bool tcs, bool esc) {
  assists::AssistSettings settings;
  settings.abs = abs;
  settings.tcs = tcs;
  settings.esc = esc;
  return settings;
}
constexpr assists::AssistSettings kNone, kAbs = With(true, false, false), kTcs = With(false, true, false),
                                         kAll = With(true, true, true);

class AssistsOf : public ::testing::TestWithParam<ModelCase> {
 protected:
  // For docs/explanation/validation.md.
  void Got(const std::string& what, double value, const char* unit) const {
    RecordProperty(std::string(GetParam().name) + "_" + what, fmt::format("{:.1f}{}", value, unit));
  }
};

struct Stop {
  double z = 0.0;       // mean deceleration from 45 to 15 km/h over g
  bool locked = false;  // a wheel, above 15 km/h
};

Stop Brake(VehicleModel& car, ground::Ground& ground, double speed_mps) {
  EXPECT_TRUE(car.Initialise({.speed_mps = speed_mps}, ground).ok());
  Stop stop;
  double at_45_s = -1.0, at_15_s = -1.0;
  for (int i = 0; i < 60000 && at_15_s < 0.0; ++i) {
    car.Step(Neutral(1.0), ground, kStep);
    const double now_mps = car.state().speed_mps();
    if (at_45_s < 0.0 && now_mps < 45.0 * kKmh) at_45_s = kStep * i;
    if (now_mps < 15.0 * kKmh) at_15_s = kStep * i;
    if (now_mps > 15.0 * kKmh)
      for (const WheelState& wheel : car.state().wheels) stop.locked = stop.locked || wheel.spin_radps < 1.0;
  }
  stop.z = 30.0 * kKmh / (at_15_s - at_45_s) / 9.81;
  return stop;
}

// UN R13-H, annex 6, 5.2: the adhesion utilised is at least 0.75 of what the road offers (here: the tyres' largest
// longitudinal force over the load, at rest); 5.3.1: no wheel locks above 15 km/h when the pedal is pressed at once,
// from 40 and from 120 km/h, on a high and on a low friction.
TEST_P(AssistsOf, AntiLockBrakesUseTheRoadAndLockNoWheel) {
  auto with = MakeWith(GetParam(), kAbs), without = MakeWith(GetParam(), kNone);
  for (const double friction : {0.9, 0.3}) {
    SplitRoad road(friction, friction);
    SCOPED_TRACE(friction);
    for (const double speed_kmh : {40.0, 55.0, 120.0}) {
      const Stop stop = Brake(*with, road, speed_kmh * kKmh);
      EXPECT_FALSE(stop.locked) << speed_kmh;
      if (speed_kmh == 55.0) {
        Got(fmt::format("used_of_{}", friction), stop.z / friction, "");
        EXPECT_GT(stop.z, 0.75 * friction);
        EXPECT_LT(stop.z, 1.15 * friction);
      }
    }
    EXPECT_TRUE(Brake(*without, road, 120.0 * kKmh).locked);
  }
}

// As forward, from 8 m/s backward on a wet road.
TEST_P(AssistsOf, AntiLockBrakesLockNoWheelBackward) {
  for (const double friction : {0.5, 0.3}) {
    SCOPED_TRACE(friction);
    SplitRoad road(friction, friction);
    bool was_locked = false;
    for (const assists::AssistSettings& assists : {kNone, kAbs, kAll}) {
      const auto car = MakeWith(GetParam(), assists);
      ASSERT_TRUE(car->Initialise({.speed_mps = -8.0}, road).ok());
      bool locked = false;
      for (int i = 0; i < 8000 && car->state().speed_mps() < -0.1; ++i) {
        car->Step(Neutral(1.0), road, kStep);
        if (car->state().speed_mps() > -15.0 * kKmh) continue;
        for (const WheelState& wheel : car->state().wheels) locked = locked || wheel.spin_radps > -1.0;
      }
      EXPECT_GT(car->state().speed_mps(), -0.1);
      if (!assists.any()) {
        was_locked = locked;
      } else {
        EXPECT_FALSE(locked) << (assists.esc ? "all" : "abs");
      }
      const double way_m = -car->state().p_WB_W.x();
      if (assists.any()) {
        EXPECT_LT(way_m, 8.0 * 8.0 / (2.0 * 0.75 * friction * 9.81)) << "adhesion used";
      }
    }
    EXPECT_TRUE(was_locked);
  }
}

// A gentle bend backward, each way: nothing is braked.
TEST_P(AssistsOf, StabilityControlLeavesABendBackwardAlone) {
  const auto with = MakeWith(GetParam(), kAll), without = MakeWith(GetParam(), kNone);
  SplitRoad road(1.0, 1.0);
  for (const double angle_rad : {1.0, -1.0}) {
    for (VehicleModel* car : {with.get(), without.get()}) {
      ASSERT_TRUE(car->Initialise({.speed_mps = -8.0}, road).ok());
      Controls controls = Neutral();
      for (int i = 0; i < 1500; ++i) {
        controls.steering_wheel_rad = std::clamp(angle_rad, -2.0 * kStep * i, 2.0 * kStep * i);
        car->Step(controls, road, kStep);
        for (const WheelState& wheel : car->state().wheels) ASSERT_EQ(wheel.brake_torque_Nm, 0.0) << i;
      }
    }
    EXPECT_LT(angle_rad * with->state().w_WB_B.z(), -0.1) << "backward, the yaw rate is the other way";
    EXPECT_EQ(with->state().p_WB_W, without->state().p_WB_W);
  }
}

// 5.3.6 and 5.3.5: on a road of 1.0 left and 0.3 right from 50 km/h a driver holds the lane with at most 120 degrees in
// the first two seconds and 240 in all, and the car slows down by at least 0.75 (4 k_low + k_high) / 5 and k_low.
TEST_P(AssistsOf, AntiLockBrakesLeaveADriverTheLaneOnASplitRoad) {
  const auto car = MakeWith(GetParam(), kAbs);
  SplitRoad road(1.0, 0.3);
  ASSERT_TRUE(car->Initialise({.speed_mps = 50.0 * kKmh}, road).ok());
  Controls controls = Neutral(1.0);
  double early_rad = 0.0, most_rad = 0.0, off_m = 0.0, at_45_s = -1.0, at_15_s = -1.0;
  for (int i = 0; i < 12000 && car->state().speed_mps() > 0.3; ++i) {
    const VehicleState& s = car->state();
    // By place, heading and yaw rate; hands turn a wheel by 10 rad/s at most.
    const double wanted =
        -(0.15 * s.p_WB_W.y() + s.heading_rad() + 0.25 * s.w_WB_B.z()) * car->dimensions().steering_ratio;
    controls.steering_wheel_rad += std::clamp(wanted - controls.steering_wheel_rad, -0.01, 0.01);
    car->Step(controls, road, kStep);
    if (i < 2000) early_rad = std::max(early_rad, std::fabs(controls.steering_wheel_rad));
    most_rad = std::max(most_rad, std::fabs(controls.steering_wheel_rad));
    off_m = std::max(off_m, std::fabs(car->state().p_WB_W.y()));
    if (at_45_s < 0.0 && s.speed_mps() < 45.0 * kKmh) at_45_s = kStep * i;
    if (at_15_s < 0.0 && s.speed_mps() < 15.0 * kKmh) at_15_s = kStep * i;
  }
  Got("2_s", early_rad / kDegree, "");
  Got("all", most_rad / kDegree, " deg");
  EXPECT_LT(early_rad, 120.0 * kDegree);
  EXPECT_LT(most_rad, 240.0 * kDegree);
  EXPECT_LT(off_m, 0.5 * car->dimensions().track_front_m) << "a wheel is on the other side";
  EXPECT_GT(30.0 * kKmh / (at_15_s - at_45_s) / 9.81, std::max(0.3, 0.75 * (4.0 * 0.3 + 1.0) / 5.0));
}

// Full throttle on a slippery road: the driven wheels hardly spin, and the car gains at least three quarters of what
// their load would let it. On ice under one side the brake of the spinning wheel lets the other one pull: more than an
// open differential.
TEST_P(AssistsOf, TractionControlPullsAway) {
  const auto drive = [&](const assists::AssistSettings& assists, double left, double right, double* spins_mps) {
    const auto car = MakeWith(GetParam(), assists);
    SplitRoad road(left, right);
    EXPECT_TRUE(car->Initialise({}, road).ok());
    Controls controls;
    controls.throttle = 1.0;
    for (int i = 0; i < 4000; ++i) {
      car->Step(controls, road, kStep);
      if (i < 2000) continue;
      for (const WheelState& w : car->state().wheels)
        *spins_mps = std::max(*spins_mps, w.spin_radps * car->dimensions().wheel_radius_m - car->state().speed_mps());
    }
    return car->state().speed_mps();
  };
  double controlled_mps = 0.0, free_mps = 0.0;
  const double with = drive(kTcs, 0.2, 0.2, &controlled_mps), without = drive(kNone, 0.2, 0.2, &free_mps);
  EXPECT_LT(controlled_mps, 0.3 * free_mps);
  EXPECT_GT(with, without);
  double ignored = 0.0;
  EXPECT_GT(drive(kTcs, 0.1, 1.0, &ignored), 1.3 * drive(kNone, 0.1, 1.0, &ignored));
}

// In reverse gear as forward: on a slippery road the driven wheels hardly spin, and a road that holds is left to the
// engine.
TEST_P(AssistsOf, TractionControlPullsAwayBackward) {
  const auto drive = [&](const assists::AssistSettings& assists, double friction, double throttle, double* spins_mps) {
    const auto car = MakeWith(GetParam(), assists);
    SplitRoad road(friction, friction);
    EXPECT_TRUE(car->Initialise({}, road).ok());
    Controls controls;
    controls.gear = -1;
    controls.throttle = throttle;
    for (int i = 0; i < 3000; ++i) {
      car->Step(controls, road, kStep);
      if (i < 1500) continue;
      for (const WheelState& w : car->state().wheels)
        *spins_mps = std::max(*spins_mps, -w.spin_radps * car->dimensions().wheel_radius_m + car->state().speed_mps());
    }
    return car->state().speed_mps();
  };
  double controlled_mps = 0.0, free_mps = 0.0, ignored = 0.0;
  const double with = drive(kAll, 0.2, 0.7, &controlled_mps), without = drive(kNone, 0.2, 0.7, &free_mps);
  EXPECT_LT(controlled_mps, 0.3 * free_mps);
  EXPECT_LT(with, 0.9 * without) << "as fast, backward";
  EXPECT_NEAR(drive(kAll, 1.0, 0.3, &ignored), drive(kNone, 1.0, 0.3, &ignored), 0.05);
}

// A car that rolls back on a slope of 18 % is caught by the engine, as without controllers.
TEST_P(AssistsOf, TheEngineCatchesACarThatRollsBack) {
  ground::PlaneGround hill(Eigen::Vector3d::Zero(), 0.18, 0.0);
  std::vector<double> speeds_mps;
  for (const assists::AssistSettings& assists : {kNone, kAll}) {
    const auto car = MakeWith(GetParam(), assists);
    ASSERT_TRUE(car->Initialise({}, hill).ok());
    DriveFor(*car, hill, Neutral(), 0.7);  // D is not entered beyond 1.5 m/s
    EXPECT_LT(car->state().speed_mps(), -1.0);
    Controls controls;
    controls.throttle = 0.8;
    DriveFor(*car, hill, controls, 4.0);
    speeds_mps.push_back(car->state().speed_mps());
  }
  EXPECT_GT(speeds_mps[0], 1.0);
  EXPECT_NEAR(speeds_mps[1], speeds_mps[0], 0.2);
}

// With wheels that roll the estimate is their speed, forward and backward, whether the driver brakes or not.
TEST(MotionEstimator, FollowsWheelsThatRollForwardAndBackward) {
  assists::AssistCar car;
  car.static_load_N = {2500.0, 2500.0, 2500.0, 2500.0};
  for (const bool brakes : {false, true}) {
    assists::MotionEstimator motion;
    for (int i = 0; i < 12000; ++i) {
      const double time_s = kStep * i, speed_mps = 5.0 * std::cos(time_s);
      assists::AssistInput input;
      input.wheel_radps.fill(speed_mps / car.rolling_radius_m);
      input.forward_mps2 = -5.0 * std::sin(time_s);
      input.is_braking = brakes;
      motion.Step(car, input, {}, kStep);
      ASSERT_NEAR(motion.speed_mps(), speed_mps, 0.01) << time_s << " s";
      ASSERT_NEAR(motion.GroundSpeed(car, input, 3), speed_mps, 0.01) << time_s << " s";
    }
  }
}

struct Dwell {
  double after_1s = 0.0, after_1_75s = 0.0;  // yaw rate over its peak after the steering has gone over zero
  double aside_m = 0.0;                      // 1.07 s after the beginning
};

// UN R140, annex 3: 80 km/h, coasting, one sine of 0.7 Hz that dwells for half a second at its second peak.
Dwell SineWithDwell(VehicleModel& car, double amplitude_rad) {
  SplitRoad road(1.0, 1.0);
  EXPECT_TRUE(car.Initialise({.speed_mps = 80.0 * kKmh}, road).ok());
  constexpr double kTurn_s = 1.0 / 0.7, kEnd_s = kTurn_s + 0.5;
  Controls controls = Neutral();
  Dwell dwell;
  double peak = 0.0;
  for (int i = 0; i <= static_cast<int>((kEnd_s + 1.75) / kStep); ++i) {
    const double time_s = kStep * i, in_sine_s = time_s < 0.75 * kTurn_s + 0.5 ? std::min(time_s, 0.75 * kTurn_s)
                                                                               : std::min(time_s - 0.5, kTurn_s);
    controls.steering_wheel_rad = amplitude_rad * std::sin(2.0 * 180.0 * kDegree * in_sine_s / kTurn_s);
    car.Step(controls, road, kStep);
    const double yaw = car.state().w_WB_B.z();
    if (time_s > 0.5 * kTurn_s && time_s < kEnd_s) peak = std::max(peak, -yaw);
    if (i == 1070) dwell.aside_m = car.state().p_WB_W.y();
    if (i == static_cast<int>((kEnd_s + 1.0) / kStep)) dwell.after_1s = std::fabs(yaw) / peak;
    if (i == static_cast<int>((kEnd_s + 1.75) / kStep)) dwell.after_1_75s = std::fabs(yaw) / peak;
  }
  return dwell;
}

// The angle at which the car steadily takes 0.3 g at 80 km/h, A.
double SlowSteerAngle(VehicleModel& car) {
  SplitRoad road(1.0, 1.0);
  EXPECT_TRUE(car.Initialise({.speed_mps = 80.0 * kKmh}, road).ok());
  Controls controls;
  double integral = 0.0;
  while (car.state().w_WB_B.z() * car.state().speed_mps() < 0.3 * 9.81) {
    const double off = 80.0 * kKmh - car.state().speed_mps();
    integral += 0.2 * off * kStep;
    controls.throttle = std::clamp(0.3 * off + integral, 0.0, 1.0);
    controls.steering_wheel_rad += 13.5 * kDegree * kStep;
    car.Step(controls, road, kStep);
    if (controls.steering_wheel_rad > 3.0) break;
  }
  return controls.steering_wheel_rad;
}

// At 6.5 A, or 270 degrees where that is more and 300 at most: at most 35 % of the peak yaw rate 1.00 s after the
// steering's end and 20 % after 1.75 s, and at least 1.83 m aside. Without the controller the car fails.
TEST_P(AssistsOf, StabilityControlPassesTheSineWithDwell) {
  const auto with = MakeWith(GetParam(), kAll), without = MakeWith(GetParam(), kNone);
  const double a_rad = SlowSteerAngle(*without);
  const double most_rad = std::min(std::max(6.5 * a_rad, 270.0 * kDegree), 300.0 * kDegree);
  for (const double amplitude_rad : {5.0 * a_rad, most_rad}) {
    SCOPED_TRACE(amplitude_rad / kDegree);
    const Dwell dwell = SineWithDwell(*with, amplitude_rad);
    EXPECT_LT(dwell.after_1s, 0.35);
    EXPECT_LT(dwell.after_1_75s, 0.20);
    EXPECT_GT(dwell.aside_m, 1.83);
  }
  const Dwell most = SineWithDwell(*with, most_rad);
  Got("1_s", 100.0 * most.after_1s, " %");
  Got("1.75_s", 100.0 * most.after_1_75s, " %");
  Got("aside", most.aside_m, " m");
  const Dwell spun = SineWithDwell(*without, most_rad);
  EXPECT_GT(std::max(spun.after_1s / 0.35, spun.after_1_75s / 0.20), 1.0);
}

// Steps of steer to 4 m/s² at 100 km/h and to 5 m/s² at 50 km/h: the cars understeer by 1.3 to 1.8 deg/g, none is off.
TEST_P(AssistsOf, LeaveACarAloneThatTurnsAsItsWheelsSay) {
  const auto with = MakeWith(GetParam(), kAll), without = MakeWith(GetParam(), kNone);
  SplitRoad road(1.0, 1.0);
  for (const auto& [speed_kmh, angle_rad] : {std::pair{100.0, 0.4}, std::pair{50.0, 1.2}}) {
    for (VehicleModel* car : {with.get(), without.get()}) {
      ASSERT_TRUE(car->Initialise({.speed_mps = speed_kmh * kKmh}, road).ok());
      Controls controls = Neutral();
      for (int i = 0; i < 2000; ++i) {
        controls.steering_wheel_rad = std::min(angle_rad, 4.0 * kStep * i);
        car->Step(controls, road, kStep);
      }
    }
    EXPECT_GT(without->state().w_WB_B.z(), 0.12) << speed_kmh;
    EXPECT_EQ(with->state().p_WB_W, without->state().p_WB_W) << speed_kmh;
    EXPECT_EQ(with->state().w_WB_B, without->state().w_WB_B) << speed_kmh;
  }
}

TEST_P(AssistsOf, AreInTheSnapshot) {
  const auto first = MakeWith(GetParam(), kAll), second = MakeWith(GetParam(), kAll);
  SplitRoad road(1.0, 0.3);
  ASSERT_TRUE(first->Initialise({.speed_mps = 20.0}, road).ok());
  ASSERT_TRUE(second->Initialise({.speed_mps = 3.0}, road).ok());
  Controls controls = Neutral(1.0);
  controls.steering_wheel_rad = 0.5;
  DriveFor(*first, road, controls, 0.4);
  ExpectTheSameBitsFromASnapshot(*first, *second, 500,
                                 [&](VehicleModel& car, int) { car.Step(controls, road, kStep); });
}

INSTANTIATE_TEST_SUITE_P(Models, AssistsOf, ::testing::Values(kBicycle, kOde, kMultibody), NameOf);

}  // namespace
}  // namespace rodeira::dynamics
