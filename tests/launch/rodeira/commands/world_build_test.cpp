// SPDX-License-Identifier: Apache-2.0
// `rodeira world build`: which files it writes for which world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pty.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "common/core/base/files.hpp"
#include "common/world/road/logical_files.hpp"
#include "common/world/road/world.hpp"
#include "launch/rodeira/commands/world_command.hpp"
#include "tests/launch/rodeira/commands/world_fixture.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

Said Build(const fs::path& world, const fs::path& folder) { return AskedOfWorld("build", world, folder); }

constexpr const char* kHills =
    "rodeira: world/1\nname: hills\nterrain:\n  surface: grass\n"
    "  generate: {seed: 1, columns: 65, rows: 65, spacing_m: 10, west_m: 0, south_m: 0, relief: [{wavelength_m: 80, "
    "amplitude_m: 2}]}\n";
constexpr const char* kRoad =
    "roads:\n  - id: main\n    start: {x_m: 100, y_m: 300, heading_deg: 0}\n    axis: [{line: {length_m: 400}}]\n"
    "    vertical: [{s_m: 0, z_m: 0}]\n    section:\n      lanes: [{id: -1, width_m: 3, speed_limit_kmh: 50}, {id: 1, "
    "width_m: 3, speed_limit_kmh: 50}]\n      surface: asphalt\n";

std::vector<std::string> Listed(const fs::path& out) {
  std::vector<std::string> names;
  std::istringstream lines(base::ReadText(out / "logical.txt").value());
  for (std::string line; std::getline(lines, line);) {
    if (names.size() < 2)
      names.push_back(line);
    else
      names.push_back(line.substr(line.find(' ') + 1));
  }
  return names;
}

TEST(WorldBuild, AnOpenDriveWorldIsWrittenAsItIsSeen) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "town.xodr", out = folder.path() / "out";
  const std::string text =
      "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"1\" length=\"60\" "
      "junction=\"-1\">"
      "<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
      "length=\"60\"><line/></geometry></planView><lanes><laneSection s=\"0\">"
      "<center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3\" b=\"0\" "
      "c=\"0\" d=\"0\"/></lane></right>"
      "</laneSection></lanes></road>\n</OpenDRIVE>\n";
  ASSERT_TRUE(base::WriteWhole(file, text).ok());
  const Said first = Build(file, out);
  EXPECT_EQ(first.status, 0) << first.errors;
  EXPECT_THAT(first.out, HasSubstr(" 0 as they were\n"));
  EXPECT_TRUE(fs::exists(out / "world.osgb"));
  EXPECT_TRUE(fs::exists(out / "tiles" / "0_0_0.osgb"));
  EXPECT_EQ(base::ReadText(out / "world.xodr").value(), text);
  EXPECT_THAT(Build(file, out).out, HasSubstr(" 0 built, "));
}

// What is said on a terminal while `work` goes on.
template <class Work>
std::string OnTerminal(const Work& work) {
  int terminal = -1, end = -1;
  EXPECT_EQ(::openpty(&terminal, &end, nullptr, nullptr, nullptr), 0);
  const int before = ::dup(STDERR_FILENO);
  ::dup2(end, STDERR_FILENO);
  ::close(end);
  testing::internal::CaptureStdout();
  work();
  testing::internal::GetCapturedStdout();
  std::fflush(stderr);
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  std::string said;
  std::array<char, 4096> buffer{};
  for (ssize_t count; (count = ::read(terminal, buffer.data(), buffer.size())) > 0;)
    said.append(buffer.data(), static_cast<std::size_t>(count));
  ::close(terminal);
  return said;
}

// On a terminal a bar grows with the tiles that are done, one after the other to the last; `--quiet` says nothing.
TEST(WorldBuild, ABarShowsHowFarItIs) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "w.yaml";
  ASSERT_TRUE(base::WriteWhole(
                  file, std::string("rodeira: world/2\nname: w\nground: {kind: plane}\nroads:\n  - id: a\n    start: "
                                    "{x_m: 0, y_m: 0, heading_deg: 0}\n"
                                    "    axis: [line: {length_m: 20}]\n    z_m: 0\n    section: {template: rural}\n"))
                  .ok());
  WorldOptions options;
  options.command = "build";
  options.world_file = file;
  options.out = folder.path() / "out";
  options.threads = 2;
  const std::string said = OnTerminal([&] { EXPECT_EQ(World(options), 0); });
  std::size_t done = 0, of = 0;
  std::istringstream bars(said);
  for (std::string bar; std::getline(bars, bar, '\r');) {
    if (bar.empty() || bar == "\n") continue;
    char drawn[64] = {};
    std::size_t now = 0, all = 0;
    ASSERT_EQ(std::sscanf(bar.c_str(), "[%40[= ]] %zu of %zu tiles", drawn, &now, &all), 3) << bar;
    EXPECT_EQ(now, ++done) << bar;
    EXPECT_EQ(std::string(drawn), std::string(now * 40 / all, '=') + std::string(40 - now * 40 / all, ' ')) << bar;
    of = all;
  }
  EXPECT_GT(of, 8u);
  EXPECT_EQ(done, of);
  EXPECT_EQ(said.substr(said.size() - 1), "\n");
  options.quiet = true;
  EXPECT_EQ(OnTerminal([&] { EXPECT_EQ(World(options), 0); }), "");
}

