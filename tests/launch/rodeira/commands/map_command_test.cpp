// SPDX-License-Identifier: Apache-2.0
// `rodeira map` as a user sees it: what is printed, what is written, the exit status.
#include "launch/rodeira/commands/map_command.hpp"
#include "launch/rodeira/commands/traffic_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "common/world/traffic_map/lane_map.hpp"
#include "tests/common/world/traffic_map/sample_map.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using testing::HasSubstr;

Said RunWith(const MapOptions& options) { return SaidBy(MapCommand, options); }

const std::string kCrossing = SourceDir() + "/configs/maps/crossing.motors";

TEST(MapCommand, ChecksAMap) {
  const Said said = RunWith({"check", kCrossing, ""});
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(said.errors, "");
  EXPECT_THAT(said.out, HasSubstr("lanes        20: 4 start, 4 end\n"));
  EXPECT_THAT(said.out, HasSubstr("connections  24, 6 with STOP\n"));
  EXPECT_THAT(said.out, HasSubstr("found        0 errors, 0 warnings\n"));
}

TEST(MapCommand, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "a.motors";
  ASSERT_TRUE(base::WriteWhole(file, traffic_map::kGoodLines + "p,9,0,0,0,1,0,0,2,0,0,3,0,0\ns,10\ni\n").ok());
  Said said = RunWith({"check", file, ""});
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(said.errors, "rodeira: " + file + ":12: warning: curve 9: no lane uses it\n");
  ASSERT_TRUE(base::WriteWhole(file, traffic_map::kGoodLines + "c,1,7,False\ns,10\ni\n").ok());
  said = RunWith({"check", file, ""});
  EXPECT_EQ(said.status, 2);
  EXPECT_EQ(said.errors, "rodeira: " + file + ":12: connection 1 to 7: lane 7 does not exist\n");
  EXPECT_THAT(said.out, HasSubstr("found        1 errors, 0 warnings\n"));
  said = RunWith({"convert", file, folder.path() / "a.svg"});
  EXPECT_EQ(said.status, 2);
  EXPECT_EQ(said.errors, "rodeira: " + file + ":12: connection 1 to 7: lane 7 does not exist\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.svg"));
}

// A world has no flows of its own: that they stay behind is said.
TEST(MapCommand, SaysThatFlowsStayBehind) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.motors";
  std::filesystem::copy(kCrossing, file);
  ASSERT_EQ(RunWith({"convert", file, folder.path() / "a.yaml"}).errors, "");
  const auto map = traffic_map::LoadLaneMap(file).value();
  ASSERT_TRUE(base::WriteWhole(folder.path() / "a.motors.yaml",
                               "rodeira: motors/1\nflows_vehph:\n  " +
                                   std::to_string(map.lanes[map.start_lanes.front()].id) + ": 300\n")
                  .ok());
  const Said said = RunWith({"convert", file, folder.path() / "a.yaml"});
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(said.errors,
            "rodeira: warning: the flows beside a.motors are not in it: a world has none; a file of traffic settings "
            "takes them (`flows`)\n");
}

// OpenDRIVE has no word for where vehicles begin and end: another program does not read it.
TEST(MapCommand, SaysThatModesElsewhereThanAtTheEdgeAreItsOwn) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.motors", out = folder.path() / "a.xodr";
  std::string text = base::ReadText(kCrossing).value();
  const std::string lane = "l,13,20,False,0,21,False,0,";
  ASSERT_NE(text.find(lane + "0"), std::string::npos);
  text[text.find(lane) + lane.size()] = '1';
  ASSERT_TRUE(base::WriteWhole(file, text).ok());
  const Said said = RunWith({"convert", file, out});
  EXPECT_EQ(said.status, 0);
  EXPECT_EQ(said.errors,
            "rodeira: warning: vehicles begin or end elsewhere than at the edge of a.motors; OpenDRIVE has no word for "
            "that: it stands in userData, which other programs pass over\n");
  EXPECT_THAT(base::ReadText(out).value(), HasSubstr("<userData code=\"rodeira:traffic\" value=\"begins\""));
}

