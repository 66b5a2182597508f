// SPDX-License-Identifier: Apache-2.0
// A car of traffic is hit by the driver's: it takes what the collisions say.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/traffic/state/traffic_settings.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

using lockstep::Step;
namespace topics = idl::topics;

// The momentum that it has is the one that the driver's car has lost to it, but for what its sliding wheels take
// meanwhile; then it slides to rest as far as friction says, and stays.
TEST(CrashedCar, TakesTheImpulseOfTheCollisionAndStays) {
  const std::filesystem::path path = std::filesystem::path(SourceDir()) / "tests/data/crash_traffic.yaml";
  auto launch = launch::Launch::Load(path, {{"nodes.recorder.kind", "none"}});
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  struct At {
    Eigen::Vector2d p;
    double speed;
  };
  std::map<Step, std::map<std::uint32_t, At>> seen;
  std::map<Step, Eigen::Vector2d> impulses;  // on the first one that is hit
  std::optional<std::uint32_t> hit;
  lockstep::InProcessSettings settings;
  settings.last_step = 16'000;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    const std::string& topic = launch.value().roster().source(sample.source()).topic;
    if (topic == topics::kTrafficState) {
      const auto state = idl::Decode<msg::TrafficState>(*sample.payload).value();
      for (const auto& agent : state.agents())
        seen[sample.valid()][agent.id()] = {{agent.position_x_m(), agent.position_y_m()}, agent.speed_mps()};
    } else if (topic == topics::kCollisions) {
      const auto touched = idl::Decode<msg::Collisions>(*sample.payload).value();
      for (const auto& collision : touched.contacts()) {
        if (collision.partner_kind() != 1u) continue;
        if (!hit) hit = collision.partner_id();
        if (collision.partner_id() != *hit) continue;
        impulses.try_emplace(sample.valid(), Eigen::Vector2d::Zero()).first->second -=
            Eigen::Vector2d(collision.impulse_x_newton_s(), collision.impulse_y_newton_s());
      }
    }
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
  ASSERT_TRUE(outcome.ok) << outcome.fault;
  ASSERT_TRUE(hit.has_value());
  traffic::TrafficSettings drivers;
  drivers.seed = 3;
  const double mass = traffic::TraitsOf(drivers, *hit).mass_kg;
  const Step first = impulses.begin()->first;
  const auto place = [&](Step step) { return seen.at(step).at(*hit).p; };
  const Step before = first / 10 * 10;
  // Velocity by the way of a period, against all impulses taken until then: the wheels take at most mu m g t.
  Eigen::Vector2d taken = Eigen::Vector2d::Zero();
  int compared = 0;
  for (Step step = before; step < before + 60; step += 10) {
    for (Step k = step - 9; k <= step; ++k) {
      const auto at = impulses.find(k);
      if (at != impulses.end()) taken += at->second;
    }
    const Eigen::Vector2d v = (place(step + 10) - place(step)) / 0.01;
    const double slid_s = 1e-3 * static_cast<double>(step + 10 - before);
    EXPECT_NEAR((mass * v - taken).norm(), 0.0, 0.7 * 9.81 * mass * slid_s + 1e-6) << step;
    compared += taken.norm() > 500.0;
  }
  EXPECT_GE(compared, 2);
  EXPECT_GT((place(16'000) - place(before)).norm(), 0.2);
  EXPECT_EQ(seen.at(16'000).at(*hit).speed, 0.0);
  EXPECT_EQ((place(16'000) - place(15'000)).norm(), 0.0);
}

}  // namespace
}  // namespace rodeira
