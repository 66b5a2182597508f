// SPDX-License-Identifier: Apache-2.0
// A scenario between processes: its events are recorded at their steps, and the run is the same however it is run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "common/core/base/files.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

class ScenarioRun : public ::testing::Test {
 protected:
  ScenarioRun() { std::filesystem::create_directories(folder_); }
  ~ScenarioRun() override { std::filesystem::remove_all(folder_); }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  static Ended Run(std::vector<std::string> more) {
    more.insert(more.begin(), {Bin("rodeira"), "run", LaunchFile("car_ahead.yaml")});
    return RunCommand(more);
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-story-" + std::to_string(::getpid()));
};

TEST_F(ScenarioRun, IsRecordedAtItsStepsAndTheSameHoweverItRuns) {
  const Ended first = Run({"--for", "8", "--record", Path("a.mcap")});
  ASSERT_EQ(first.status, 0) << first.out;
  const Ended second = Run({"--for", "8", "--record", Path("b.mcap"), "--in-process"});
  ASSERT_EQ(second.status, 0) << second.out;
  EXPECT_EQ(DigestIn(first.out), DigestIn(second.out));
  const auto reader = record::McapReader::Open(Path("a.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.error().Text();
  record::Query query;
  query.channels = std::set<record::ChannelId>{reader.value().ChannelsOf(idl::topics::kScenarioEvents).at(0)};
  auto cursor = reader.value().Messages(query);
  std::map<std::int64_t, std::string> events;
  std::size_t samples = 0;
  for (;;) {
    const auto message = cursor.Next();
    ASSERT_TRUE(message.ok());
    if (!message.value()) break;
    ++samples;
    const auto sample = idl::Decode<msg::ScenarioEvents>(message.value()->data).value();
    for (const auto& event : sample.events())
      events[sample.header().step()] += event.name() + " " + event.argument() + ";";
  }
  EXPECT_EQ(samples, 801u) << "one a period, empty ones too";
  EXPECT_EQ(events, (std::map<std::int64_t, std::string>{{1000, "mark instruction: follow the car in front;"},
                                                         {6000, "traffic.speed ahead;"}}));
}

// From the sample of 1 s on the road is wet: the tyres' friction is that share of what it was, at the vehicle's next
// step; the view draws it, a replay computes it again, and tables have it.
TEST_F(ScenarioRun, TheWeatherIsRecordedAndFeltAtItsStep) {
  const std::string text =
      "rodeira: scenario/1\nweather:\n  - {clouds: 0.5}\n  - {at_s: 1, wetness: 1, rain_mmph: 20}\n";
  ASSERT_TRUE(base::WriteWhole(Path("rain.yaml"), std::string_view(text)).ok());
  const Ended run = RunCommand({Bin("rodeira"), "run", LaunchFile("rain.yaml"), "--for", "2", "--set",
                                "nodes.story.config.scenario=" + Path("rain.yaml"), "--set",
                                "nodes.view.config.window=never", "--record", Path("rain.mcap")});
  ASSERT_EQ(run.status, 0) << run.out;
  const auto reader = record::McapReader::Open(Path("rain.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.error().Text();
  record::Query query;
  const record::ChannelId weather = reader.value().ChannelsOf(idl::topics::kWeatherState).at(0),
                          car = reader.value().ChannelsOf(idl::topics::kVehicleState).at(0);
  query.channels = std::set<record::ChannelId>{weather, car};
  auto cursor = reader.value().Messages(query);
  std::map<std::int64_t, double> wetness, friction;
  for (;;) {
    const auto message = cursor.Next();
    ASSERT_TRUE(message.ok());
    if (!message.value()) break;
    if (message.value()->channel == weather) {
      const auto sample = idl::Decode<msg::WeatherState>(message.value()->data).value();
      wetness[sample.header().step()] = sample.wetness();
      EXPECT_EQ(sample.clouds(), 0.5);
    } else {
      const auto sample = idl::Decode<msg::VehicleState>(message.value()->data).value();
      friction[sample.header().step()] = static_cast<double>(sample.wheels()[0].friction());
    }
  }
  ASSERT_EQ(wetness.size(), 201u);
  EXPECT_EQ(wetness.at(990), 0.0);
  EXPECT_EQ(wetness.at(1000), 1.0);
  EXPECT_GT(friction.at(1000), 0.5);
  EXPECT_NEAR(friction.at(1001), 0.70 * friction.at(1000), 1e-4);
  EXPECT_EQ(friction.at(999), friction.at(1000));
  const Ended verified = RunCommand({Bin("rodeira"), "replay", Path("rain.mcap"), "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  ASSERT_EQ(RunCommand({Bin("rodeira"), "export", "--csv", Path("tables"), Path("rain.mcap")}).status, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "tables/weather_state.csv"));
}

TEST_F(ScenarioRun, AWrongFileIsOneSentenceAndStatusTwo) {
  const std::string text = "rodeira: scenario/1\nevents:\n  - {at_s: 2.0005, name: mark, text: x}\n";
  ASSERT_TRUE(base::WriteWhole(Path("story.yaml"), std::string_view(text)).ok());
  const Ended ended =
      Run({"--set", "nodes.story.config.scenario=" + Path("story.yaml"), "--record", Path("never.mcap")});
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_THAT(ended.out, HasLine("story.yaml:3: 'at_s' is 2.0005; … 0.01 s … 2 or 2.01"));
}

}  // namespace
}  // namespace rodeira::system_test
