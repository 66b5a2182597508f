// SPDX-License-Identifier: Apache-2.0
// Other models of the car in whole runs: a word, or a laboratory's FMU; one that fails or hangs is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/hash.hpp"
#include "tests/common/vehicle/fmi/test_fmu.hpp"
#include "tests/long_form.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class FmuRun : public ::testing::Test {
 protected:
  std::vector<std::string> Command(const std::string& parameters, std::vector<std::string> more) const {
    folder_.Pack();
    more.insert(more.begin(), {Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--set",
                               "nodes.ego.config.vehicle=" + folder_.WriteCar(parameters).string()});
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
  EXPECT_GE(run.WaitForLine("node 'ego' … computing step 150", 20s), 0ms);
  EXPECT_EQ(run.Wait(10s).status, 1);
}

// The sanitizers write a report of their own in place of the crash's.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST_F(FmuRun, OneThatCrashesInAStepIsNamedAndTheOthersEnd) {
  const std::string recording = (folder_.path() / "crash.mcap").string();
  const Ended run = RunCommand(Command("parameters: {crash_at_s: 1.5}\n", {"--for", "5", "--record", recording}));
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_THAT(run.out, HasLine("node 'ego' … signal 11 … fmi2DoStep … '" + (folder_.path() / "car.fmu").string() +
                               "' … 'vehicle' … step"));
  EXPECT_EQ(RunCommand({Bin("rodeira"), "info", recording}).status, 0) << "the recording is complete up to there";
}

TEST_F(FmuRun, OneThatEndsItsProcessInAStepIsNamed) {
  const Ended run = RunCommand(Command("parameters: {exit_at_s: 1.5}\n", {"--for", "5", "--no-record"}));
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_THAT(run.out, HasSubstr("node 'ego' left with status 1 in fmi2DoStep of FMU '"));
}

// A run of one process ends with the FMU, by the same signal, and says what it was and what to do.
TEST_F(FmuRun, ARunOfOneProcessEndsWithTheCrashAndSaysSo) {
  const std::string recording = (folder_.path() / "crash.mcap").string();
  const Ended run =
      RunCommand(Command("parameters: {crash_at_s: 1.5}\n", {"--for", "5", "--in-process", "--record", recording}));
  EXPECT_EQ(run.status, 128 + SIGSEGV) << run.out;
  EXPECT_THAT(run.out, HasSubstr("rodeira: crash: SIGSEGV in fmi2DoStep of FMU '" +
                                 (folder_.path() / "car.fmu").string() + "' (instance 'vehicle'); backtrace:"));
  EXPECT_THAT(run.out, HasSubstr("rodeira: the crash ends this run of one process; 'rodeira repair' completes its "
                                 "recording"));
  const Ended repaired =
      RunCommand({Bin("rodeira"), "repair", recording, "--out", (folder_.path() / "whole.mcap").string()});
  EXPECT_EQ(repaired.status, 0) << repaired.out;
}

#endif

// Already where it makes an instance of itself: also a run of one process says so, and is not ended by it.
TEST_F(FmuRun, OneThatCrashesAtOnceIsRefused) {
  for (const bool in_process : {false, true}) {
    auto command = Command("", {"--for", "1", "--no-record"});
    if (in_process) command.emplace_back("--in-process");
    folder_.Pack({{"{rodeira-test-car}", "{crashes}"}});
    const Ended run = RunCommand(command);
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_THAT(run.out,
                HasSubstr("car.fmu: its binary crashes (signal 11, Segmentation fault) in fmi2Instantiate, when it is "
                          "tried in a process of its own"));
  }
}

TEST_F(FmuRun, WhatIsNoFmuIsRefused) {
  const auto command = Command("", {"--for", "1", "--no-record", "--in-process"});
  ASSERT_TRUE(base::WriteWhole(folder_.path() / "car.fmu", "no archive").ok());
  const Ended run = RunCommand(command);
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.out, HasSubstr("car.fmu: this is no FMU: a ZIP archive was expected"));
}

// The demo (autopilot, traffic, recorder, the view) with any model: a word in the command line, and for a laboratory's
// car its file.
TEST_F(FmuRun, TheDemoDrivesWithEachModel) {
  folder_.Pack();
  const std::string fmu = folder_.WriteCar().string();
  const std::vector<std::vector<std::string>> cars = {
      {"vehicle.model=bicycle"},
      {"vehicle.model=multibody"},
      {"vehicle.model=ode"},
      {"nodes.ego.config.vehicle=" + fmu, "nodes.driver.config.vehicle=" + fmu}};
  for (const auto& settings : cars) {
    SCOPED_TRACE(settings.front());
    const std::string recording = (folder_.path() / "demo.mcap").string();
    const auto frames = folder_.path() / "frames";
    std::vector<std::string> command = {Bin("rodeira"),
                                        "run",
                                        LaunchFile("demo.yaml"),
                                        "--pace",
                                        "max",
                                        "--for",
                                        "1.5",
                                        "--record",
                                        recording,
                                        "--set",
                                        "nodes.view.config.quality=low",
                                        "--set",
                                        "nodes.view.config.width_px=160",
                                        "--set",
                                        "nodes.view.config.height_px=90",
                                        "--set",
                                        "nodes.view.config.frames.times_s=[0.5, 1.5]",
                                        "--set",
                                        "nodes.view.config.frames.folder=" + frames.string()};
    for (const std::string& setting : settings) command.insert(command.end(), {"--set", setting});
    const Ended run = RunCommand(command);
    ASSERT_EQ(run.status, 0) << run.out;
    std::set<base::Digest> pictures;
    for (const auto& picture : std::filesystem::directory_iterator(frames)) {
      EXPECT_GT(picture.file_size(), 3000u) << "there is something to be seen";
      pictures.insert(base::Hash(base::ReadBytes(picture.path()).value()));
    }
    EXPECT_EQ(pictures.size(), 2u) << "the car has moved";
    // Those of a word: cli.ReplayTest.TheDemoMayBeDrivenByAnyModel.
    if (IsLongForm() || &settings == &cars.back()) {
      const Ended verified = RunCommand({Bin("rodeira"), "replay", recording, "--verify"});
      EXPECT_EQ(verified.status, 0) << verified.out;
    }
    std::filesystem::remove_all(frames);
    std::filesystem::remove(recording);
  }
}

}  // namespace
}  // namespace rodeira::system_test
