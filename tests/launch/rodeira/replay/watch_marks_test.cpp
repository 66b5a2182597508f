// SPDX-License-Identifier: Apache-2.0
// What the window of a watched recording has beside its pictures: marks and events on the bar; recordings of other
// versions, and damaged ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "launch/rodeira/replay/marks_reader.hpp"
#include "launch/rodeira/replay/recorded_moments.hpp"
#include "launch/rodeira/replay/recorded_view.hpp"
#include "nodes/view/frame/surface.hpp"
#include "tests/launch/rodeira/replay/copied_recording.hpp"
#include "tests/launch/rodeira/replay/watch_fixture.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using lockstep::Step;
using system_test::Bin;
using system_test::LaunchFile;
using system_test::RunCommand;
using ::testing::HasSubstr;

TEST_F(WatchTest, OfRemarksOnlyMarksAreOnTheBar) {
  const auto remark = [](std::int64_t time_ns, const std::string& kind, const std::string& text) {
    msg::Remark one;
    one.time_ns(time_ns);
    one.kind(kind);
    one.text(text);
    return idl::Encode(one);
  };
  const auto run = replay::RecordedRun::Open(Made(kLaunch, [&](record::McapWriter& writer) {
    const auto channel = replay::AddTopic(writer, idl::topics::kRemarks);
    for (const auto& [time_ns, payload] :
         {std::pair(0, remark(0, "start", "")), std::pair(5'000, remark(5'000, "mark", "second\nlap")),
          std::pair(2'000, remark(2'000, "pause", "")), std::pair(3'000, remark(3'000, "fault", "")),
          std::pair(4'000, remark(4'000, "mark", std::string(58, 'x') + "ángulo"))}) {
      replay::Must(writer.Write(channel, 0, static_cast<std::uint64_t>(time_ns), 0, payload));
    }
  }));
  ASSERT_TRUE(run.ok()) << run.error().Text();
  const auto marks = MarksOf(run.value());
  ASSERT_TRUE(marks.ok()) << marks.error().Text();
  ASSERT_EQ(marks.value().size(), 3u);
  EXPECT_EQ(marks.value()[0].text, "fault");
  EXPECT_EQ(marks.value()[1].text, std::string(58, 'x') + "á...") << "a letter is not cut in two";
  EXPECT_EQ(marks.value()[2].time_ns, 5'000);
  EXPECT_EQ(marks.value()[2].text.find('\n'), std::string::npos);
}

