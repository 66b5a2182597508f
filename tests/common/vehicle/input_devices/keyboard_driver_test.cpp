// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/input_devices/keyboard_driver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/random.hpp"

namespace rodeira::input_devices {
namespace {

KeyboardSettings Settings() {
  KeyboardSettings s;
  s.lock_rad = 8.0;
  s.half_lock_speed_mps = 6.0;
  s.turn_s = 1.25;
  s.centre_s = 0.5;
  s.throttle = {0.5, 0.25, 1.0};
  s.brake = {0.4, 0.2, 0.8};
  return s;
}

KeyboardInput Holding(std::initializer_list<Action> actions, double speed_mps = 0.0) {
  KeyboardInput input;
  for (const Action action : actions) input.held[static_cast<std::size_t>(action)] = true;
  input.speed_mps = speed_mps;
  return input;
}

double Lock(const KeyboardSettings& s, double v) {
  return s.lock_rad / (1.0 + v * v / (s.half_lock_speed_mps * s.half_lock_speed_mps));
}

// While a key is held the angle is lock(v) · t / turn_s up to lock(v), whatever the step.
TEST(KeyboardDriver, AHeldKeyTurnsTheWheelAtItsRateToTheLockOfTheSpeed) {
  const KeyboardSettings s = Settings();
  for (const double v : {0.0, 6.0, 20.0, 35.0, -6.0}) {
    for (const double dt : {0.001, 0.01, 0.03}) {
      KeyboardDriver driver(s);
      double t = 0.0;
      for (int i = 0; i < 100; ++i) {
        const double angle = driver.Step(Holding({Action::kSteerLeft}, v), dt).steering_wheel_rad;
        t += dt;
        EXPECT_NEAR(angle, std::min(1.0, t / s.turn_s) * Lock(s, v), 1e-12 * s.lock_rad * 100)
            << v << " m/s, " << t << " s";
      }
    }
  }
  EXPECT_DOUBLE_EQ(Lock(s, 6.0), 4.0) << "half of it at half_lock_speed";
}

TEST(KeyboardDriver, RightIsNegativeAndBothTogetherAreNeither) {
  KeyboardDriver driver(Settings());
  EXPECT_LT(driver.Step(Holding({Action::kSteerRight}), 0.01).steering_wheel_rad, 0.0);
  for (int i = 0; i < 100; ++i) driver.Step(Holding({Action::kSteerRight, Action::kSteerLeft}), 0.01);
  EXPECT_EQ(driver.controls().steering_wheel_rad, 0.0);
}

TEST(KeyboardDriver, LetGoTheWheelComesBackAtItsRateAndStandsAtExactlyZero) {
  const KeyboardSettings s = Settings();
  const double v = 18.0;
  KeyboardDriver driver(s);
  for (int i = 0; i < 200; ++i) driver.Step(Holding({Action::kSteerLeft}, v), 0.01);
  ASSERT_DOUBLE_EQ(driver.controls().steering_wheel_rad, Lock(s, v));
  for (int i = 1; i <= 49; ++i) {
    const double angle = driver.Step(Holding({}, v), 0.01).steering_wheel_rad;
    EXPECT_NEAR(angle, Lock(s, v) * (1.0 - i * 0.01 / s.centre_s), 1e-12);
  }
  for (int i = 0; i < 5; ++i) driver.Step(Holding({}, v), 0.01);
  EXPECT_EQ(driver.controls().steering_wheel_rad, 0.0);
}

// From the right lock to the left key: first back at the centring rate, then out at the turning rate, also within one
// step.
TEST(KeyboardDriver, ChangingSidesPassesTheMiddleWithoutLosingTime) {
  const KeyboardSettings s = Settings();
  for (const double dt : {0.002, 0.04}) {
    KeyboardDriver driver(s);
    for (double t = 0.0; t < 2.0; t += 0.01) driver.Step(Holding({Action::kSteerRight}, 12.0), 0.01);
    for (int i = 1; i * dt < 1.5; ++i) {
      const double t = i * dt;
      const double lock = Lock(s, 12.0);
      const double expected = t < s.centre_s ? -lock * (1.0 - t / s.centre_s) : lock * (t - s.centre_s) / s.turn_s;
      EXPECT_NEAR(driver.Step(Holding({Action::kSteerLeft}, 12.0), dt).steering_wheel_rad, expected, 1e-11) << t;
    }
  }
}

TEST(KeyboardDriver, AWheelBeyondTheLockOfAHigherSpeedGivesWayAtTheCentringRate) {
  const KeyboardSettings s = Settings();
  KeyboardDriver driver(s);
  for (int i = 0; i < 200; ++i) driver.Step(Holding({Action::kSteerLeft}, 0.0), 0.01);
  const double lock = Lock(s, 30.0);
  EXPECT_NEAR(driver.Step(Holding({Action::kSteerLeft}, 30.0), 0.01).steering_wheel_rad,
              s.lock_rad - 0.01 * lock / s.centre_s, 1e-12);
  for (int i = 0; i < 5000; ++i) driver.Step(Holding({Action::kSteerLeft}, 30.0), 0.01);
  EXPECT_DOUBLE_EQ(driver.controls().steering_wheel_rad, lock);
}

TEST(KeyboardDriver, PedalsMoveAtTheirRates) {
  KeyboardDriver driver(Settings());
  const KeyboardInput both = Holding({Action::kThrottle, Action::kBrake});
  for (int i = 1; i <= 100; ++i) {
    const auto controls = driver.Step(both, 0.01);
    EXPECT_NEAR(controls.throttle, std::min(1.0, i * 0.01 / 0.5), 1e-12);
    EXPECT_NEAR(controls.brake, std::min(0.8, i * 0.01 / 0.4), 1e-12);
  }
  for (int i = 1; i <= 50; ++i) {
    const auto controls = driver.Step(Holding({}), 0.01);
    EXPECT_NEAR(controls.throttle, std::max(0.0, 1.0 - i * 0.01 / 0.25), 1e-12);
    EXPECT_NEAR(controls.brake, std::max(0.0, 0.8 - i * 0.01 / 0.2), 1e-12);
  }
  const auto held = driver.Step(Holding({Action::kHandbrake, Action::kStarter}), 0.01);
  EXPECT_EQ(held.handbrake, 1.0);
  EXPECT_TRUE(held.starter);
  const auto released = driver.Step(Holding({}), 0.01);
  EXPECT_EQ(released.handbrake, 0.0);
  EXPECT_FALSE(released.starter);
}

KeyboardInput Drawn(std::uint64_t step) {
  KeyboardInput input;
  for (std::size_t a = 0; a < kActions; ++a) input.held[a] = base::RandomUniform({3, step / 7, a}) < 0.4;
  input.lever.up = base::RandomUniform({4, step}) < 0.1 ? 1 : 0;
  input.lever.down = base::RandomUniform({5, step}) < 0.1 ? 1 : 0;
  input.lever.mode = base::RandomUniform({6, step}) < 0.05 ? 1 : 0;
  input.lever.engaged = 2;
  input.speed_mps = base::RandomUniform({7, step / 50}, -5.0, 40.0);
  return input;
}

base::Digest DigestOf(const KeyboardDriver& driver) {
  base::StateWriter out;
  driver.Save(out);
  return out.digest();
}

TEST(KeyboardDriver, RestoredAnywhereItGoesOnWithTheSameBits) {
  KeyboardDriver whole(Settings());
  for (std::uint64_t step = 0; step < 600; ++step) {
    if (step % 97 == 13) {
      base::StateWriter out;
      whole.Save(out);
      KeyboardDriver restored(Settings());
      base::StateReader in(out.bytes());
      restored.Restore(in);
      ASSERT_TRUE(in.Finish().ok());
      KeyboardDriver copy = whole;
      for (std::uint64_t later = step; later < step + 40; ++later) {
        copy.Step(Drawn(later), 0.01);
        restored.Step(Drawn(later), 0.01);
        ASSERT_EQ(DigestOf(copy), DigestOf(restored)) << later;
      }
    }
    const auto controls = whole.Step(Drawn(step), 0.01);
    EXPECT_LE(std::fabs(controls.steering_wheel_rad), 8.0);
    EXPECT_TRUE(controls.throttle >= 0.0 && controls.throttle <= 1.0 && controls.brake >= 0.0 && controls.brake <= 0.8);
  }
}

}  // namespace
}  // namespace rodeira::input_devices
