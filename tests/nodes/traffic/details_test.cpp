// SPDX-License-Identifier: Apache-2.0
// What the traffic says of its drivers and engines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

// Ten times a second of each car that the traffic state of that step has, empty between. The engine turns as the wheels
// and the gears of MOTORS say; no driver brakes and pushes at once; the fuel used is the integral of the flow; the
// point that is steered for lies ahead, 0.7 s before the rear axle.
TEST(TrafficDetails, AreSaidTenTimesASecondAndAgreeWithTheMotion) {
  const std::string text =
      "rodeira: launch/1\nworld: ../configs/worlds/lights.yaml\nseed: 5\nnodes:\n  road: {kind: road}\n"
      "  others: {kind: traffic, config: {vehicles: 20}}\n";
  auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/details.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  struct Burnt {
    std::uint32_t trip;
    double first_kg, last_kg, rate_kgps, sum_kg;
  };
  const std::map<int, double> gears{{1, 3.46}, {2, 1.96}, {3, 1.39}, {4, 1.03}, {5, 0.85}};
  constexpr double kFinal = 4.19, kIdle_radps = 89.0, kRolls = 0.97;  // of the wheel's radius
  std::map<lockstep::Step, msg::TrafficState> states;
  std::map<lockstep::Step, msg::TrafficDetails> details;
  lockstep::InProcessSettings run;
  run.last_step = 40'000;
  run.on_sample = [&](const lockstep::Sample& sample) {
    const auto& topic = launch.value().roster().source(sample.source()).topic;
    if (topic == idl::topics::kTrafficState)
      states[sample.valid()] = idl::Decode<msg::TrafficState>(*sample.payload).value();
    if (topic == idl::topics::kTrafficDetails)
      details[sample.valid()] = idl::Decode<msg::TrafficDetails>(*sample.payload).value();
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), run);
  ASSERT_TRUE(outcome.ok) << outcome.fault;
  ASSERT_EQ(details.size(), states.size());
  std::map<std::uint32_t, Burnt> burnt;
  int told = 0, geared = 0, pushed = 0, braked = 0, compared = 0;
  for (const auto& [step, message] : details) {
    if (step % 100 != 0) {
      ASSERT_TRUE(message.agents().empty()) << step;
      continue;
    }
    ASSERT_EQ(message.agents().size(), states[step].agents().size()) << step;
    for (std::size_t i = 0; i < message.agents().size(); ++i) {
      const msg::TrafficDetail& d = message.agents()[i];
      const msg::TrafficAgent& a = states[step].agents()[i];
      ASSERT_EQ(d.id(), a.id());
      ++told;
      if (d.clutch() == 0.0F) {
        const double turns =
            a.speed_mps() / (kRolls * static_cast<double>(a.wheel_radius_m())) * gears.at(d.gear()) * kFinal;
        EXPECT_NEAR(static_cast<double>(d.engine_speed_radps()), turns, 1e-4 * turns) << d.id() << " at " << step;
        EXPECT_GE(turns, 0.999 * kIdle_radps);
        ++geared;
      }
      EXPECT_FALSE(d.throttle() > 0.0F && d.brake() > 0.0F) << d.id() << " at " << step;
      if (d.throttle() > 0.0F) ++pushed;
      if (d.brake() > 0.0F && a.speed_mps() > 1.0) {
        ++braked;
        EXPECT_LT(a.acceleration_mps2(), 0.0F);
      }
      const double heading = static_cast<double>(a.heading_rad());
      const double ahead_x = static_cast<double>(d.target_x_m()) - a.position_x_m(),
                   ahead_y = static_cast<double>(d.target_y_m()) - a.position_y_m();
      const double steers = std::max({3.0, static_cast<double>(a.wheelbase_m()), 0.7 * a.speed_mps()}) -
                            0.5 * static_cast<double>(a.wheelbase_m());
      EXPECT_NEAR(std::hypot(ahead_x, ahead_y), steers, 0.05 * steers + 0.3) << "on bends the chord is shorter";
      EXPECT_GT(std::cos(heading) * ahead_x + std::sin(heading) * ahead_y, 0.0);
      EXPECT_GT(std::cos(static_cast<double>(d.path_heading_rad()) - heading), 0.9) << "the car follows it";
      const double sees = std::min(200.0, a.speed_mps() * a.speed_mps() / 3.0 + 3.0 * a.speed_mps() + 60.0) +
                          0.5 * static_cast<double>(a.length_m());
      EXPECT_LT(std::hypot(static_cast<double>(d.look_ahead_x_m()) - a.position_x_m(),
                           static_cast<double>(d.look_ahead_y_m()) - a.position_y_m()),
                sees + 0.3);
      const auto used = static_cast<double>(d.fuel_used_kg()), rate = static_cast<double>(d.fuel_rate_kgps());
      const auto [at, fresh] = burnt.try_emplace(d.id(), Burnt{a.trip(), used, used, rate, 0.0});
      if (at->second.trip != a.trip()) at->second = {a.trip(), used, used, rate, 0.0};
      if (fresh) continue;
      at->second.sum_kg += 0.05 * (at->second.rate_kgps + rate);
      at->second.last_kg = used, at->second.rate_kgps = rate;
    }
  }
  for (const auto& [id, fuel] : burnt) {
    if (fuel.sum_kg < 2e-3) continue;
    EXPECT_NEAR(fuel.last_kg - fuel.first_kg, fuel.sum_kg, 0.03 * fuel.sum_kg)
        << id << ": a rate that jumps between two looks";
    ++compared;
  }
  EXPECT_GT(told, 4000);
  EXPECT_GT(geared, 1000);
  EXPECT_GT(pushed, 500);
  EXPECT_GT(braked, 100);
  EXPECT_GT(compared, 5);
}

}  // namespace
}  // namespace rodeira
