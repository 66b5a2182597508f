// `rodeira world build`: which files it writes for which world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pty.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "common/base/files.hpp"
#include "common/road/world.hpp"
#include "launch/world_command.hpp"
#include "tests/launch/temporary_folder.hpp"

namespace rodeira::front {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Said {
  int status;
  std::string out;
  std::string errors;
};

Said Build(const fs::path& world, const fs::path& folder) {
  WorldOptions options;
  options.command = "build";
  options.world_file = world;
  options.out = folder;
  options.quiet = true;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = World(options);
  return {status, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

constexpr const char* kHills = "rodeira: world/1\nname: hills\nterrain:\n  surface: grass\n"
                               "  generate: {seed: 1, columns: 65, rows: 65, spacing_m: 10, west_m: 0, south_m: 0, relief: [{wavelength_m: 80, amplitude_m: 2}]}\n";
constexpr const char* kRoad = "roads:\n  - id: main\n    start: {x_m: 100, y_m: 300, heading_deg: 0}\n    axis: [{line: {length_m: 400}}]\n"
                              "    vertical: [{s_m: 0, z_m: 0}]\n    section:\n      lanes: [{id: -1, width_m: 3, speed_limit_kmh: 50}, {id: 1, width_m: 3, speed_limit_kmh: 50}]\n      surface: asphalt\n";

TEST(WorldBuild, AnOpenDriveWorldIsWrittenAsItIsSeen) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "town.xodr", out = folder.path() / "out";
  const std::string text = "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"1\" length=\"60\" junction=\"-1\">"
      "<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"60\"><line/></geometry></planView><lanes><laneSection s=\"0\">"
      "<center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane></right>"
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
  for (ssize_t count; (count = ::read(terminal, buffer.data(), buffer.size())) > 0;) said.append(buffer.data(), static_cast<std::size_t>(count));
  ::close(terminal);
  return said;
}

// On a terminal a bar grows with the tiles that are done, one after the other to the last; `--quiet` says nothing.
TEST(WorldBuild, ABarShowsHowFarItIs) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "w.yaml";
  ASSERT_TRUE(base::WriteWhole(file, std::string("rodeira: world/2\nname: w\nground: {kind: plane}\nroads:\n  - id: a\n    start: {x_m: 0, y_m: 0, heading_deg: 0}\n"
                                                 "    axis: [line: {length_m: 20}]\n    z_m: 0\n    section: {template: rural}\n")).ok());
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
  EXPECT_FALSE(fs::exists(out / "world.osgb"));
  EXPECT_TRUE(road::World::Load(out / "world.xodr").ok());
  // Without roads there are only the hills; with neither there is nothing.
  ASSERT_TRUE(base::WriteWhole(file, kHills).ok());
  const Said bare = Build(file, folder.path() / "bare");
  EXPECT_EQ(bare.status, 0) << bare.errors;
  EXPECT_FALSE(fs::exists(folder.path() / "bare" / "world.xodr"));
  ASSERT_TRUE(base::WriteWhole(file, "rodeira: world/1\nname: plane\nground: {kind: plane, z_m: 0}\n").ok());
  const Said nothing = Build(file, folder.path() / "none");
  EXPECT_EQ(nothing.status, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("there is nothing to build"));
}

TEST(WorldBuild, AWorldFileOfVersion2IsWrittenAsItIsSeenToo) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "plane.yaml", out = folder.path() / "out";
  ASSERT_TRUE(base::WriteWhole(file, std::string("rodeira: world/2\nname: plane\nground: {kind: plane, z_m: 0}\nroads:\n  - id: main\n    start: {x_m: 0, y_m: 0, heading_deg: 0}\n"
                                                 "    axis: [{line: {length_m: 60}}]\n    z_m: 0\n    section: {template: rural}\n    signs: [{type: stop, s_m: 50}]\n")).ok());
  const Said said = Build(file, out);
  EXPECT_EQ(said.status, 0) << said.errors;
  EXPECT_TRUE(fs::exists(out / "world.osgb"));
  EXPECT_TRUE(fs::exists(out / "tiles" / "0_0_0.osgb"));
  EXPECT_TRUE(road::World::Load(out / "world.xodr").ok());
  EXPECT_THAT(Build(file, out).out, HasSubstr(" 0 built, "));
}

}  // namespace
}  // namespace rodeira::front
