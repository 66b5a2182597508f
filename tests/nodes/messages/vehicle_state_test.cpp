// SPDX-License-Identifier: Apache-2.0
#include "nodes/messages/vehicle_state.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "common/core/base/random.hpp"

namespace rodeira::nodes {
namespace {

// What instruments read is right to 2^-16 and has no noise in its last bits; what a run goes on from is there to the
// bit.
TEST(VehicleMessage, RoundsWhatIsReadAndNotWhatGoesOn) {
  for (std::uint64_t n = 0; n < 2000; ++n) {
    dynamics::VehicleState state;
    const auto drawn = [n](std::uint64_t which) {
      return base::RandomUniform({n, which}, -1.0, 1.0) * std::pow(10.0, base::RandomUniform({n, which, 1}, -6.0, 6.0));
    };
    state.p_WB_W = {drawn(0), drawn(1), drawn(2)};
    state.engine_speed_radps = drawn(3);
    state.a_WB_W = {drawn(4), drawn(5), drawn(6)};
    state.wheels[1].lateral_N = drawn(7);
    state.wheels[2].spin_rad = drawn(8);
    const msg::VehicleState said = ToMessage(state, {});
    EXPECT_EQ(said.position_w_m().x(), state.p_WB_W.x());
    EXPECT_EQ(said.engine_speed_radps(), state.engine_speed_radps);
    EXPECT_EQ(said.wheels()[2].spin_rad(), static_cast<float>(state.wheels[2].spin_rad))
        << "it grows for as long as one drives";
    for (const auto& [value, read] : {std::pair(state.a_WB_W.y(), said.acceleration_w_mps2().y()),
                                      std::pair(state.wheels[1].lateral_N, said.wheels()[1].lateral_n())}) {
      EXPECT_LE(std::fabs(static_cast<double>(read) - value), std::ldexp(std::fabs(value), -16) * (1.0 + 1e-6));
      EXPECT_EQ(std::bit_cast<std::uint32_t>(read) & 0xFFU, 0u);
    }
  }
  dynamics::VehicleState infinite;
  infinite.drag_N = INFINITY;
  EXPECT_EQ(ToMessage(infinite, {}).drag_n(), INFINITY);
}

// By the bits of vehicle.idl.
TEST(VehicleMessage, LightsFollowTheControls) {
  msg::Controls controls;
  EXPECT_EQ(LightsOf(controls, 1), 0u);
  controls.brake(0.005);
  EXPECT_EQ(LightsOf(controls, 1), 0u) << "a foot that rests on the pedal";
  controls.brake(0.5);
  EXPECT_EQ(LightsOf(controls, 1), 1u);
  EXPECT_EQ(LightsOf(controls, -1), 1u | 8u);
  controls.brake(0.0);
  for (const auto& [indicators, lights] : {std::pair(1u, 2u), std::pair(2u, 4u), std::pair(3u, 6u)}) {
    controls.indicators(indicators);
    EXPECT_EQ(LightsOf(controls, 0), lights);
  }
  controls.indicators(0);
  controls.headlights(1);
  EXPECT_EQ(LightsOf(controls, 1), 16u);
  controls.headlights(2);
  EXPECT_EQ(LightsOf(controls, 1), 32u);
}

}  // namespace
}  // namespace rodeira::nodes
