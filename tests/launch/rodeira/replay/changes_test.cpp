// SPDX-License-Identifier: Apache-2.0
// What `--set`, `--branch` and `--for` change of a run, and what is told where they are wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "tests/launch/rodeira/replay/replay_fixture.hpp"
#include "tests/names.hpp"

namespace rodeira::cli {
namespace {

using Changes = ReplayTest;

// As it was typed, and not at the embedded launch file.
TEST_F(Changes, AWrongChangeIsAtTheOptionThatSaysIt) {
  const std::string file = Drive(1.0);
  const auto branch = [&](const char* change, const char* for_s) {
    return RunCommand({Bin("rodeira"), "replay", file, "--from", "0.5", "--for", for_s, "--branch", change, "--record",
                       (folder_.path() / "branch.mcap").string(), "--json"});
  };
  for (const auto& [change, names] :
       {std::pair("sed=2", "config.unknown_key … --branch sed=2: … 'seed'"),
        std::pair("seed=abc", "config.wrong_type … --branch seed=abc: 'seed'"),
        std::pair("nodes.ego.config.vehicl=1", "config.unknown_key … --branch nodes.ego.config.vehicl=1 … vehicle"),
        std::pair("nodes.eog.config.vehicle=~",
                  "launch.unknown_node … --branch nodes.eog.config.vehicle=~: … 'ego'")}) {
    const auto ended = branch(change, "0.1");
    EXPECT_EQ(ended.status, 2) << change;
    EXPECT_THAT(ended.out, Names(names));
  }
  EXPECT_THAT(branch("seed=2", "0.00015").out, Names("command.wrong_value … --for … 0.00015 … 0.001"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "branch.mcap"));
}

TEST_F(Changes, ARunLastsWholeSteps) {
  for (const char* mode : {"--quiet", "--in-process"}) {
    const auto ended = RunCommand(
        {Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--for", "0.00015", "--no-record", mode, "--json"});
    EXPECT_EQ(ended.status, 2) << mode;
    EXPECT_THAT(ended.out, Names("command.wrong_value … --for … 0.00015 … 0.001"));
  }
  for (const char* seconds : {"0.001", "0.3", "0.007"}) {  // no binary numbers
    const auto ended = RunCommand(
        {Bin("rodeira"), "run", LaunchFile("first_drive.yaml"), "--for", seconds, "--no-record", "--in-process"});
    EXPECT_EQ(ended.status, 0) << ended.out;
  }
}

TEST_F(Changes, InfoPrintsThem) {
  const std::string file =
      Record("ode.mcap", LaunchFile("first_drive.yaml"), {"--for", "0.1", "--set", "vehicle.model=ode"});
  const auto info = RunCommand({Bin("rodeira"), "info", file});
  EXPECT_EQ(info.status, 0);
  EXPECT_THAT(info.out, HasLine("embedded … override … vehicle.model=ode"));
}

}  // namespace
}  // namespace rodeira::cli
