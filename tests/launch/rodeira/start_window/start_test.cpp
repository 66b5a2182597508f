// SPDX-License-Identifier: Apache-2.0
// The start window's choices and the commands that they are; the window itself, without a display.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "common/runtime/launch/launch.hpp"
#include "launch/rodeira/start_window/start_window.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

StartFiles Here(const fs::path& data = "/nowhere") { return FindStartFiles(SourceDir(), data, "/nowhere"); }

// The launch file as the command changes it; an empty text where it is refused.
std::string Refused(const std::vector<std::string>& arguments) {
  launch::Overrides overrides;
  for (std::size_t i = 2; i + 1 < arguments.size(); i += 2) {
    if (arguments[i] != "--set") break;
    const auto equals = arguments[i + 1].find('=');
    overrides.emplace_back(arguments[i + 1].substr(0, equals), arguments[i + 1].substr(equals + 1));
  }
  const auto launch = launch::Launch::Load(arguments.at(1), overrides);
  return launch.ok() ? "" : launch.error().Text();
}

TEST(Start, EveryChoiceIsACommandThatALaunchFileTakes) {
  const StartFiles files = Here();
  ASSERT_GE(files.worlds.size(), 5u);
  ASSERT_GE(files.vehicles.size(), 3u);
  StartChoice choice = DefaultChoice(files);
  EXPECT_EQ(choice.world.filename(), "n222.yaml");
  EXPECT_EQ(choice.vehicle.filename(), "default.yaml");
  for (const StartDriver driver :
       {StartDriver::kKeyboard, StartDriver::kWheel, StartDriver::kPad, StartDriver::kAutopilot}) {
    for (const int traffic : {0, 7}) {
      for (const bool records : {true, false}) {
        for (const fs::path& world : files.worlds) {
          choice.driver = driver, choice.traffic = traffic, choice.records = records, choice.world = world;
          EXPECT_EQ(WhatIsMissing(files, choice), "");
          EXPECT_EQ(Refused(CommandOf(files, choice)), "") << ShellText(CommandOf(files, choice));
        }
      }
    }
  }
}

// The project's own, those in folders of their own, and a person's own beside the folder launch; no parts of worlds, no
// other files.
TEST(Start, WorldsAndVehiclesAreFoundWherePeopleHaveThem) {
  TemporaryFolder folder;
  for (const char* made : {"launch", "configs/worlds/town", "configs/vehicles/mine"})
    fs::create_directories(folder.path() / made);
  (void)folder.Write("launch/keyboard.yaml", "rodeira: launch/1\n");
  (void)folder.Write("configs/worlds/b.yaml", "rodeira: world/2\n");
  (void)folder.Write("configs/worlds/a.xodr", "<OpenDRIVE/>");
  (void)folder.Write("configs/worlds/town/world.yaml", "# a town\nrodeira: world/2\ninclude: [houses.yaml]\n");
  (void)folder.Write("configs/worlds/town/houses.yaml", "rodeira: world/2\n");
  (void)folder.Write("configs/worlds/town/notes.yaml", "who: me\n");
  (void)folder.Write("configs/vehicles/default.yaml", "rodeira: vehicle/1\n");
  (void)folder.Write("configs/vehicles/mine/lorry.yaml", "rodeira: vehicle/1\n");
  (void)folder.Write("first_road.yaml", "rodeira: world/2\n");
  (void)folder.Write("racer.yaml", "rodeira: vehicle/1\n");
  (void)folder.Write("study.yaml", "rodeira: launch/1\nworld: first_road.yaml\n");
  (void)folder.Write("lane.xodr", "<OpenDRIVE/>");
  const StartFiles files = FindStartFiles(folder.path(), "/nowhere", "/nowhere");
  const auto names = [&](const std::vector<fs::path>& all) {
    std::vector<std::string> shown;
    for (const fs::path& file : all) shown.push_back(ShownName(files.root, file));
    return shown;
  };
  EXPECT_EQ(names(files.worlds),
            (std::vector<std::string>{"a.xodr", "b.yaml", "town/world.yaml", "first_road.yaml", "lane.xodr"}));
  EXPECT_EQ(names(files.vehicles), (std::vector<std::string>{"default.yaml", "mine/lorry.yaml", "racer.yaml"}));
  EXPECT_EQ(ShownName(files.root, "/elsewhere/x.yaml"), "/elsewhere/x.yaml");
  StartChoice choice = DefaultChoice(files);
  choice.world = folder.path() / "first_road.yaml";
  EXPECT_EQ(CommandOf(files, choice)[3], "world=\"../first_road.yaml\"");
}

TEST(Start, WhatIsNoWorldIsSaidInTheWindow) {
  const StartFiles files = Here();
  StartChoice choice = DefaultChoice(files);
  choice.world = fs::path(SourceDir()) / "configs/maps/town.motors";
  EXPECT_EQ(WhatIsMissing(files, choice), "");
  choice.world = fs::path(SourceDir()) / "README.md";
  EXPECT_EQ(WhatIsMissing(files, choice),
            "'" + choice.world.string() + "' is no world; a file that ends on .yaml, .xodr or .motors was expected");
  choice = DefaultChoice(files);
  choice.vehicle = "/elsewhere/car.yaml";
  EXPECT_EQ(WhatIsMissing(files, choice), "there is no file '/elsewhere/car.yaml'");
}