TEST(WorldBuild, AWorldFilesRoadsAndHills) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "hills.yaml", out = folder.path() / "out";
  ASSERT_TRUE(base::WriteWhole(file, std::string(kHills) + kRoad).ok());
  const Said said = Build(file, out);
  EXPECT_EQ(said.status, 0) << said.errors;
  EXPECT_TRUE(fs::exists(out / "hills.bt"));
  EXPECT_TRUE(fs::exists(out / "hills.yaml"));
  EXPECT_TRUE(fs::exists(out / "world.osgb"));
  EXPECT_EQ(said.errors, "");
  EXPECT_EQ(AskedOfWorld("check", file).errors, "");
  EXPECT_TRUE(road::World::Load(out / "world.xodr").ok());
}

// Land without any road is written as it is seen, too: generated hills, an elevation file, a plane.
TEST(WorldBuild, LandWithoutRoads) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "hills.yaml", out = folder.path() / "out";
  ASSERT_TRUE(base::WriteWhole(file, kHills).ok());
  const Said bare = Build(file, out);
  EXPECT_EQ(bare.status, 0) << bare.errors;
  EXPECT_EQ(bare.errors, "");
  EXPECT_FALSE(fs::exists(out / "world.xodr"));
  EXPECT_TRUE(fs::exists(out / "world.osgb"));
  EXPECT_TRUE(fs::exists(out / "tiles" / "1_1_2.osgb"));
  EXPECT_THAT(Listed(out), testing::ElementsAre(testing::_, testing::_, "hills.bt", "hills.yaml"));
  // What was written is a world on a file: it is built with that file.
  const Said again = Build(out / "hills.yaml", folder.path() / "again");
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_EQ(again.errors, "");
  EXPECT_THAT(Listed(folder.path() / "again"), testing::ElementsAre(testing::_, testing::_, "hills.bt", "hills.yaml"));
  EXPECT_EQ(base::ReadText(folder.path() / "again" / "tiles" / "1_1_0.osgb").value(),
            base::ReadText(out / "tiles" / "1_1_0.osgb").value());
  const Said plane = Build(fs::path(SourceDir()) / "configs/worlds/plane.yaml", folder.path() / "plane");
  EXPECT_EQ(plane.status, 0) << plane.errors;
  EXPECT_EQ(plane.errors, "");
  EXPECT_TRUE(fs::exists(folder.path() / "plane" / "world.osgb"));
  EXPECT_THAT(Listed(folder.path() / "plane"), testing::ElementsAre(testing::_, testing::_, "plane.yaml"));
}

TEST(WorldBuild, AWorldFileOfVersion2IsWrittenAsItIsSeenToo) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "plane.yaml", out = folder.path() / "out";
  ASSERT_TRUE(
      base::WriteWhole(file, std::string("rodeira: world/2\nname: plane\nground: {kind: plane, z_m: 0}\nroads:\n  - "
                                         "id: main\n    start: {x_m: 0, y_m: 0, heading_deg: 0}\n"
                                         "    axis: [{line: {length_m: 60}}]\n    z_m: 0\n    section: {template: "
                                         "rural}\n    signs: [{type: stop, s_m: 50}]\n"))
          .ok());
  const Said said = Build(file, out);
  EXPECT_EQ(said.status, 0) << said.errors;
  EXPECT_EQ(said.errors, "");
  EXPECT_EQ(AskedOfWorld("check", file).errors, "");
  EXPECT_TRUE(fs::exists(out / "world.osgb"));
  EXPECT_TRUE(fs::exists(out / "tiles" / "0_0_0.osgb"));
  EXPECT_TRUE(road::World::Load(out / "world.xodr").ok());
  EXPECT_THAT(Build(file, out).out, HasSubstr(" 0 built, "));
}

