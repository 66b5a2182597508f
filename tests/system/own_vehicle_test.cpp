// SPDX-License-Identifier: Apache-2.0
// The vehicle model of examples/own_vehicle drives in whole runs as Rodeira's own do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "idl/messages.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class OwnVehicleRun : public ::testing::Test {
 protected:
  OwnVehicleRun() {
    fs::copy(fs::path(SourceDir()) / "examples/own_vehicle/kinematic_car.yaml", File("kinematic_car.yaml"));
    fs::copy(Bin("rodeira-test-kinematic_car.so"), File("kinematic_car.so"));
  }
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  Ended Run(const std::string& recording, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> command{
        Bin("rodeira"),  "run",   LaunchFile("first_drive.yaml"),
        "--for",         "4",     "--record",
        File(recording), "--set", "nodes.ego.config.vehicle=" + File("kinematic_car.yaml")};
    command.insert(command.end(), more.begin(), more.end());
    return RunCommand(command);
  }
  const cli::TemporaryFolder folder_;
};

TEST_F(OwnVehicleRun, HasOneDigestApartAndTogetherAndIsVerifiedWithoutItsFiles) {
  const Ended apart = Run("apart.mcap");
  ASSERT_EQ(apart.status, 0) << apart.out;
  const Ended together = Run("together.mcap", {"--in-process"});
  ASSERT_EQ(together.status, 0) << together.out;
  EXPECT_EQ(DigestIn(together.out), DigestIn(apart.out));
  EXPECT_EQ(FirstDifference(SamplesOf(File("apart.mcap")), SamplesOf(File("together.mcap"))), "");
  const auto states = MessagesOf<msg::VehicleState>(File("apart.mcap"), "rodeira/vehicle_state");
  ASSERT_FALSE(states.empty());
  EXPECT_GT(states.back().odometer_m(), 3.0) << "it drives";
  for (const char* file : {"kinematic_car.yaml", "kinematic_car.so"}) fs::remove(File(file));
  const Ended verified = RunCommand({Bin("rodeira"), "replay", File("apart.mcap"), "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("identical: 4000 steps"));
}

TEST_F(OwnVehicleRun, AMissingSharedObjectIsRefusedBeforeTheRun) {
  fs::remove(File("kinematic_car.so"));
  const Ended ended = Run("never.mcap");
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("kinematic_car.yaml:4: "), HasSubstr("cannot load the shared object")));
  EXPECT_FALSE(fs::exists(File("never.mcap")));
}

TEST_F(OwnVehicleRun, AModelThatIsNotFiniteEndsTheRunWithASentence) {
  fs::copy(Bin("rodeira-test-odd_vehicle.so"), File("odd_vehicle.so"));
  folder_.Write("kinematic_car.yaml",
                "rodeira: vehicle/1\nmodel: library\nlibrary: odd_vehicle.so\nfault: nan_after_step\n");
  const Ended ended = Run("odd.mcap");
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("'ego'"), HasSubstr("state is not finite")));
}

}  // namespace
}  // namespace rodeira::system_test
