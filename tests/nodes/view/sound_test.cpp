// SPDX-License-Identifier: Apache-2.0
// What a picture's person hears, and the PC's sound or the lack of it.
#include <gtest/gtest.h>

#include <cstdlib>

#include "nodes/view/run_connection/from_wire.hpp"
#include "nodes/view/sound/heard.hpp"
#include "nodes/view/sound/speaker.hpp"

namespace rodeira::nodes {
namespace {

scene::SceneSnapshot Among() {
  scene::SceneSnapshot moment;
  scene::CarPose car;
  car.id = 3;
  car.q_WB = scene::Attitude(0.7, 0.0, 0.0);
  car.engine_rpm = 2400.0;
  car.throttle = 0.6;
  car.speed_mps = 12.0;
  moment.cars.push_back(car);
  for (int i = 0; i < 7; ++i) {  // one after the other to the left, 8 m apart
    scene::AgentPose agent;
    agent.id = static_cast<std::uint64_t>(i);
    agent.p_WB_W = car.q_WB * Eigen::Vector3d(0.0, 8.0 * (i + 1), 0.0);
    agent.q_WB = car.q_WB;
    agent.speed_mps = 10.0;
    moment.agents.push_back(agent);
  }
  return moment;
}

TEST(Heard, ItsOwnCarAndTheFourNearest) {
  const sound::Heard heard = HeardBy(Among(), 0, 0.5);
  EXPECT_EQ(heard.own.engine_rpm, 2400.0);
  EXPECT_EQ(heard.own.load, 0.6);
  EXPECT_EQ(heard.own.gain, 1.0);
  EXPECT_EQ(heard.volume, 0.5);
  ASSERT_EQ(heard.others.size(), 4u);
  double before = 1.0;
  for (std::uint64_t id = 0; id < 4; ++id) {
    ASSERT_TRUE(heard.others.contains(id));
    EXPECT_NEAR(heard.others.at(id).pan, -1.0, 1e-9) << "to the left";
    EXPECT_LT(heard.others.at(id).gain, before);
    before = heard.others.at(id).gain;
  }
}

TEST(Heard, ADriversHornIsHeardInsideAndByOthers) {
  scene::SceneSnapshot moment = Among();
  moment.cars[0].horn = true;
  EXPECT_EQ(HeardBy(moment, 0, 1.0).own.horn, 1.0);
  const sound::Heard outside = HeardBy(moment, 1, 1.0);
  EXPECT_EQ(outside.own.horn, 0.0);
  EXPECT_EQ(outside.others.rbegin()->second.horn, 1.0);
}

TEST(Heard, WithoutAListenerIsSilenceAndATrafficCarHearsTheOthers) {
  EXPECT_EQ(HeardBy(Among(), 99, 1.0).own.engine_rpm, 0.0);
  EXPECT_EQ(HeardBy({}, 0, 1.0).others.size(), 0u);
  const sound::Heard heard =
      HeardBy(Among(), 1, 1.0);  // the first of the traffic: the car to its right, the others to its left
  EXPECT_GT(heard.own.engine_rpm, 900.0);
  ASSERT_EQ(heard.others.size(), 4u);
  EXPECT_GT(heard.others.rbegin()->second.pan, 0.9) << "the driver's car";
  EXPECT_LT(heard.others.begin()->second.pan, -0.9);
}

// From the published state: slip beyond the greatest force of a tyre is heard where the car moves, a blow by what no
// tyre can do.
TEST(Heard, WhatSlidesAndWhatStrikesIsReadFromTheState) {
  msg::VehicleState message;
  message.attitude_wb().w(1.0);
  message.velocity_w_mps().x(15.0);
  for (auto& wheel : message.wheels()) wheel.in_contact(1);
  EXPECT_EQ(CarPoseOf(message, 1, 0).sliding, 0.0);
  message.wheels()[2].slip(-1.0F);
  EXPECT_EQ(CarPoseOf(message, 1, 0).sliding, 1.0);
  message.wheels()[2].in_contact(0);
  EXPECT_EQ(CarPoseOf(message, 1, 0).sliding, 0.0) << "in the air";
  message.wheels()[2].in_contact(1);
  message.velocity_w_mps().x(0.0);
  EXPECT_EQ(CarPoseOf(message, 1, 0).sliding, 0.0) << "at rest";
  EXPECT_EQ(CarPoseOf(message, 1, 0).blow, 0.0);
  message.acceleration_w_mps2().x(-10.0F);
  EXPECT_EQ(CarPoseOf(message, 1, 0).blow, 0.0) << "braking";
  message.acceleration_w_mps2().x(-200.0F);
  EXPECT_GT(CarPoseOf(message, 1, 0).blow, 0.9);
}

TEST(Speaker, PlaysWhereThereIsADeviceAndSaysWhereThereIsNone) {
  ::setenv("SDL_AUDIODRIVER", "dummy", 1);
  {
    auto speaker = Speaker::Open();
    ASSERT_TRUE(speaker.ok()) << speaker.error().Text();
    speaker.value()->Play(HeardBy(Among(), 0, 1.0), 0.02);
    EXPECT_GT(speaker.value()->queued_s(), 0.0);
    EXPECT_LE(speaker.value()->queued_s(), 0.06);
  }
  ::setenv("SDL_AUDIODRIVER", "no_such_thing", 1);
  const auto none = Speaker::Open();
  ::unsetenv("SDL_AUDIODRIVER");
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().Text().find("no_such_thing"), std::string::npos) << none.error().Text();
}

}  // namespace
}  // namespace rodeira::nodes
