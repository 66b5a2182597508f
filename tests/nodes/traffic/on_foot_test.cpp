// SPDX-License-Identifier: Apache-2.0
// People on foot as they are published.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

// A scenario calls two: they come, wait, cross and are gone, move as fast as they say, and their legs go as far as they
// do.
TEST(OnFoot, ACalledPedestrianCrosses) {
  constexpr std::uint32_t kPedestrian = 4, kFirst = 2'000'000;
  const std::string text =
      "rodeira: launch/1\nworld: ../configs/worlds/example/world.yaml\nseed: 5\nnodes:\n  road: {kind: road}\n"
      "  others: {kind: traffic, config: {vehicles: 6, pedestrians: {per_hour: 0}}}\n"
      "  story: {kind: scenario, config: {scenario: ../tests/data/somebody_crosses.yaml}}\n";
  auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/on_foot_test.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  struct At {
    double x_m, y_m, heading_rad, spin_rad;
    lockstep::Step step;
  };
  std::map<std::uint32_t, At> before;
  std::map<std::uint32_t, double> gone_m;
  std::size_t last = 0;
  lockstep::InProcessSettings run;
  run.last_step = 60'000;
  run.on_sample = [&](const lockstep::Sample& sample) {
    if (launch.value().roster().source(sample.source()).topic != idl::topics::kTrafficState) return;
    const auto state = idl::Decode<msg::TrafficState>(*sample.payload).value();
    last = 0;
    std::uint32_t id_before = 0;
    for (const msg::TrafficAgent& agent : state.agents()) {
      ASSERT_TRUE(agent.id() > id_before || &agent == &state.agents()[0]);
      id_before = agent.id();
      ASSERT_EQ(agent.kind() == kPedestrian, agent.id() >= kFirst);
      if (agent.kind() != kPedestrian) continue;
      ++last;
      const auto known = before.find(agent.id());
      if (known != before.end()) {
        const double moved =
            std::hypot(agent.position_x_m() - known->second.x_m, agent.position_y_m() - known->second.y_m);
        ASSERT_NEAR(moved, 0.01 * agent.speed_mps(), 1e-9);
        const double rolled =
            std::remainder(static_cast<double>(agent.wheel_spin_rad()) - known->second.spin_rad, 2.0 * M_PI) *
            static_cast<double>(agent.wheel_radius_m());
        ASSERT_NEAR(rolled, moved, 1e-6);
        ASSERT_EQ(static_cast<double>(agent.heading_rad()), known->second.heading_rad);
        gone_m[agent.id()] += moved;
      }
      before[agent.id()] = {agent.position_x_m(), agent.position_y_m(), static_cast<double>(agent.heading_rad()),
                            static_cast<double>(agent.wheel_spin_rad()), sample.valid()};
    }
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), run);
  ASSERT_TRUE(outcome.ok) << outcome.fault;
  ASSERT_EQ(gone_m.size(), 2u);
  for (const auto& [id, way] : gone_m) EXPECT_GT(way, 7.0 + 2.0 * 3.0) << id;
  EXPECT_NEAR(
      std::fabs(std::remainder(before.begin()->second.heading_rad - before.rbegin()->second.heading_rad, 2.0 * M_PI)),
      M_PI, 1e-5);
  EXPECT_EQ(last, 0u);
}

}  // namespace
}  // namespace rodeira