// Things alone, at no road: what is seen of them is written, and there is no OpenDRIVE file, which would need a road.
TEST(WorldBuild, AWorldOfThingsWithoutARoad) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "w.yaml", out = folder.path() / "out";
  std::string hills = kHills;
  hills.replace(hills.find("world/1"), 7, "world/2");
  ASSERT_TRUE(
      base::WriteWhole(
          file, hills + "objects: [{type: tree, x_m: 100, y_m: 120}, {type: wall, along: [[200, 200], [300, 200]]}]\n")
          .ok());
  const Said said = Build(file, out);
  EXPECT_EQ(said.status, 0) << said.errors;
  EXPECT_EQ(said.errors, "");
  EXPECT_TRUE(fs::exists(out / "world.osgb"));
  EXPECT_TRUE(fs::exists(out / "w.bt"));
  EXPECT_FALSE(fs::exists(out / "world.xodr"));
  EXPECT_EQ(AskedOfWorld("check", out).errors, "");
  const auto again = road::World::Load(out / "w.yaml");
  ASSERT_TRUE(again.ok()) << again.error().Text();
  EXPECT_EQ(again.value()->content_hash(), road::World::Load(file).value()->content_hash());
}

// The example with all that it names, moved to where nothing else is found: the same world, checked file by file.
TEST(WorldBuild, ABuiltFolderIsListedAndMayBeMoved) {
  const TemporaryFolder folder;
  const fs::path example = fs::path(SourceDir()) / "configs/worlds/example", in = folder.path() / "in",
                 built = folder.path() / "built", moved = folder.path() / "moved";
  fs::copy(example, in, fs::copy_options::recursive);
  const base::Digest hash = road::World::Load(in / "world.yaml").value()->content_hash();
  const Said said = Build(in / "world.yaml", built);
  EXPECT_EQ(said.status, 0) << said.errors;
  fs::rename(built, moved);
  fs::remove_all(in);
  EXPECT_THAT(Listed(moved), testing::ElementsAre("rodeira: logical/1", "content_hash: " + base::Hex(hash), "bumps.crg",
                                                  "fields.png", "track.csv", "village.yaml", "world.bt", "world.prj",
                                                  "world.xodr", "world.yaml", "world_surfaces/bumps.crg", "worn.png"));
  const auto again = road::World::Load(moved / "world.yaml");
  ASSERT_TRUE(again.ok()) << again.error().Text();
  EXPECT_EQ(again.value()->content_hash(), hash);
  WorldOptions check;
  check.command = "check";
  check.world_file = moved.string();
  testing::internal::CaptureStdout();
  EXPECT_EQ(World(check), 0);
  EXPECT_THAT(testing::internal::GetCapturedStdout(),
              HasSubstr("every file of 'logical.txt' and 'visual.txt' is as it was written"));
  ASSERT_TRUE(base::WriteWhole(moved / "track.csv", base::ReadText(moved / "track.csv").value() + "\n").ok());
  fs::remove(moved / "worn.png");
  testing::internal::CaptureStderr();
  EXPECT_EQ(World(check), 2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "rodeira: " + (moved / "track.csv").string() +
                ": this file of the built world is not as it was written\nrodeira: " + (moved / "worn.png").string() +
                ": this file of the built world is missing\n");
  check.world_file = folder.path().string();
  testing::internal::CaptureStderr();
  EXPECT_EQ(World(check), 2);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("there is no 'logical.txt'; a folder that `rodeira world build` wrote was expected"));
}

// A build that was interrupted is told from one that ended, and goes on into its folder.
TEST(WorldBuild, AFolderThatWasNotWrittenToItsEndIsRefusedUntilItIs) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "w.yaml", out = folder.path() / "out";
  ASSERT_TRUE(base::WriteWhole(file, std::string("rodeira: world/2\nname: w\nground: {kind: plane}\n")).ok());
  ASSERT_TRUE(road::BeginLogical(out).ok());
  EXPECT_EQ(road::LogicalContentHash(out), "");
  const Said begun = AskedOfWorld("check", out);
  EXPECT_EQ(begun.status, 2);
  EXPECT_THAT(begun.errors, HasLine("rodeira: " + out.string() + " … did not end"));
  ASSERT_EQ(Build(file, out).status, 0);
  EXPECT_EQ(AskedOfWorld("check", out).status, 0);
  ASSERT_TRUE(road::BeginLogical(out).ok());
  EXPECT_EQ(AskedOfWorld("check", out).status, 0) << "a folder that is renewed is what it was until it is written";
}

