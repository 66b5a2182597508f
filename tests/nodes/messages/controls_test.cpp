// SPDX-License-Identifier: Apache-2.0
#include "nodes/messages/controls.hpp"

#include <gtest/gtest.h>

#include "nodes/messages/vectors.hpp"

namespace rodeira::nodes {
namespace {

TEST(ControlsMessage, EveryMemberSurvivesTheRoundTrip) {
  dynamics::Controls controls;
  controls.steering_wheel_rad = -1.25;
  controls.throttle = 0.25;
  controls.brake = 0.5;
  controls.clutch = 0.75;
  controls.handbrake = 1.0;
  controls.gear = 3;
  controls.gearbox = dynamics::GearboxMode::kManual;
  controls.starter = true;
  const dynamics::Controls read = FromMessage(ToMessage(controls));
  EXPECT_EQ(read.steering_wheel_rad, controls.steering_wheel_rad);
  EXPECT_EQ(read.throttle, controls.throttle);
  EXPECT_EQ(read.brake, controls.brake);
  EXPECT_EQ(read.clutch, controls.clutch);
  EXPECT_EQ(read.handbrake, controls.handbrake);
  EXPECT_EQ(read.gear, controls.gear);
  EXPECT_EQ(read.gearbox, controls.gearbox);
  EXPECT_EQ(read.starter, controls.starter);
}

TEST(ControlsMessage, WhatNoDriverCanDoIsClamped) {
  msg::Controls message;
  message.throttle(7.0);
  message.brake(-1.0);
  EXPECT_EQ(FromMessage(message).throttle, 1.0);
  EXPECT_EQ(FromMessage(message).brake, 0.0);
}

TEST(VectorMessages, KeepTheirNumbers) {
  const Eigen::Vector3d v(0.1, -2.5e7, 3.0e-9);
  EXPECT_EQ(FromMessage(ToMessage(v)), v);
  const Eigen::Quaterniond q(0.1, 0.2, -0.3, 0.4);
  EXPECT_EQ(FromMessage(ToMessage(q)).coeffs(), q.coeffs());
  EXPECT_EQ(ToMessage(q).w(), 0.1);
  EXPECT_EQ(ToMessage(q).z(), 0.4);
}

}  // namespace
}  // namespace rodeira::nodes
