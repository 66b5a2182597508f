// SPDX-License-Identifier: Apache-2.0
// Live input between processes: this test plays a window of the run, its keys travel over DDS into recorded controls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <thread>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/driving/scenario/request.hpp"
#include "common/runtime/dds/participant.hpp"
#include "common/runtime/dds/remote_keys.hpp"
#include "common/runtime/dds/remote_requests.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

constexpr std::uint32_t kDomain = 217;
constexpr std::uint32_t kUp = 82, kLeft = 80, kQ = 20;  // USB usages

class Live : public ::testing::Test {
 protected:
  Live() {
    std::filesystem::create_directories(folder_);
    const std::string root = SourceDir();
    const std::string text =
        "rodeira: launch/1\nworld: " + root + "/configs/worlds/plane.yaml\nnodes:\n  road: {kind: road}\n" +
        "  driver: {kind: input, config: {source: keyboard, keyboard: " + root + "/configs/drivers/keyboard.yaml}}\n" +
        "  ego: {kind: vehicle, config: {vehicle: " + root + "/configs/vehicles/default.yaml}}\n";
    EXPECT_TRUE(base::WriteWhole(Path("live.yaml"), std::string_view(text)).ok());
  }
  ~Live() override { std::filesystem::remove_all(folder_); }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-live-" + std::to_string(::getpid()));
};

template <class Message>
std::vector<Message> Recorded(const std::string& file, std::string_view topic) {
  std::vector<Message> all;
  const auto reader = record::McapReader::Open(file);
  EXPECT_TRUE(reader.ok()) << reader.error().Text();
  if (!reader) return all;
  record::Query query;
  query.channels = std::set<record::ChannelId>{reader.value().ChannelsOf(topic).at(0)};
  auto cursor = reader.value().Messages(query);
  for (;;) {
    const auto message = cursor.Next();
    EXPECT_TRUE(message.ok());
    if (!message.ok() || !message.value()) return all;
    all.push_back(idl::Decode<Message>(message.value()->data).value());
  }
}

