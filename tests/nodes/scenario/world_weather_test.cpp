// SPDX-License-Identifier: Apache-2.0
// The weather that a world file says: published by the scenario's node from the beginning on, below what the scenario
// itself says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/world/road/world.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira {
namespace {

using lockstep::Step;

// Plane and scenario; the published weather by step.
std::map<Step, msg::WeatherState> WeatherIn(const std::string& world_keys, const std::string& scenario, Step last) {
  const cli::TemporaryFolder folder;
  const auto world = folder.Write("w.yaml", "rodeira: world/2\nname: w\nground: {kind: plane}\n" + world_keys);
  const auto story = folder.Write("story.yaml", "rodeira: scenario/1\n" + scenario);
  auto launch = launch::Launch::Parse(
      "rodeira: launch/1\nworld: " + world.string() +
          "\nnodes:\n  road: {kind: road}\n  story: {kind: scenario, config: {scenario: " + story.string() + "}}\n",
      folder.path() / "launch.yaml");
  EXPECT_TRUE(launch.ok()) << launch.error().Text();
  auto nodes = cli::LocalNodes::Make(launch.value());
  EXPECT_TRUE(nodes.ok()) << nodes.error().Text();
  std::map<Step, msg::WeatherState> published;
  lockstep::InProcessSettings settings;
  settings.last_step = last;
  settings.on_sample = [&](const lockstep::Sample& sample) {
    if (launch.value().roster().source(sample.source()).topic == idl::topics::kWeatherState)
      published[sample.valid()] = idl::Decode<msg::WeatherState>(*sample.payload).value();
  };
  const auto outcome = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
  EXPECT_TRUE(outcome.ok) << outcome.fault;
  return published;
}

constexpr const char* kDusk = "weather: {hour: 19, clouds: 0.8, visibility_m: 5000, rain_mmph: 4, wetness: 0.5}\n";
constexpr const char* kMark = "events: [{at_s: 0.5, name: mark, text: nothing}]\n";

TEST(WorldWeather, HoldsWhereTheScenarioSaysNone) {
  const auto published = WeatherIn(kDusk, kMark, 1000);
  ASSERT_GT(published.size(), 90u);
  for (const auto& [step, now] : published) {
    EXPECT_TRUE(now.hour() == 19.0 && now.clouds() == 0.8 && now.visibility_m() == 5000.0 && now.rain_mmph() == 4.0 &&
                now.wetness() == 0.5)
        << step;
  }
  // A world that says none is fine, as it was.
  const msg::WeatherState usual = WeatherIn("", kMark, 100).begin()->second;
  EXPECT_TRUE(usual.hour() == 13.5 && usual.clouds() == 0.3 && usual.wetness() == 0.0 &&
              usual.visibility_m() == 100000.0);
}

// What the scenario names is the scenario's, from its time on: at the beginning the hour, from 0.5 s on within 0.4 s
// the clouds; the rest stays the world's.
TEST(WorldWeather, TheScenariosOwnStandsAboveIt) {
  const auto published = WeatherIn(kDusk, "weather:\n  - {hour: 8}\n  - {at_s: 0.5, over_s: 0.4, clouds: 0}\n", 1200);
  ASSERT_GT(published.size(), 110u);
  for (const auto& [step, now] : published) {
    const double t = static_cast<double>(step) * 1e-3;
    EXPECT_EQ(now.hour(), 8.0) << step;
    EXPECT_NEAR(now.clouds(), t < 0.5 ? 0.8 : t < 0.9 ? 0.8 * (0.9 - t) / 0.4 : 0.0, 1e-12) << step;
    EXPECT_EQ(now.wetness(), 0.5) << step;
  }
}

TEST(WorldWeather, IsCheckedWithTheWorldAndIsNoAnswerOfIt) {
  const auto of = [](const std::string& keys, int version = 2) {
    return road::World::Parse("rodeira: world/" + std::to_string(version) + "\nname: w\nground: {kind: plane}\n" + keys,
                              "w.yaml");
  };
  EXPECT_EQ(of(kDusk).value()->content_hash(), of("").value()->content_hash());
  EXPECT_THAT(of("weather: {hours: 19}\n").error().Text(),
              testing::HasSubstr("w.yaml:4: unknown key 'weather.hours'; did you mean 'hour'"));
  EXPECT_THAT(of("weather: {hour: 25}\n").error().Text(), testing::HasSubstr("w.yaml:4: 'weather.hour' is 25"));
  EXPECT_THAT(of("weather: {at_s: 3, hour: 2}\n").error().Text(), testing::HasSubstr("unknown key 'weather.at_s'"));
  EXPECT_THAT(of(kDusk, 1).error().Text(), testing::HasSubstr("w.yaml:4: unknown key 'weather'"));
}

}  // namespace
}  // namespace rodeira
