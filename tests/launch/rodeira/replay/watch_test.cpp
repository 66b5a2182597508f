// SPDX-License-Identifier: Apache-2.0
// A recording is watched: the frames and the movements of the live view, from the file alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "idl/codec.hpp"
#include "idl/messages.hpp"
#include "launch/rodeira/replay/marks_reader.hpp"
#include "launch/rodeira/replay/recorded_moments.hpp"
#include "launch/rodeira/replay/recorded_view.hpp"
#include "nodes/view/frame/surface.hpp"
#include "nodes/view/run_connection/from_wire.hpp"
#include "tests/common/runtime/replay/made_recording.hpp"
#include "tests/launch/rodeira/replay/copied_recording.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/long_form.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using lockstep::Step;
using system_test::Bin;
using system_test::LaunchFile;
using system_test::RunCommand;
using ::testing::HasSubstr;

constexpr Step kLast = 6'010;  // no activation of the view

// A car that weaves and traffic of which one agent goes away at 3 s and comes again elsewhere, seen every 20 ms.
constexpr const char* kLaunch =
    "rodeira: launch/1\nname: made\nnodes:\n  hands: {kind: input}\n  ego: {kind: vehicle, period_s: 0.004}\n  others: "
    "{kind: "
    "traffic, period_s: 0.01}\n"
    "  picture: {kind: view, config: {width_px: 320, height_px: 180, camera: driver, instruments: false, window: "
    "never, "
    "frames: {times_s: [1], folder: /proc/nowhere}}}\n";

base::Bytes Payload(const lockstep::Source& source, Step step) {
  const double t = 0.001 * static_cast<double>(step);
  if (source.topic == idl::topics::kControls) return idl::Encode(msg::Controls());
  if (source.topic == idl::topics::kVehicleState) {
    msg::VehicleState car;
    car.position_w_m().x(20.0 * t);
    car.position_w_m().y(3.0 * std::sin(t));
    car.attitude_wb().w(std::cos(0.1 * t));
    car.attitude_wb().z(std::sin(0.1 * t));
    for (auto& wheel : car.wheels()) {
      wheel.spin_rad(std::remainder(60.0 * t, 6.283185307179586));
      wheel.spin_radps(60.0);
    }
    return idl::Encode(car);
  }
  if (source.topic == idl::topics::kSignalsState) return idl::Encode(msg::SignalsState());
  if (source.topic == idl::topics::kTrafficDetails) {  // ten times a second; nothing between
    msg::TrafficDetails details;
    for (const std::uint32_t id : {4U, 9U}) {
      if (step % 100 != 0) break;
      msg::TrafficDetail detail;
      detail.id(id);
      detail.gear(static_cast<std::int32_t>(id));
      detail.target_speed_mps(static_cast<float>(t));
      details.agents().push_back(detail);
    }
    return idl::Encode(details);
  }
  msg::TrafficState traffic;
  for (const std::uint32_t id : {4U, 9U}) {
    msg::TrafficAgent agent;
    agent.id(id);
    agent.trip(id == 9 && step >= 3'000 ? 1 : 0);
    agent.position_x_m(id == 9 && step >= 3'000 ? -500.0 : 10.0 * t + id);
    agent.heading_rad(0.2 * t);
    traffic.agents().push_back(agent);
  }
  return idl::Encode(traffic);
}

bool Same(const scene::SceneSnapshot& a, const scene::SceneSnapshot& b) {
  if (a.time_ns != b.time_ns || a.cars.size() != b.cars.size() || a.agents.size() != b.agents.size()) return false;
  for (std::size_t i = 0; i < a.cars.size(); ++i) {
    if (a.cars[i].p_WB_W != b.cars[i].p_WB_W || a.cars[i].q_WB.coeffs() != b.cars[i].q_WB.coeffs()) return false;
    if (a.cars[i].wheels[2].spin_rad != b.cars[i].wheels[2].spin_rad || a.cars[i].gear != b.cars[i].gear) return false;
  }
  for (std::size_t i = 0; i < a.agents.size(); ++i) {
    if (a.agents[i].id != b.agents[i].id || a.agents[i].p_WB_W != b.agents[i].p_WB_W ||
        a.agents[i].q_WB.coeffs() != b.agents[i].q_WB.coeffs())
      return false;
  }
  return true;
}

class WatchTest : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }
  std::string Made(const std::string& launch = kLaunch, const std::function<void(record::McapWriter&)>& more = {}) {
    replay::MadeRecording wish;
    wish.launch_text = launch;
    wish.last_step = kLast;
    wish.payload = Payload;
    wish.more = more;
    replay::Make(wish, Path("made.mcap"));
    return Path("made.mcap");
  }
  static RecordedMoments MomentsOf(const replay::RecordedRun& run) {
    const auto seen = LookAt(run, {});
    EXPECT_TRUE(seen.ok()) << seen.error().Text();
    return {run, seen.value().sources, seen.value().period};
  }
  static system_test::Ended Replay(std::vector<std::string> words) {
    words.insert(words.begin(), {"DISPLAY=", "WAYLAND_DISPLAY=", Bin("rodeira"), "replay"});
    return RunCommand(words);
  }
  TemporaryFolder folder_;
};

