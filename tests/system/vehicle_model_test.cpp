// Other models of the car in whole runs: a word, or a laboratory's FMU; one that fails or hangs is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "common/base/files.hpp"
#include "tests/common/fmi/test_fmu.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class FmuRun : public ::testing::Test {
 protected:
  std::vector<std::string> Command(const std::string& parameters, std::vector<std::string> more) const {
    folder_.Pack();
    more.insert(more.begin(), {Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--set", "nodes.ego.config.vehicle=" + folder_.WriteCar(parameters).string()});
    return more;
  }
  fmi::FmuFolder folder_;
};

TEST_F(FmuRun, DrivesAndIsComputedAgain) {
  const std::string recording = (folder_.path() / "fmu.mcap").string();
  const Ended run = RunCommand(Command("", {"--for", "6", "--in-process", "--record", recording}));
  ASSERT_EQ(run.status, 0) << run.out;
  const Ended verified = RunCommand({Bin("rodeira"), "replay", recording, "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
}

TEST_F(FmuRun, AFailureIsNamedWithWhatTheFmuSays) {
  const Ended run = RunCommand(Command("parameters: {fail_at_s: 1.5}\n", {"--for", "5", "--no-record"}));
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.out, HasSubstr("node 'ego' failed at step 150"));
  EXPECT_THAT(run.out, HasSubstr("fmi2DoStep: error: the tank is empty at 1.5 s"));
}

TEST_F(FmuRun, OneThatHangsIsNamedByTheWatchdog) {
  Started run(Command("parameters: {hang_at_s: 1.5}\n", {"--for", "5", "--no-record"}));
  EXPECT_GE(run.WaitFor("node 'ego' has been computing step 150", 20s), 0ms);
  EXPECT_EQ(run.Wait(10s).status, 1);
}

TEST_F(FmuRun, WhatIsNoFmuIsRefused) {
  const auto command = Command("", {"--for", "1", "--no-record", "--in-process"});
  ASSERT_TRUE(base::WriteWhole(folder_.path() / "car.fmu", "no archive").ok());
  const Ended run = RunCommand(command);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.out, HasSubstr("car.fmu: this is no FMU: a ZIP archive was expected"));
}

}  // namespace
}  // namespace rodeira::system_test
