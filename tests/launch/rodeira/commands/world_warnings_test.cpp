// SPDX-License-Identifier: Apache-2.0
// Every command that loads an OpenDRIVE file says what was repaired in it: one line a kind, on standard error.
#include <gmock/gmock.h>

#include <algorithm>

#include "launch/rodeira/commands/traffic_command.hpp"
#include "launch/rodeira/commands/world_axis.hpp"
#include "launch/rodeira/commands/world_command.hpp"
#include "launch/rodeira/run/in_process_command.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::cli {
namespace {

using testing::HasSubstr;

// 300 m of road with two lane offsets in the wrong order, which leads to a road that is not in the file.
constexpr const char* kRepairedRoad =
    "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"7\" length=\"300\" "
    "junction=\"-1\"><link><successor elementType=\"road\" elementId=\"12\" contactPoint=\"end\"/></link>\n"
    "<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0.4\" length=\"300\"><line/></geometry></planView><lanes>\n"
    "<laneOffset s=\"90\" a=\"0\" b=\"0\" c=\"0\" d=\"0\"/><laneOffset s=\"0\" a=\"0\" b=\"0\" c=\"0\" d=\"0\"/>"
    "<laneSection s=\"0\"><center><lane id=\"0\" type=\"none\"/></center><right><lane id=\"-1\" type=\"driving\">"
    "<width sOffset=\"0\" a=\"3.2\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes></road>\n"
    "</OpenDRIVE>\n";

class WorldWarnings : public testing::Test {
 protected:
  static void ExpectTwo(const std::string& errors) {
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 2) << errors;
    EXPECT_THAT(errors, HasSubstr("rodeira: warning: "));
    EXPECT_THAT(errors, HasSubstr("odd.xodr:6: road.lane_offset.elem_asc_order: road 7, s 0: "));
    EXPECT_THAT(errors, HasSubstr("odd.xodr:4: road.linkage.id: road 7, s 300: "));
    EXPECT_THAT(errors, HasSubstr("; repaired: the road ends there\n"));
  }
  Said World(const std::string& command, const std::string& out = "") {
    WorldOptions options;
    options.command = command, options.world_file = file_, options.out = out, options.quiet = true;
    options.x_m = 100.0, options.y_m = 40.0;
    return SaidBy(cli::World, options);
  }

  const TemporaryFolder folder_;
  const std::string file_ = folder_.Write("odd.xodr", kRepairedRoad);
};

TEST_F(WorldWarnings, OfEachWorldCommand) {
  for (const char* command : {"info", "query"}) {
    const Said said = World(command);
    EXPECT_EQ(said.status, 0) << command;
    ExpectTwo(said.errors);
  }
  const Said map = World("map", (folder_.path() / "plan.svg").string());
  EXPECT_EQ(map.status, 0);
  ExpectTwo(map.errors);
}

TEST_F(WorldWarnings, OfTraffic) {
  TrafficOptions options;
  options.map = file_, options.duration_s = 1.0, options.vehicles = 1, options.quiet = true;
  const Said said = SaidBy(TrafficRun, options);
  EXPECT_EQ(said.status, 0) << said.errors;
  ExpectTwo(said.errors);
}

TEST_F(WorldWarnings, OfARoadsAxis) {
  testing::internal::CaptureStderr();
  EXPECT_TRUE(AxisOf({file_, "7"}, 10.0).ok());
  ExpectTwo(testing::internal::GetCapturedStderr());
}

// The world is loaded once, and each node that stands on it is silent about it.
TEST_F(WorldWarnings, OfARunInOneProcess) {
  const auto launch = launch::Launch::Parse("rodeira: launch/1\nworld: " + file_ +
                                                "\nnodes:\n  road: {kind: road}\n  traffic: {kind: traffic, config: "
                                                "{vehicles: 1}}\n",
                                            "made.yaml", {});
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  RunOptions options;
  options.duration_s = 0.1, options.pace = "max", options.quiet = true;
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = RunInProcess(options, launch.value());
  testing::internal::GetCapturedStdout();
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_EQ(status, 0) << errors;
  ExpectTwo(errors);
}

}  // namespace
}  // namespace rodeira::cli
