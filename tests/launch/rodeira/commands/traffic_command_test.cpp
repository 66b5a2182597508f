// SPDX-License-Identifier: Apache-2.0
// `rodeira traffic run` as a user sees it: how much traffic there is, and what is refused.
#include "launch/rodeira/commands/traffic_command.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "common/core/base/files.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

Said RunWith(const TrafficOptions& options) { return SaidBy(TrafficRun, options); }

// The ramp's map with a companion of the test's.
class TrafficCommand : public ::testing::Test {
 protected:
  TrafficCommand() {
    options_.map = folder_.path() / "ramp.motors";
    std::filesystem::copy_file(SourceDir() + "/configs/maps/ramp.motors", options_.map);
    options_.duration_s = 20.0;
  }
  void Beside(const std::string& companion) { ASSERT_TRUE(base::WriteWhole(options_.map + ".yaml", companion).ok()); }
  std::string Settings(const std::string& text) {
    const std::string file = folder_.path() / "settings.yaml";
    EXPECT_TRUE(base::WriteWhole(file, "rodeira: traffic/1\n" + text).ok());
    return file;
  }

  const TemporaryFolder folder_;
  TrafficOptions options_;
};

TEST_F(TrafficCommand, HasAsManyAsAreAskedForWhereThereAreNoFlows) {
  options_.vehicles = 4;
  const Said said = RunWith(options_);
  EXPECT_EQ(said.status, 0) << said.errors;
  EXPECT_THAT(said.out, HasSubstr("vehicles         4 on the road, 0 waiting to enter"));
  EXPECT_THAT(said.out, Not(HasSubstr("flow ")));
}

TEST_F(TrafficCommand, FlowsOfAMapBringItsVehicles) {
  Beside("rodeira: motors/1\nflows_vehph: {1: 900}\n");
  const Said flows = RunWith(options_);
  EXPECT_EQ(flows.status, 0) << flows.errors;
  EXPECT_THAT(flows.out, HasSubstr("flow 1 "));
  EXPECT_THAT(flows.out, Not(HasSubstr("flow 2 ")));
  // The same by a file of settings, and such a file goes before the map's own.
  options_.settings =
      Settings("flows:\n  - {lane: \"1:-1\", vehicles_per_h: 900}\n  - {lane: \"1:-1\", vehicles_per_h: 0.001}\n");
  const Said both = RunWith(options_);
  EXPECT_EQ(both.status, 0) << both.errors;
  EXPECT_THAT(both.out, HasSubstr(fmt::format("flow {:<12}0 arrived", 2)));
  const auto first_lines = [](const std::string& out) { return out.substr(0, out.find("wall time")); };
  EXPECT_EQ(first_lines(both.out), first_lines(flows.out));
}

TEST_F(TrafficCommand, AFlowOnALaneThatIsNotThereIsRefused) {
  Beside("rodeira: motors/1\nflows_vehph: {77: 900}\n");
  const Said said = RunWith(options_);
  EXPECT_EQ(said.status, 2);
  EXPECT_THAT(said.errors, HasSubstr("ramp.motors.yaml:2"));
  EXPECT_THAT(said.errors, HasSubstr("77"));
  EXPECT_EQ(said.out, "");
}

TEST_F(TrafficCommand, AFileWhereTablesShouldGoIsNamed) {
  options_.csv = options_.map;
  const Said said = RunWith(options_);
  EXPECT_EQ(said.status, 2);
  EXPECT_EQ(said.errors, "rodeira: --csv " + options_.map + ": a file is there; a folder was expected\n");
}

}  // namespace
}  // namespace rodeira::cli
