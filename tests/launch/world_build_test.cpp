// `rodeira world build`: which files it writes for which world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

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