// What the check lets pass can be driven: a bend that no road has, and lights that are green together, are found by it
// too.
TEST(MapCommand, FindsWhatCannotBeDriven) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.motors", beside = folder.path() / "a.motors.yaml";
  const std::string lights = SourceDir() + "/configs/maps/lights.motors";
  std::filesystem::copy(lights, file);
  std::filesystem::copy(lights + ".yaml", beside);
  const std::string good = base::ReadText(beside).value();
  ASSERT_EQ(RunWith({"check", file, ""}).status, 0);
  // Start lanes of all four arms green at once.
  std::string lanes;
  const auto map = traffic_map::LoadLaneMap(file).value();
  for (const std::size_t lane : map.start_lanes)
    lanes += (lanes.empty() ? "" : ", ") + std::to_string(map.lanes[lane].id);
  ASSERT_TRUE(base::WriteWhole(beside, good.substr(0, good.find("lights:")) + "lights:\n  - phases: [{green: [" +
                                           lanes + "], for_s: 20}, {green: [], for_s: 10}]\n")
                  .ok());
  const Said said = RunWith({"check", file, ""});
  EXPECT_EQ(said.status, 2);
  EXPECT_THAT(said.errors, testing::ContainsRegex(
                               "a[.]motors[.]yaml:[0-9]+: lights: the lights .* and .* are green or amber together"));
  EXPECT_THAT(said.out, HasSubstr("found        1 errors"));
  // … in the second phase: there it is said, also before a drive.
  ASSERT_TRUE(base::WriteWhole(beside, good.substr(0, good.find("lights:")) +
                                           "lights:\n  - phases:\n      - {green: [], for_s: 10}\n      - {green: [" +
                                           lanes + "], for_s: 20}\n")
                  .ok());
  const auto line =
      std::count(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(good.find("lights:")), '\n') + 4;
  const std::string there = "a.motors.yaml:" + std::to_string(line) + ": lights: the lights ";
  EXPECT_THAT(RunWith({"check", file, ""}).errors, HasSubstr(there));
  TrafficOptions drive;
  drive.map = file;
  const Said driven = SaidBy(TrafficRun, drive);
  EXPECT_EQ(driven.status, 2);
  EXPECT_THAT(driven.errors, HasSubstr(there));
  // A lane that turns on the spot: its errors are not found at the place of another file.
  std::string sharp = traffic_map::kGoodLines;
  sharp.replace(sharp.find("p,5,30,1,1.5,34,1,1.5,38.5,1,6,38.5,1,10"), 40, "p,5,30,1,1.5,30.1,1,1.5,29,1,1.5,29,1,2");
  sharp.replace(sharp.find("36,1,-1.5,41.5,1,4,41.5,1,10"), 28, "32,1,-1.5,33,1,0,33,1,2");
  std::filesystem::remove(beside);
  ASSERT_TRUE(base::WriteWhole(file, sharp + "s,10\ni\n").ok());
  const Said bend = RunWith({"check", file, ""});
  EXPECT_EQ(bend.status, 2) << bend.errors;
  EXPECT_THAT(bend.errors, HasSubstr("sharply"));
}

TEST(MapCommand, Converts) {
  const TemporaryFolder folder;
  const std::string svg = folder.path() / "a.svg", drive = folder.path() / "a.xodr";
  EXPECT_EQ(RunWith({"convert", kCrossing, svg}).out, "wrote " + svg + "\n");
  EXPECT_THAT(base::ReadText(svg).value(), testing::StartsWith("<svg"));
  const Said said = RunWith({"convert", kCrossing, drive});
  EXPECT_EQ(said.status, 0);
  EXPECT_THAT(said.out, HasSubstr("20 roads"));
  EXPECT_THAT(said.out, HasSubstr("mm (borders)"));
  EXPECT_THAT(base::ReadText(drive).value(), HasSubstr("<OpenDRIVE>"));
  const Said wrong = RunWith({"convert", kCrossing, folder.path() / "a.png"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.errors,
              HasSubstr("the file's name ends with '.png'; .svg, .xodr or, for a world, .yaml was expected"));
}

// A world that its roads lie beside, and that traffic drives on as on the map.
TEST(MapCommand, WritesAWorldOfThisProject) {
  const TemporaryFolder folder;
  const std::filesystem::path world = folder.path() / "over.yaml", roads = folder.path() / "over.xodr";
  const Said said = RunWith({"convert", SourceDir() + "/configs/maps/overpass.motors", world});
  EXPECT_EQ(said.status, 0) << said.errors;
  EXPECT_THAT(said.out, testing::StartsWith("wrote " + world.string() + " and " + roads.string() + ": "));
  for (const auto& problem : road::WorldProblems(world)) ADD_FAILURE() << problem.Text();
  const auto made = road::World::Load(world);
  ASSERT_TRUE(made.ok()) << made.error().Text();
  EXPECT_EQ(made.value()->name(), "over");
  EXPECT_GE(made.value()->network()->roads().size(), 20u);
  EXPECT_THAT(said.out, HasSubstr(": " + std::to_string(made.value()->network()->roads().size()) + " roads in "));
  // The same again is no mistake; another one's file is kept.
  EXPECT_EQ(RunWith({"convert", kCrossing, world}).status, 0);
  ASSERT_TRUE(base::WriteWhole(folder.path() / "mine.xodr", "mine").ok());
  const Said kept = RunWith({"convert", kCrossing, folder.path() / "mine.yaml"});
  EXPECT_EQ(kept.status, 2);
  EXPECT_THAT(kept.errors, HasSubstr("mine.xodr: this file is there already"));
  EXPECT_EQ(base::ReadText(folder.path() / "mine.xodr").value(), "mine");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "mine.yaml"));
}

}  // namespace
}  // namespace rodeira::cli
