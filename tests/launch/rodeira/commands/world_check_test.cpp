// SPDX-License-Identifier: Apache-2.0
// `rodeira world check`: what it refuses and warns of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "tests/launch/rodeira/commands/world_fixture.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// As a person types it: what is a warning otherwise is an error, and status 2.
TEST(WorldCheck, StrictlyAsAsamsOwnToleranceAsks) {
  const TemporaryFolder folder;
  const fs::path file =
      folder.Write("gap.xodr",
                   "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"1\" "
                   "length=\"60\" junction=\"-1\">\n"
                   "<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"40\"><line/></geometry>\n<geometry "
                   "s=\"40\" x=\"40.0015\" y=\"0\" hdg=\"0\" length=\"20\"><line/></geometry></planView>"
                   "<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" "
                   "type=\"driving\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane></right>"
                   "</laneSection></lanes></road>\n</OpenDRIVE>\n");
  const system_test::Ended usual =
      system_test::RunCommand({system_test::Bin("rodeira"), "world", "check", file.string()});
  EXPECT_EQ(usual.status, 0) << usual.out;
  EXPECT_THAT(usual.out, HasSubstr("rodeira: warning: "));
  EXPECT_THAT(usual.out, HasSubstr("gap.xodr: no error found\n"));
  const system_test::Ended strict =
      system_test::RunCommand({system_test::Bin("rodeira"), "world", "check", file.string(), "--strict"});
  EXPECT_EQ(strict.status, 2) << strict.out;
  EXPECT_THAT(strict.out, Names("gap.xodr:6: road.geometry.contact_point: road 1, s 40: … 0.0015 m … 1e-06 m"));
  const fs::path world = folder.Write("w.yaml", "rodeira: world/2\nname: w\nground: {kind: plane}\n");
  const system_test::Ended other =
      system_test::RunCommand({system_test::Bin("rodeira"), "world", "check", world.string(), "--strict"});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.out, HasSubstr("'--strict' is for OpenDRIVE files"));
}

// What the traffic of a run would refuse, the check says before: lights that are green together where their ways cross,
// with the line of the phases.
TEST(WorldCheck, TellsOfLightsThatAreGreenTogether) {
  const TemporaryFolder folder;
  std::string text = base::ReadText(fs::path(SourceDir()) / "configs/worlds/lights.yaml").value();
  const std::string right = "green: [cross], for_s: 25";
  const std::size_t at = text.find(right);
  ASSERT_NE(at, std::string::npos);
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  text.replace(at, right.size(), "green: [cross, main], for_s: 25");
  ASSERT_TRUE(base::WriteWhole(folder.path() / "lights.yaml", text).ok());
  const Said said = AskedOfWorld("check", folder.path() / "lights.yaml");
  EXPECT_EQ(said.status, 2);
  EXPECT_EQ(said.out, "");
  EXPECT_THAT(said.errors, HasSubstr((folder.path() / "lights.yaml").string() + ":" + std::to_string(line) +
                                     ": the lights 'centre: main'"));
  EXPECT_EQ(AskedOfWorld("check", fs::path(SourceDir()) / "configs/worlds/lights.yaml").status, 0);
}

}  // namespace
}  // namespace rodeira::cli
