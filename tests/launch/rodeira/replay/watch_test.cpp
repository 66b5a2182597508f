// SPDX-License-Identifier: Apache-2.0
// A recording is watched: the frames and the movements of the live view, from the file alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "launch/rodeira/replay/recorded_moments.hpp"
#include "launch/rodeira/replay/recorded_view.hpp"
#include "nodes/view/frame/surface.hpp"
#include "tests/launch/rodeira/replay/watch_fixture.hpp"
#include "tests/long_form.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using lockstep::Step;
using system_test::Bin;
using system_test::LaunchFile;
using system_test::RunCommand;
using ::testing::HasSubstr;

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

TEST_F(WatchTest, TheLastStepIsAPicture) {
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
  WatchOptions specs;
  specs.camera = "chase";
  specs.size = "800x600";
  specs.follow = "ego";
  const auto other = LookAt(run.value(), specs);
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

TEST_F(WatchTest, TheDemosFramesComeOutOfItsRecordingPixelByPixel) {
  if (!nodes::Surface::Open(nodes::SurfaceKind::kOffscreen, 64, 64, "test").ok()) GTEST_SKIP() << "no OpenGL here";
  // One of them between two activations, the last at the run's end.
  const std::string until = BriefOrLong<std::string>("8", "30"),
                    times = BriefOrLong<std::string>("[5, 6, 6.013, 8]", "[5, 6, 6.013, 8, 12, 20, 30]");
  const auto run = RunCommand({"DISPLAY=", "WAYLAND_DISPLAY=", Bin("rodeira"), "run", LaunchFile("demo.yaml"),
                               "--in-process", "--for", until, "--record", Path("demo.mcap"), "--set",
                               "nodes.view.config.frames.folder=" + Path("live"), "--set",
                               "nodes.view.config.frames.times_s=" + times, "--set",
                               "nodes.view.config.width_px=" + BriefOrLong<std::string>("480", "960"), "--set",
                               "nodes.view.config.height_px=" + BriefOrLong<std::string>("270", "540")});
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
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1.0005"}), Names("1.0005 s … base step of 0.001 s"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1.002"}),
              HasSubstr("a multiple of its period of 0.004 s was expected"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1", "--follow", "egg"}), Names("--follow: … 'egg' … 'ego'"));
  EXPECT_THAT(complaint({file, "--frames", out, "--at", "1", "--camera", "drivr"}),
              HasSubstr("did you mean 'driver'?"));
  for (const char* size : {"10x10", "800", "800x", "x", "800x600x1", "99999999999999x5"}) {
    EXPECT_THAT(complaint({file, "--frames", out, "--at", "1", "--size", size}), HasSubstr("WIDTHxHEIGHT")) << size;
  }
  EXPECT_FALSE(std::filesystem::exists(out)) << "nothing is made before all is right";
  EXPECT_THAT(complaint({file, "--frames", "/proc", "--at", "1", "--force"}),
              HasSubstr("--frames: '/proc' cannot be written to"));
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

}  // namespace
}  // namespace rodeira::cli