TEST(Start, TheLaunchFileHasWhatWasChosen) {
  const StartFiles files = Here();
  StartChoice choice = DefaultChoice(files);
  choice.driver = StartDriver::kAutopilot;
  choice.world = fs::path(SourceDir()) / "configs/worlds/motorway.yaml";
  choice.traffic = 33;
  const auto arguments = CommandOf(files, choice);
  EXPECT_EQ(ShellText({arguments.begin() + 2, arguments.end()}),
            "rodeira --set 'world=\"../configs/worlds/motorway.yaml\"' --set "
            "'nodes.ego.config.vehicle=\"../configs/vehicles/default.yaml\"' --set "
            "'nodes.driver.config={source: autopilot, driver: ../configs/drivers/default.yaml, vehicle: "
            "\"../configs/vehicles/default.yaml\"}' --set "
            "nodes.traffic.config.vehicles=33");
  choice.records = false;
  EXPECT_EQ(CommandOf(files, choice).back(), "--no-record");
  choice.world = "/elsewhere/my world.xodr";
  EXPECT_EQ(WhatIsMissing(files, choice), "there is no file '/elsewhere/my world.xodr'");
  EXPECT_EQ(CommandOf(files, choice)[3], "world=\"/elsewhere/my world.xodr\"");
}

// A shell takes the text apart into the very same words.
TEST(Start, TheCommandAsTextIsTheCommand) {
  const std::vector<std::string> words{"run", "a b", "it's", "\"quoted\"", "$HOME", "", "--set", "x={a: [1, 2]}", "\\"};
  const std::string text = ShellText(words).substr(std::string("rodeira ").size());
  const auto ended =
      system_test::RunCommand({"/bin/sh", "-c", "for word in " + text + "; do printf '<%s>' \"$word\"; done"});
  std::string expected;
  for (const std::string& word : words) expected += "<" + word + ">";
  EXPECT_EQ(ended.out, expected);
}

TEST(Start, RecentRunsStandWithTheNewestFirst) {
  TemporaryFolder folder;
  const auto begin = fs::file_time_type::clock::now();
  for (int i = 0; i < 20; ++i) {
    const auto file = folder.Write("run" + std::to_string(i) + ".mcap", "x");
    fs::last_write_time(file, begin - std::chrono::minutes((i * 7) % 20));
  }
  (void)folder.Write("notes.txt", "x");
  const StartFiles files = Here(folder.path());
  ASSERT_EQ(files.recordings.size(), StartFiles::kRecent);
  for (std::size_t i = 1; i < files.recordings.size(); ++i)
    EXPECT_GT(fs::last_write_time(files.recordings[i - 1]), fs::last_write_time(files.recordings[i]));
  StartChoice choice = DefaultChoice(files);
  choice.way = StartWay::kWatch;
  EXPECT_EQ(CommandOf(files, choice),
            (std::vector<std::string>{"replay", (folder.path() / "run0.mcap").string(), "--view"}));
  choice.recording.clear();
  EXPECT_EQ(WhatIsMissing(files, choice), "choose a recording");
}

TEST(Start, TheFoldersAreFoundFromBelowThem) {
  EXPECT_EQ(FindStartRoot({fs::path(SourceDir()) / "build/bin"}), fs::path(SourceDir()));
  EXPECT_EQ(FindStartRoot({"/proc/1", fs::path(SourceDir()) / "docs"}), fs::path(SourceDir()));
  EXPECT_EQ(FindStartRoot({"/proc"}), fs::path());
  const StartFiles none = FindStartFiles({}, "/nowhere", "/nowhere");
  EXPECT_NE(WhatIsMissing(none, DefaultChoice(none)).find("were found neither here nor beside the program"),
            std::string::npos);
}

TEST(Start, WhatWasBegunSaysHowItGoesAndHowItEnded) {
  auto run = StartedRun::Start("/bin/sh", {"-c", "echo loading; echo wrong >&2; exit 3"});
  ASSERT_TRUE(run.ok()) << run.error().Text();
  for (int i = 0; i < 500 && !run.value().ended(); ++i) {
    run.value().Poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  run.value().Poll();
  EXPECT_EQ(run.value().lines(), (std::vector<std::string>{"loading", "wrong"}));
  EXPECT_EQ(run.value().State(), "left with status 3");
  auto endless = StartedRun::Start("/bin/sleep", {"100"});
  ASSERT_TRUE(endless.ok());
  endless.value().Poll();
  EXPECT_FALSE(endless.value().ended());
  endless.value().Stop();
  for (int i = 0; i < 500 && !endless.value().ended(); ++i) {
    endless.value().Poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(endless.value().ended());
}

}  // namespace
}  // namespace rodeira::cli