// What a scenario did, and what people asked for in the window, is found again where it was valid; samples without an
// event are none.
TEST_F(WatchTest, TheScenariosEventsAreOnTheBar) {
  const auto event = [](const std::string& name, const std::string& argument, double value) {
    msg::ScenarioEvent one;
    one.name(name);
    one.argument(argument);
    one.value(value);
    return one;
  };
  const auto run = replay::RecordedRun::Open(Made(kLaunch, [&](record::McapWriter& writer) {
    const auto channel = replay::AddTopic(writer, idl::topics::kScenarioEvents);
    for (int step = 0; step < 5; ++step) {
      msg::ScenarioEvents events;
      if (step == 1) events.events() = {event("weather", "rain", 8.0), event("mark", "here it begins", 0.0)};
      if (step == 3) events.events() = {event("traffic.release", "all", 0.0)};
      if (step == 4)
        events.events() = {event("traffic.change_lane", "3", -1.0),
                           event("vehicle.place", "ego -1960.3132921686006 -534.1019500003695 20", 0.0)};
      replay::Must(writer.Write(channel, 0, static_cast<std::uint64_t>(step) * 1'000, 0, idl::Encode(events)));
    }
  }));
  ASSERT_TRUE(run.ok()) << run.error().Text();
  const auto marks = MarksOf(run.value());
  ASSERT_TRUE(marks.ok()) << marks.error().Text();
  ASSERT_EQ(marks.value().size(), 5u);
  EXPECT_EQ(marks.value()[4].text, "vehicle.place ego -1960.31 -534.102 20");
  EXPECT_EQ(marks.value()[0].text, "weather rain 8");
  EXPECT_EQ(marks.value()[1].text, "here it begins");
  EXPECT_EQ(marks.value()[2].text, "traffic.release all");
  EXPECT_EQ(marks.value()[3].text, "traffic.change_lane 3 right");
  EXPECT_EQ(marks.value()[0].time_ns, 1'000);
  EXPECT_EQ(marks.value()[2].time_ns, 3'000);
  for (const nodes::ReplayMark& mark : marks.value()) EXPECT_EQ(mark.kind, nodes::MarkKind::kEvent);
}

// What a picture does not need may be of another version.
TEST_F(WatchTest, OfAnotherVersionTheNeededTopicsMustMatch) {
  const auto with_idl = [&](const std::string& type, const std::string& before, const std::string& after) {
    CopyRecording(
        Made(), Path("other.mcap"), [](const std::string&, record::TextMap&) {},
        [](const std::string&, const record::Message&, base::Bytes&) { return true; },
        [](const std::string&) { return true; }, {},
        [&](const std::string& of, std::string& text) {
          if (of == type) text.replace(text.find(before), before.size(), after);
        });
    return replay::RecordedRun::Open(Path("other.mcap"));
  };
  const auto controls = with_idl("rodeira::msg::Controls", "double throttle", "double accelerator");
  ASSERT_TRUE(controls.ok()) << controls.error().Text();
  const auto seen = LookAt(controls.value(), {});
  ASSERT_TRUE(seen.ok()) << seen.error().Text();
  EXPECT_TRUE(MomentsOf(controls.value()).Exactly(1'000).ok());

  const auto car = with_idl("rodeira::msg::VehicleState", "double odometer_m", "float odometer_m");
  ASSERT_TRUE(car.ok()) << car.error().Text();
  const auto refused = LookAt(car.value(), {});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().exit_status(), 2);
  EXPECT_THAT(refused.error().Text(),
              HasSubstr("topic rodeira/vehicle_state: rodeira::msg::VehicleState, member 9: found 'float odometer_m', "
                        "expected 'double odometer_m'"));
}

// Its topics, types and members had other names.
TEST_F(WatchTest, ARecordingWithFormerNamesIsShown) {
  const auto run = replay::RecordedRun::Open(SourceDir() + "/tests/data/recordings/scripted_2c2fa2f4.mcap");
  ASSERT_TRUE(run.ok()) << run.error().Text();
  auto moments = MomentsOf(run.value());
  const auto moment = moments.Exactly(200);
  ASSERT_TRUE(moment.ok()) << moment.error().Text();
  ASSERT_EQ(moment.value().cars.size(), 1u);
  EXPECT_GT(moment.value().cars[0].fuel_used_l, 0.0);
  EXPECT_TRUE(MarksOf(run.value()).ok());
  EXPECT_FALSE(run.value().ChannelsOf(idl::topics::kWallTime).empty());
}

TEST_F(WatchTest, TheMarksAreReadBesideTheWindow) {
  const std::filesystem::path file = Made(kLaunch, [&](record::McapWriter& writer) {
    const auto channel = replay::AddTopic(writer, idl::topics::kRemarks);
    msg::Remark remark;
    remark.time_ns(2'000);
    remark.kind("mark");
    remark.text("here");
    replay::Must(writer.Write(channel, 0, 2'000, 0, idl::Encode(remark)));
  });
  MarksReader reader(file);
  auto taken = reader.Take();
  while (!taken) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    taken = reader.Take();
  }
  ASSERT_TRUE(taken->ok()) << taken->error().Text();
  ASSERT_EQ(taken->value().size(), 1u);
  EXPECT_EQ(taken->value()[0].text, "here");
  EXPECT_FALSE(reader.Take().has_value()) << "they are given once";

  const auto run = replay::RecordedRun::Open(file);
  ASSERT_TRUE(run.ok()) << run.error().Text();
  EXPECT_TRUE(MarksOf(run.value(), [] { return true; }).value().empty())
      << "who closes the window does not wait for them";
  MarksReader missing(folder_.path() / "missing.mcap");
  while (!(taken = missing.Take())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_FALSE(taken->ok());
}

TEST_F(WatchTest, WhereNothingMovesThereIsNothingToSee) {
  const auto run = RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--in-process", "--for", "0.2",
                               "--record", Path("empty.mcap"), "--quiet"});
  ASSERT_EQ(run.status, 0) << run.out;
  const auto replay = Replay({Path("empty.mcap"), "--view"});
  EXPECT_EQ(replay.status, 2);
  EXPECT_THAT(replay.out, HasSubstr("neither a car nor traffic"));
}

TEST_F(WatchTest, ADamagedPlaceIsNamedAndTheRestIsShown) {
  if (!nodes::Surface::Open(nodes::SurfaceKind::kOffscreen, 64, 64, "test").ok()) GTEST_SKIP() << "no OpenGL here";
  const std::string file = Made();
  {
    const auto reader = record::McapReader::Open(file);
    const auto& chunk = reader.value().chunks().at(3);
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(static_cast<std::streamoff>(chunk.offset + chunk.record_bytes - 20));
    bytes.put('\x5a').put('\x5a').put('\x5a');
  }
  const auto there = Replay({file, "--frames", Path("out"), "--at", "3.5"});
  EXPECT_EQ(there.status, 2) << there.out;
  EXPECT_THAT(there.out, HasSubstr("is damaged"));
  const auto elsewhere = Replay({file, "--frames", Path("out"), "--at", "1"});
  EXPECT_EQ(elsewhere.status, 0) << elsewhere.out;
  EXPECT_TRUE(std::filesystem::exists(Path("out/step_000001000.png")));
}

}  // namespace
}  // namespace rodeira::cli