// What the live view's window had in hand: a moment at each of its activations, made from the newest samples.
scene::PoseHistory HistoryUpTo(const replay::RecordedRun& run, Step step) {
  scene::PoseHistory history;
  for (Step at = std::max<Step>(0, step - 100) / 20 * 20; at <= std::min(step, kLast); at += 20) {
    nodes::NewestSamples newest;
    for (lockstep::SourceIndex s = 0; s < run.roster().sources().size(); ++s) {
      const auto& source = run.roster().source(s);
      if (source.topic != idl::topics::kVehicleState && source.topic != idl::topics::kTrafficState) continue;
      newest[s] = std::make_shared<const base::Bytes>(Payload(source, lockstep::FloorTo(at, source.period)));
    }
    history.Add(nodes::MakeMoment(run.roster(), at, newest).value());
  }
  return history;
}

TEST_F(WatchTest, MovesAsTheLiveViewMovedInWhateverOrder) {
  const auto run = replay::RecordedRun::Open(Made());
  ASSERT_TRUE(run.ok()) << run.error().Text();
  RecordedMoments moments = MomentsOf(run.value());
  std::vector<std::int64_t> times;
  for (std::int64_t time_ns = 0; time_ns < 5'990'000'000; time_ns += 7'654'321) times.push_back(time_ns);
  std::vector<scene::SceneSnapshot> forward;
  for (const std::int64_t time_ns : times) {
    auto moment = moments.At(time_ns);
    ASSERT_TRUE(moment.ok()) << moment.error().Text();
    const scene::PoseHistory live = HistoryUpTo(run.value(), time_ns / 1'000'000 + 20);
    ASSERT_TRUE(Same(moment.value(), live.At(static_cast<double>(time_ns)))) << time_ns;
    forward.push_back(std::move(moment).value());
  }
  for (std::size_t i = times.size(); i-- > 0;)
    ASSERT_TRUE(Same(moments.At(times[i]).value(), forward[i])) << "backward, " << times[i];
  for (std::uint64_t n = 0; n < 200; ++n) {
    const std::size_t i = base::RandomBits({5, n}) % times.size();
    ASSERT_TRUE(Same(moments.At(times[i]).value(), forward[i])) << "seeking, " << times[i];
  }
}

// The traffic says ten times a second what its drivers do; in between that holds, whichever way one comes.
TEST_F(WatchTest, WhatDriversDoHoldsUntilItIsSaidAgain) {
  const auto run = replay::RecordedRun::Open(Made());
  RecordedMoments moments = MomentsOf(run.value());
  for (const Step step : {5'490, 5'500, 5'599, 20, 0, 6'010}) {
    const auto moment = moments.Exactly(step);
    ASSERT_TRUE(moment.ok()) << moment.error().Text();
    ASSERT_EQ(moment.value().agents.size(), 2u);
    const auto& details = moment.value().agents;
    ASSERT_TRUE(details[0].detail && details[1].detail) << step;
    EXPECT_FLOAT_EQ(static_cast<float>(details[0].detail->target_speed_mps),
                    static_cast<float>(0.1 * static_cast<double>(step / 100)))
        << step;
    EXPECT_EQ(details[0].detail->gear, 4);
    EXPECT_EQ(details[1].detail->gear, 9);
  }
}

TEST_F(WatchTest, TheRunsEndIsAPicture) {
  const auto run = replay::RecordedRun::Open(Made());
  RecordedMoments moments = MomentsOf(run.value());
  EXPECT_TRUE(Same(moments.At(kLast * 1'000'000).value(), moments.Exactly(kLast).value()));
  EXPECT_EQ(moments.At(kLast * 1'000'000).value().time_ns, kLast * 1'000'000);
  const double before = moments.At(6'000'000'000).value().cars[0].p_WB_W.x(),
               between = moments.At(6'004'000'000).value().cars[0].p_WB_W.x(),
               end = moments.At(6'010'000'000).value().cars[0].p_WB_W.x();
  EXPECT_NEAR(between, before + 0.4 * (end - before), 1e-9) << "the last interval is shorter than a period";
}

TEST_F(WatchTest, AVehicleThatAppearsElsewhereDoesNotFlyThere) {
  const auto run = replay::RecordedRun::Open(Made());
  RecordedMoments moments = MomentsOf(run.value());
  EXPECT_EQ(moments.At(2'980'000'000).value().agents.size(), 2u);
  for (const std::int64_t time_ns : {2'980'000'001, 2'990'000'000, 2'999'999'999}) {
    const auto moment = moments.At(time_ns).value();
    ASSERT_EQ(moment.agents.size(), 1u) << time_ns;
    EXPECT_GT(moment.agents[0].p_WB_W.x(), 0.0);
  }
  const auto after = moments.At(3'000'000'000).value();
  ASSERT_EQ(after.agents.size(), 2u);
  EXPECT_EQ(after.agents[1].p_WB_W.x(), -500.0);
}

TEST_F(WatchTest, LooksAsTheRecordedViewDid) {
  const auto run = replay::RecordedRun::Open(Made());
  const auto seen = LookAt(run.value(), {});
  ASSERT_TRUE(seen.ok()) << seen.error().Text();
  EXPECT_EQ(seen.value().settings.width_px, 320);
  EXPECT_EQ(seen.value().settings.camera, scene::CameraKind::kDriver);
  EXPECT_FALSE(seen.value().settings.instruments);
  EXPECT_EQ(seen.value().period, 20);
  EXPECT_EQ(seen.value().sources.size(), 4u) << "a car, traffic, its details and lights, no hands";
  WatchOptions wishes;
  wishes.camera = "chase";
  wishes.size = "800x600";
  wishes.follow = "ego";
  const auto other = LookAt(run.value(), wishes);
  ASSERT_TRUE(other.ok()) << other.error().Text();
  EXPECT_EQ(other.value().settings.camera, scene::CameraKind::kChase);
  EXPECT_EQ(other.value().settings.height_px, 600);
}

TEST_F(WatchTest, ARunWithoutAViewIsSeenWhole) {
  const std::string launch = std::string(kLaunch).substr(0, std::string(kLaunch).find("  picture"));
  const auto run = replay::RecordedRun::Open(Made(launch));
  ASSERT_TRUE(run.ok()) << run.error().Text();
  const auto seen = LookAt(run.value(), {});
  ASSERT_TRUE(seen.ok()) << seen.error().Text();
  EXPECT_EQ(seen.value().sources.size(), 4u);
  EXPECT_EQ(seen.value().period, 20);
  EXPECT_EQ(seen.value().settings.width_px, 1280);
  EXPECT_TRUE(seen.value().settings.autopilots.empty());
  const std::string driven = std::string(launch).replace(
      launch.find("{kind: input}"), 13, "{kind: input, config: {source: autopilot, driver: driver.yaml}}");
  const auto by_autopilot = replay::RecordedRun::Open(Made(driven));
  ASSERT_TRUE(by_autopilot.ok()) << by_autopilot.error().Text();
  const auto seen_driven = LookAt(by_autopilot.value(), {});
  ASSERT_TRUE(seen_driven.ok()) << seen_driven.error().Text();
  ASSERT_EQ(seen_driven.value().settings.autopilots.size(), 1u);
  EXPECT_EQ(seen_driven.value().settings.autopilots.begin()->second.driver.filename(), "driver.yaml");
}

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

TEST_F(WatchTest, TheDemosFramesComeOutOfItsRecordingPixelByPixel) {
  if (!nodes::Surface::Open(nodes::SurfaceKind::kOffscreen, 64, 64, "test").ok()) GTEST_SKIP() << "no OpenGL here";
  // One of them between two activations, the last at the run's end.
  const std::string until = BriefOrLong<std::string>("8", "30"),
                    times = BriefOrLong<std::string>("[5, 6, 6.013, 8]", "[5, 6, 6.013, 8, 12, 20, 30]");
  const auto run = RunCommand({"DISPLAY=", "WAYLAND_DISPLAY=", Bin("rodeira"), "run", LaunchFile("demo.yaml"),
                               "--in-process", "--for", until, "--record", Path("demo.mcap"), "--set",
                               "nodes.view.config.frames.folder=" + Path("live"), "--set",
                               "nodes.view.config.frames.times_s=" + times});
  ASSERT_EQ(run.status, 0) << run.out;
  std::vector<std::string> wanted{Path("demo.mcap"), "--frames", Path("again"), "--at", "8", "5", "6.013", "6"};
  std::vector<Step> steps{5'000, 6'000, 6'013, 8'000};
  if (IsLongForm()) {
    wanted.insert(wanted.end(), {"30", "12", "20"});
    steps.insert(steps.end(), {12'000, 20'000, 30'000});
  }
  const auto replay = Replay(wanted);
  ASSERT_EQ(replay.status, 0) << replay.out;
  EXPECT_EQ(replay.out, "");
  for (const Step step : steps) {
    const auto live = base::ReadBytes(folder_.path() / "live" / nodes::FrameName(step)),
               again = base::ReadBytes(folder_.path() / "again" / nodes::FrameName(step));
    ASSERT_TRUE(live.ok() && again.ok()) << step;
    EXPECT_TRUE(live.value() == again.value()) << "the frame of step " << step << " differs";
  }
  EXPECT_EQ(Replay({Path("demo.mcap"), "--frames", Path("other"), "--at", "5", "--camera", "driver"}).status, 0);
  EXPECT_FALSE(base::ReadBytes(folder_.path() / "other" / nodes::FrameName(5'000)).value() ==
               base::ReadBytes(folder_.path() / "live" / nodes::FrameName(5'000)).value());
}

// A film has one picture for each 1 / fps of simulated time, whatever the machine's speed, and each of them is the
// frame of its step.
TEST_F(WatchTest, AFilmIsInStepWithSimulatedTime) {
  if (!nodes::Surface::Open(nodes::SurfaceKind::kOffscreen, 64, 64, "test").ok()) GTEST_SKIP() << "no OpenGL here";
  const std::string file = Made();
  const auto film =
      Replay({file, "--frames", Path("film"), "--fps", "25", "--from", "1", "--for", "0.4", "--size", "96x64"});
  ASSERT_EQ(film.status, 0) << film.out;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "film"))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  ASSERT_EQ(names.size(), 11u);
  for (std::size_t k = 0; k < names.size(); ++k)
    EXPECT_EQ(names[k], nodes::FrameName(1'000 + 40 * static_cast<Step>(k)));
  EXPECT_EQ(Replay({file, "--frames", Path("end"), "--fps", "250", "--from", "6.004", "--size", "64x64"}).status, 0)
      << "6.01 s has no sample: the film ends before";
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "end" / nodes::FrameName(6'008)));
  ASSERT_EQ(Replay({file, "--frames", Path("single"), "--at", "1.2", "--size", "96x64"}).status, 0);
  EXPECT_TRUE(base::ReadBytes(folder_.path() / "film" / nodes::FrameName(1'200)).value() ==
              base::ReadBytes(folder_.path() / "single" / nodes::FrameName(1'200)).value());
}

TEST_F(WatchTest, WhatIsAskedWronglyIsOneSentence) {
  const std::string file = Made();
  const auto complaint = [&](std::vector<std::string> words) {
    const auto ended = Replay(std::move(words));
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_EQ(std::count(ended.out.begin(), ended.out.end(), '\n'), 1) << ended.out;
    return ended.out;
  };
  const std::string out = Path("out");
  EXPECT_THAT(complaint({file, "--view"}),
              HasSubstr("no display answers; set DISPLAY, or let --frames FOLDER --at S write pictures without one"));
  EXPECT_THAT(complaint({file, "--view", "--from", "6.02"}),
              HasSubstr("--from 6.02 s was found, but the run goes from 0 to 6.010 s"));
  EXPECT_THAT(complaint({file, "--view", "--speed", "11"}),
              HasSubstr("--speed: 11 was found; 0.1 to 10 times real time was expected"));
  EXPECT_THAT(complaint({file, "--view", "--speed", "0.05"}), HasSubstr("0.05 was found"));
  EXPECT_THAT(complaint({file, "--view", "--speed", "nan"}), HasSubstr("nan was found"));
  EXPECT_THAT(complaint({file, "--view", "--verify"}), HasSubstr("more than one thing to do was named"));
  EXPECT_THAT(complaint({file, "--frames", out}), HasSubstr("--at S or --fps N was expected"));
  EXPECT_THAT(complaint({file, "--frames", out, "--fps", "300"}),
              HasSubstr("at most 250 were expected, as many as all cars have samples"));
  EXPECT_THAT(complaint({file, "--frames", out, "--fps", "-2"}), HasSubstr("--fps: -2 pictures a second were found"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1", "--quality", "meduim"}),
              HasSubstr("did you mean 'medium'?"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "6.014"}), HasSubstr("--at 6.014 s was found"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "-1"}), HasSubstr("--at -1 s was found"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1.0005"}),
              HasSubstr("1.0005 s is no multiple of the base step of 0.001 s"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1.002"}),
              HasSubstr("a multiple of its period of 0.004 s was expected"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1", "--follow", "egg"}),
              HasSubstr("--follow: 'egg' is no vehicle that this view is wired to; did you mean 'ego'?"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1", "--camera", "drivr"}),
              HasSubstr("did you mean 'driver'?"));
  for (const char* size : {"10x10", "800", "800x", "x", "800x600x1", "99999999999999x5"}) {
    EXPECT_THAT(complaint({file, "--frames", out, "--at", "1", "--size", size}), HasSubstr("WIDTHxHEIGHT")) << size;
  }
  EXPECT_FALSE(std::filesystem::exists(out)) << "nothing is made before all is right";
  EXPECT_THAT(complaint({file, "--frames", "/proc", "--at", "1"}), HasSubstr("--frames: '/proc' cannot be written to"));
  EXPECT_THAT(complaint({Path("none.mcap"), "--view"}), HasSubstr("none.mcap"));
  std::ofstream(Path("text.mcap")) << "hello";
  EXPECT_THAT(complaint({Path("text.mcap"), "--frames", out, "--at", "1"}), HasSubstr("text.mcap"));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THAT(complaint({file, "--view"}), HasSubstr("`rodeira repair`"));
  for (const std::vector<std::string>& half :
       {std::vector<std::string>{file, "--frames", out}, {file, "--at", "1"}, {file, "--speed", "2"}}) {
    EXPECT_EQ(Replay(half).status, 2);
  }
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