TEST_F(Live, KeysOfAWindowInAnotherProcessBecomeRecordedControls) {
  Started run({Bin("rodeira"), "run", Path("live.yaml"), "--for", "7", "--pace", "real", "--record", Path("live.mcap"),
               "--run", "live-keys", "--domain", std::to_string(kDomain)});
  auto participant = dds::Participant::Open({kDomain, "live-keys", "a window", launch::Transport::kSharedMemory, {}});
  ASSERT_TRUE(participant.ok()) << participant.error().Text();
  auto window = dds::OpenKeysSender(*participant.value());
  ASSERT_TRUE(window.ok()) << window.error().Text();
  // The keys and for how long; at the end the window is killed while the throttle is held.
  const auto say = [&](std::vector<launch::LiveKey> keys, std::chrono::milliseconds how_long) {
    const auto until = std::chrono::steady_clock::now() + how_long;
    while (std::chrono::steady_clock::now() < until) {
      window.value()->Say(keys);
      std::this_thread::sleep_for(20ms);
    }
  };
  say({}, 2500ms);  // processes start and meet
  say({{kUp, true, 1}}, 1000ms);
  say({{kUp, true, 1}, {kLeft, true, 1}}, 500ms);
  say({{kUp, true, 1}, {kLeft, false, 1}, {kQ, true, 1}}, 500ms);
  window.value().reset();
  const Ended ended = run.Wait(30s);
  ASSERT_EQ(ended.status, 0) << ended.out;

  const auto controls = Recorded<msg::Controls>(Path("live.mcap"), idl::topics::kControls);
  ASSERT_EQ(controls.size(), 701u);
  const auto first = [&](auto&& is) { return std::find_if(controls.begin(), controls.end(), is) - controls.begin(); };
  const auto pressed = first([](const msg::Controls& c) { return c.throttle() > 0.0; });
  ASSERT_LT(pressed, 701) << "no key has arrived";
  EXPECT_NEAR(controls[static_cast<std::size_t>(pressed)].throttle(), 0.01 / 0.5, 1e-12)
      << "one activation of the rate in the file";
  const auto to_the_floor = first([](const msg::Controls& c) { return c.throttle() == 1.0; });
  EXPECT_EQ(to_the_floor - pressed, 49) << "then every activation, whatever messages were lost";
  const auto left = first([](const msg::Controls& c) { return c.steering_wheel_rad() > 0.0; });
  EXPECT_GT(left, to_the_floor);
  const auto neutral = first([](const msg::Controls& c) { return c.gear() == 0; });
  EXPECT_GT(neutral, left);
  ASSERT_LT(neutral, 701);
  EXPECT_EQ(controls.back().gear(), 0) << "one press, one gear";
  EXPECT_EQ(controls.back().throttle(), 0.0) << "the window that died holds nothing any more";
  EXPECT_EQ(controls.back().steering_wheel_rad(), 0.0);
  const auto states = Recorded<msg::VehicleState>(Path("live.mcap"), idl::topics::kVehicleState);
  EXPECT_GT(states.back().odometer_m(), 1.0);
  // Computed again without a person at the keys: what was pressed is in the recording.
  const Ended verified = RunCommand({Bin("rodeira"), "replay", Path("live.mcap"), "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_THAT(verified.out, HasLine("live input … : driver"));
  EXPECT_NE(verified.out.find("identical: 7000 steps, "), std::string::npos) << verified.out;
}

// Said by a window in another process, again and again: the event is recorded once, the car stands there, and the
// recording is computed again to the bit.
TEST_F(Live, WhatAWindowAsksForBecomesARecordedEvent) {
  std::string text = base::ReadText(Path("live.yaml")).value();
  text += "  story: {kind: scenario, config: {requests: true}}\n";
  ASSERT_TRUE(base::WriteWhole(Path("asked.yaml"), std::string_view(text)).ok());
  Started run({Bin("rodeira"), "run", Path("asked.yaml"), "--for", "4", "--pace", "real", "--record",
               Path("asked.mcap"), "--run", "live-requests", "--domain", std::to_string(kDomain)});
  auto participant =
      dds::Participant::Open({kDomain, "live-requests", "a window", launch::Transport::kSharedMemory, {}});
  ASSERT_TRUE(participant.ok()) << participant.error().Text();
  auto window = dds::OpenRequestsSender(*participant.value());
  ASSERT_TRUE(window.ok()) << window.error().Text();
  const scenario::Request place = scenario::PlaceRequest({"ego", 61.25, -40.5, std::nullopt}, 135.0),
                          rain = scenario::WeatherRequest("rain", 1.0);
  // To its end, however long the start takes.
  const auto until = std::chrono::steady_clock::now() + 60s;
  while (run.WaitFor("digest ", 50ms) < 0ms && std::chrono::steady_clock::now() < until) {
    window.value()->Say({{1, place.name, place.argument, place.x_m, place.y_m, place.value},
                         {2, rain.name, rain.argument, rain.x_m, rain.y_m, rain.value}});
  }
  const Ended ended = run.Wait(30s);
  ASSERT_EQ(ended.status, 0) << ended.out;
  std::vector<msg::ScenarioEvent> events;
  for (const auto& sample : Recorded<msg::ScenarioEvents>(Path("asked.mcap"), idl::topics::kScenarioEvents)) {
    events.insert(events.end(), sample.events().begin(), sample.events().end());
  }
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].name(), "vehicle.place");
  EXPECT_EQ(events[0].argument(), "ego 61.25 -40.5");
  EXPECT_EQ(events[1].argument(), "rain");
  const auto states = Recorded<msg::VehicleState>(Path("asked.mcap"), idl::topics::kVehicleState);
  EXPECT_NEAR(states.back().position_w_m().x(), 61.25, 0.05) << "nobody touches a pedal";
  EXPECT_NEAR(states.back().position_w_m().y(), -40.5, 0.05);
  const Ended verified = RunCommand({Bin("rodeira"), "replay", Path("asked.mcap"), "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_NE(verified.out.find("identical: 4000 steps, "), std::string::npos) << verified.out;
}

TEST_F(Live, WithoutAKeyTwoRunsAreEqual) {
  const auto digest = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {Bin("rodeira"), "run", Path("live.yaml"), "--for", "2"});
    const Ended ended = RunCommand(more);
    EXPECT_EQ(ended.status, 0) << ended.out;
    return DigestIn(ended.out);
  };
  const std::string first = digest({});
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(digest({}), first);
  EXPECT_EQ(digest({"--in-process"}), first);
}

TEST_F(Live, AMissingWheelIsOneSentenceAndStatusTwo) {
  const Ended ended = RunCommand({Bin("rodeira"), "run", LaunchFile("wheel.yaml"), "--set",
                                  "nodes.driver.config.wheel=../configs/drivers/wheel.yaml", "--headless", "--record",
                                  Path("never.mcap"), "--for", "1"});
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_NE(
      ended.out.find(
          "configs/drivers/wheel.yaml:8: device 'wheel' with GUID 00000000000000000000000000000000 is not there; "),
      std::string::npos)
      << ended.out;
}

// The command as the documents say it, on a PC where nothing is plugged in.
TEST_F(Live, TheWheelsLaunchFileDrivesByKeysWithoutAWheel) {
  if (RunCommand({Bin("rodeira"), "joysticks"}).out.find("no device is connected") == std::string::npos)
    GTEST_SKIP() << "a device is plugged in, which would drive";
  const Ended ended = RunCommand(
      {Bin("rodeira"), "run", LaunchFile("wheel.yaml"), "--headless", "--record", Path("keys.mcap"), "--for", "1"});
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_THAT(ended.out, HasLine("node 'driver': info: no wheel … no game pad … no device … keys drive"));
}

TEST_F(Live, DrivingByKeysNeedsAWindow) {
  const Ended ended = RunCommand({"DISPLAY=:987", "WAYLAND_DISPLAY=nowhere", Bin("rodeira"), "run",
                                  LaunchFile("keyboard.yaml"), "--record", Path("never.mcap"), "--for", "1"});
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_NE(ended.out.find("a window is requested"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace rodeira::system_test
