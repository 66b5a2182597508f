// SPDX-License-Identifier: Apache-2.0
// From a run's messages to what is drawn.
#include "nodes/view/run_connection/from_wire.hpp"

#include <gtest/gtest.h>

#include "common/runtime/launch/launch.hpp"
#include "tests/nodes/view/fake_run.hpp"

namespace rodeira::nodes {
namespace {

// A car drives north at 20 m/s. What its driver steers for was said at 0.1 s, when the car was at y = 2: 3 m before it
// and 1 m to its left. That is where it is drawn until it is said again, while the point up to which the driver looks
// stays where it was.
TEST(FromWire, WhatIsHeldOfADriverGoesOnWithTheCar) {
  const auto launch = launch::Launch::Parse(LaunchText("{window: never}"), "fake.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  const lockstep::Roster& roster = launch.value().roster();
  msg::TrafficDetails details;
  details.header().time_ns(100'000'000);
  msg::TrafficDetail detail;
  detail.id(7);
  detail.target_x_m(-1.0F);
  detail.target_y_m(5.0F);
  detail.path_heading_rad(1.8F);
  detail.look_ahead_x_m(4.0F);
  detail.look_ahead_y_m(60.0F);
  details.agents().push_back(detail);
  for (const std::int64_t milliseconds : {100, 130, 190}) {
    msg::TrafficState state;
    msg::TrafficAgent agent;
    agent.id(7);
    agent.speed_mps(20.0);
    agent.heading_rad(1.5707964F);
    agent.position_y_m(0.02 * static_cast<double>(milliseconds));
    state.agents().push_back(agent);
    NewestSamples newest;
    for (lockstep::SourceIndex s = 0; s < roster.sources().size(); ++s) {
      if (roster.source(s).topic == idl::topics::kTrafficState)
        newest[s] = std::make_shared<const base::Bytes>(idl::Encode(state));
      if (roster.source(s).topic == idl::topics::kTrafficDetails)
        newest[s] = std::make_shared<const base::Bytes>(idl::Encode(details));
    }
    ASSERT_EQ(newest.size(), 2u);
    const auto moment = MakeMoment(roster, milliseconds, newest);
    ASSERT_TRUE(moment.ok()) << moment.error().Text();
    ASSERT_EQ(moment.value().agents.size(), 1u);
    ASSERT_TRUE(moment.value().agents[0].detail);
    const scene::AgentDetail& said = *moment.value().agents[0].detail;
    EXPECT_LT((said.target_B - Eigen::Vector2d(3.0, 1.0)).norm(), 1e-5)
        << said.target_B.transpose() << " at " << milliseconds << " ms";
    EXPECT_NEAR(said.path_turn_rad, 1.8 - 1.5707963, 1e-5);
    EXPECT_EQ(said.look_ahead_W, Eigen::Vector2d(4.0, 60.0));
  }
}

}  // namespace
}  // namespace rodeira::nodes
