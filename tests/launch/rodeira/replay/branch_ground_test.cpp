// SPDX-License-Identifier: Apache-2.0
// A branch in another world: refused where a vehicle would lose what it stands on.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "launch/rodeira/replay/branch.hpp"
#include "tests/launch/rodeira/replay/replay_fixture.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

class BranchGround : public ReplayTest {
 protected:
  std::string Road(const std::string& name, double y_m, double length_m = 300.0) const {
    return folder_
        .Write(name, fmt::format("<OpenDRIVE><header revMajor=\"1\" revMinor=\"7\"/><road id=\"1\" length=\"{1}\" "
                                 "junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"{0}\" hdg=\"0\" "
                                 "length=\"{1}\"><line/></geometry></planView><lanes><laneSection s=\"0\"><center>"
                                 "<lane id=\"0\" type=\"none\"/></center><right><lane id=\"-1\" type=\"driving\">"
                                 "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane></right>"
                                 "</laneSection></lanes></road></OpenDRIVE>",
                                 y_m, length_m))
        .string();
  }
  std::string Plane(const std::string& name, const std::string& keys) const {
    return folder_.Write(name, "rodeira: world/1\nname: other\nground: {kind: plane, " + keys + "}\n").string();
  }
  base::Result<BranchOutcome> In(const std::string& parent, const std::string& world) const {
    return Branch({parent, 500, {{"world", "\"" + world + "\""}}, 600, (folder_.path() / "branch.mcap").string()});
  }
};

TEST_F(BranchGround, AVariantOfTheParentsPlaneIsTaken) {
  const std::string file = Drive(1.0);
  const auto slippery = In(file, Plane("slippery.yaml", "friction: 0.4"));
  EXPECT_TRUE(slippery.ok()) << slippery.error().Text();
  const auto high = In(file, Plane("high.yaml", "z_m: 5"));
  ASSERT_FALSE(high.ok());
  EXPECT_THAT(high.error(), IsError("replay.wrong_world", "high.yaml: … 'ego' … 5.0 m higher"));
  EXPECT_EQ(high.error().exit_status(), 2);
}

TEST_F(BranchGround, AWorldWithoutARoadBelowACarIsRefused) {
  Road("road.xodr", 0.0);
  const std::string root = SourceDir();
  const auto launch = folder_.Write("drive.yaml",
                                    "rodeira: launch/1\nworld: road.xodr\nnodes:\n  road: {kind: road}\n"
                                    "  driver: {kind: input, config: {source: script, script: " +
                                        root +
                                        "/tests/data/standing.csv}}\n  ego: {kind: vehicle, config: "
                                        "{vehicle: " +
                                        root +
                                        "/configs/vehicles/default.yaml}}\n"
                                        "  recorder: {kind: recorder}\n");
  const std::string file = Record("road.mcap", launch.string(), {"--for", "1"});
  const auto longer = In(file, Road("longer.xodr", 0.0, 400.0));
  EXPECT_TRUE(longer.ok()) << longer.error().Text();
  const auto moved = In(file, Road("moved.xodr", 8.0));
  ASSERT_FALSE(moved.ok());
  EXPECT_THAT(moved.error(), IsError("replay.wrong_world", "moved.xodr: … 'ego' … no road"));
}

// Before the parent is read.
TEST_F(BranchGround, AnExistingFileIsRefusedFirst) {
  const std::string existing = folder_.Write("branch.mcap", "precious").string();
  const auto ended = RunCommand({Bin("rodeira"), "replay", (folder_.path() / "none.mcap").string(), "--from", "1",
                                 "--branch", "seed=2", "--record", existing, "--json"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.out, Names("file.exists … branch.mcap"));
}

}  // namespace
}  // namespace rodeira::cli