// What is seen is part of the folder: a tile that is broken or missing, a line that says nothing, tiles of another
// world, no list at all.
TEST(WorldBuild, ABuiltFoldersTilesAreCheckedToo) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "w.yaml", out = folder.path() / "out";
  const auto write = [&](int length_m) {
    return base::WriteWhole(
        file, "rodeira: world/2\nname: w\nground: {kind: plane}\nroads:\n  - id: a\n    axis: [line: {length_m: " +
                  std::to_string(length_m) + "}]\n    section: {template: rural}\n");
  };
  ASSERT_TRUE(write(40).ok());
  ASSERT_EQ(Build(file, out).status, 0);
  EXPECT_EQ(AskedOfWorld("check", out).errors, "");
  EXPECT_THAT(AskedOfWorld("check", out).out, HasLine(out.string() + " … every file … 'logical.txt' … 'visual.txt'"));
  const auto problem = [&](const fs::path& where, const std::string& what) {
    return "rodeira: " + where.string() + ": " + what + "\n";
  };

  const fs::path tile = out / "tiles/0_0_1.osgb", other = out / "tiles/0_0_2.osgb", manifest = out / "visual.txt";
  std::string bytes = base::ReadText(tile).value();
  bytes[bytes.size() / 2] ^= 1;
  ASSERT_TRUE(base::WriteWhole(tile, bytes).ok());
  const Said broken = AskedOfWorld("check", out);
  EXPECT_EQ(broken.status, 2);
  EXPECT_EQ(broken.errors, problem(tile, "this file of what is seen is not as it was written"));
  fs::remove(other);
  const Said missing = AskedOfWorld("check", out);
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.errors, broken.errors + problem(other, "this file of what is seen is missing"));
  EXPECT_EQ(missing.out, "");
  ASSERT_EQ(Build(file, out).status, 0);  // both are made anew
  EXPECT_EQ(AskedOfWorld("check", out).status, 0);

  const std::string list = base::ReadText(manifest).value();
  const std::size_t line = list.find(" tiles/0_0_1.osgb") - 33, end = list.find('\n', line);
  std::string odd = list;
  odd[line] = 'x';  // no digit: what the line names would go unseen
  ASSERT_TRUE(base::WriteWhole(manifest, odd).ok());
  EXPECT_EQ(AskedOfWorld("check", out).errors,
            problem(manifest, "the line '" + odd.substr(line, end - line) + "' names no file with its hash"));
  fs::remove(manifest);
  const Said unlisted = AskedOfWorld("check", out);
  EXPECT_EQ(unlisted.status, 2);
  EXPECT_EQ(
      unlisted.errors,
      problem(out, "there is 'world.osgb' but no 'visual.txt', which names every file of what is seen with its hash"));

  // The tiles of one world beside the roads of another.
  ASSERT_TRUE(write(50).ok());
  ASSERT_EQ(Build(file, out).status, 0);
  EXPECT_EQ(AskedOfWorld("check", out).status, 0);
  ASSERT_TRUE(base::WriteWhole(manifest, list).ok());
  EXPECT_THAT(
      AskedOfWorld("check", out).errors,
      testing::StartsWith("rodeira: " + manifest.string() + ": it was written from a world with the content hash '"));
}

// On a plane too the world file comes along: bumps and patches stand nowhere else.
TEST(WorldBuild, AWorldOnAPlaneIsListedWithItsFile) {
  const TemporaryFolder folder;
  const fs::path out = folder.path() / "out";
  const Said said = Build(fs::path(SourceDir()) / "configs/worlds/lights.yaml", out);
  EXPECT_EQ(said.status, 0) << said.errors;
  EXPECT_EQ(Listed(out).size(), 4u);
  EXPECT_EQ(Listed(out)[2], "lights.yaml");
  EXPECT_EQ(base::ReadText(out / "lights.yaml").value(),
            base::ReadText(fs::path(SourceDir()) / "configs/worlds/lights.yaml").value());
}

// A traffic map is a world, but has no world file: what is asked of such files is refused, with what makes one of it.
// Its hash is that of its bytes, and of what stands beside it.
TEST(WorldOfAMap, IsAWorldWithoutAWorldFile) {
  const TemporaryFolder folder;
  const fs::path map = folder.path() / "lights.motors", beside = folder.path() / "lights.motors.yaml";
  fs::copy_file(SourceDir() + "/configs/maps/lights.motors", map);
  fs::copy_file(SourceDir() + "/configs/maps/lights.motors.yaml", beside);
  EXPECT_EQ(AskedOfWorld("check", map).out, map.string() + ": no problem found\n");
  EXPECT_EQ(AskedOfWorld("map", map, folder.path() / "plan.svg").status, 0);
  for (const char* command : {"build", "export"}) {
    const Said said = AskedOfWorld(command, map, folder.path() / "out");
    EXPECT_EQ(said.status, 2) << command;
    EXPECT_THAT(said.errors, HasSubstr("this is a traffic map; `rodeira map convert " + map.string() +
                                       " -o lights.yaml` makes a world file of it"))
        << command;
  }
  const auto hash = road::World::Load(map).value()->content_hash();
  fs::remove(beside);
  EXPECT_NE(road::World::Load(map).value()->content_hash(), hash);  // its lights are gone
  ASSERT_TRUE(base::WriteWhole(map, base::ReadText(map).value().substr(0, 500)).ok());
  const Said cut = AskedOfWorld("check", map);
  EXPECT_EQ(cut.status, 2);
  EXPECT_THAT(cut.errors, HasSubstr("lights.motors: the file ends at byte 500"));
}

}  // namespace
}  // namespace rodeira::cli
