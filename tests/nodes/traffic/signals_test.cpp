// SPDX-License-Identifier: Apache-2.0
// What traffic publishes of a world's lights, and the autopilot that sees nothing else of them.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/world/network/lights.hpp"
#include "common/world/road/world.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

using lockstep::Step;
namespace topics = idl::topics;

const std::filesystem::path kConfigs = std::filesystem::path(SourceDir()) / "configs";

std::string Text(const std::string& world, int vehicles) {
  return "rodeira: launch/1\nworld: ../configs/worlds/" + world +
         ".yaml\nseed: 5\nnodes:\n  road: {kind: road}\n"
         "  driver: {kind: input, config: {source: autopilot, driver: ../configs/drivers/default.yaml, vehicle: "
         "../configs/vehicles/default.yaml}}\n"
         "  ego: {kind: vehicle, config: {vehicle: ../configs/vehicles/default.yaml}}\n"
         "  others: {kind: traffic, config: {vehicles: " +
         std::to_string(vehicles) + "}}\n";
}

template <class Observe>
void Drive(const std::string& text, Step last, const Observe& look) {
  auto launch = launch::Launch::Parse(text, std::filesystem::path(SourceDir()) / "launch/signals.yaml");
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  lockstep::InProcessSettings settings;
  settings.last_step = last;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    look(launch.value().roster().source(sample.source()).topic, sample);
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
  EXPECT_TRUE(outcome.ok) << outcome.fault;
}

// Each sample says what the program of the world file says for its time. The autopilot comes to the line at red, waits
// before it, and passes at green.
TEST(Signals, AreTheProgramOfTheWorldAndTheAutopilotObeysThem) {
  const auto world = road::World::Load(kConfigs / "worlds/lights.yaml").value();
  const auto controllers = world->network()->controllers();
  ASSERT_EQ(controllers.size(), 2u);
  std::uint32_t main = 2;
  for (std::uint32_t i = 0; i < 2; ++i) {
    if (controllers[i].id.ends_with("main")) main = i;
  }
  ASSERT_LT(main, 2u);
  double line_x = -1e9;  // of the light for traffic from the west
  for (const network::Road& road : world->network()->roads()) {
    for (const network::Signal& signal : road.spec().signals) {
      const Eigen::Vector3d at = road.Surface(signal.s_m, 0.0).p_W;
      if (signal.dynamic && signal.orientation == "+" && std::fabs(at.y()) < 1.0) line_x = at.x();
    }
  }
  ASSERT_GT(line_x, -30.0);
  std::map<Step, std::uint32_t> shown;  // on the main street
  int samples = 0;
  std::optional<Step> passed;
  double slowest_mps = 1e9, front_at_30_s = -1e9;
  Drive(Text("lights", 0), 42'000, [&](const std::string& topic, const lockstep::Sample& sample) {
    if (topic == topics::kSignalsState) {
      const auto signals = idl::Decode<msg::SignalsState>(*sample.payload).value();
      ASSERT_EQ(signals.groups().size(), 2u);
      for (std::uint32_t i = 0; i < 2; ++i) {
        ASSERT_EQ(signals.groups()[i].controller(), i);
        const auto colour = network::ColourAt(*controllers[i].times, sample.valid() * 1'000'000);
        ASSERT_EQ(signals.groups()[i].colour(), static_cast<std::uint32_t>(colour)) << sample.valid();
      }
      shown[sample.valid()] = signals.groups()[main].colour();
      ++samples;
    } else if (topic == topics::kVehicleState) {
      const auto car = idl::Decode<msg::VehicleState>(*sample.payload).value();
      const double front = car.position_w_m().x() + static_cast<double>(car.front_m());
      if (front > line_x && !passed) passed = sample.valid();
      if (sample.valid() == 30'000) front_at_30_s = front;
      if (sample.valid() > 20'000 && sample.valid() <= 30'000)
        slowest_mps = std::min(slowest_mps, car.velocity_w_mps().x());
    }
  });
  EXPECT_EQ(samples, 4202);  // the last one is valid after the end
  EXPECT_EQ(shown.at(29'990), static_cast<std::uint32_t>(network::LightColour::kRedAmber));
  EXPECT_EQ(shown.at(30'000), static_cast<std::uint32_t>(network::LightColour::kGreen));
  EXPECT_LT(slowest_mps, 6.0);  // it has braked for the red light …
  EXPECT_LT(front_at_30_s, line_x);
  ASSERT_TRUE(passed.has_value());
  EXPECT_GT(*passed, 30'000);  // … and passed at green
  EXPECT_LT(*passed, 37'000);
}

// A world without lights: one empty sample a period.
TEST(Signals, AWorldWithoutLightsHasNone) {
  int samples = 0;
  Drive(Text("n222", 2), 500, [&](const std::string& topic, const lockstep::Sample& sample) {
    if (topic != topics::kSignalsState) return;
    ++samples;
    EXPECT_TRUE(idl::Decode<msg::SignalsState>(*sample.payload).value().groups().empty());
  });
  EXPECT_EQ(samples, 52);
}

}  // namespace
}  // namespace rodeira
