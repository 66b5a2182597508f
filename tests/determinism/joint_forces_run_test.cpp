// SPDX-License-Identifier: Apache-2.0
// The topic rodeira/joint_forces: only where the launch file names it, then recorded, verified and branched.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

using system_test::Bin;
using system_test::Ended;
using system_test::RunCommand;

class JointForcesRun : public ::testing::Test {
 protected:
  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  // 1.5 s of the first drive with the multibody car.
  Ended Drive(const std::string& recording, const std::vector<std::string>& more) const {
    std::vector<std::string> command{Bin("rodeira"),
                                     "run",
                                     system_test::LaunchFile("first_drive.yaml"),
                                     "--in-process",
                                     "--headless",
                                     "--for",
                                     "1.5",
                                     "--record",
                                     File(recording),
                                     "--set",
                                     "vehicle.model=multibody",
                                     "--set",
                                     "snapshot_every_s=0.5"};
    command.insert(command.end(), more.begin(), more.end());
    return RunCommand(command);
  }
  std::string Table(const std::string& recording, const std::string& topic) const {
    const Ended ended = RunCommand({Bin("rodeira"), "export", File(recording), "--csv", File(recording + "." + topic),
                                    "--topics", topic, "--quiet"});
    EXPECT_EQ(ended.status, 0) << ended.out;
    const auto text = base::ReadText(folder_.path() / (recording + "." + topic) / (topic + ".csv"));
    EXPECT_TRUE(text.ok()) << (text.ok() ? "" : text.error().Text());
    return text.ok() ? text.value() : "";
  }
  const base::TemporaryFolder folder_ = base::TemporaryFolder::Make("rodeira-joint-forces").value();
};

TEST_F(JointForcesRun, AreRecordedVerifiedAndBranchedOnRequest) {
  const std::vector<std::string> request{"--set", "nodes.ego.outputs=[joint_forces]"};
  const Ended with = Drive("with.mcap", request);
  ASSERT_EQ(with.status, 0) << with.out;
  const Ended verified = RunCommand({Bin("rodeira"), "replay", File("with.mcap"), "--verify"});
  EXPECT_EQ(verified.status, 0) << verified.out;
  const Ended later = RunCommand({Bin("rodeira"), "replay", File("with.mcap"), "--verify", "--from", "1"});
  EXPECT_EQ(later.status, 0) << later.out;
  const Ended branch = RunCommand({Bin("rodeira"), "replay", File("with.mcap"), "--from", "1", "--branch", "seed=2",
                                   "--for", "0.3", "--record", File("branch.mcap")});
  ASSERT_EQ(branch.status, 0) << branch.out;
  const Ended again = RunCommand({Bin("rodeira"), "replay", File("branch.mcap"), "--verify"});
  EXPECT_EQ(again.status, 0) << again.out;
  const std::string forces = Table("with.mcap", "joint_forces");
  for (const char* name : {"fl_lower_ball", "rr_toe_outer", "front_bar"})
    EXPECT_NE(forces.find(name), std::string::npos) << name;
  EXPECT_NE(Table("branch.mcap", "joint_forces").find("fl_lower_ball"), std::string::npos);
  const Ended without = Drive("without.mcap", {});
  ASSERT_EQ(without.status, 0) << without.out;
  EXPECT_EQ(Table("without.mcap", "vehicle_state"), Table("with.mcap", "vehicle_state"))
      << "the car drives the same bits with the topic and without it";
  const Ended info = RunCommand({Bin("rodeira"), "info", File("without.mcap")});
  EXPECT_EQ(info.out.find("joint_forces"), std::string::npos) << info.out;
}

TEST_F(JointForcesRun, OfACarWithoutJointsAreRefused) {
  const Ended ended =
      RunCommand({Bin("rodeira"), "run", system_test::LaunchFile("first_drive.yaml"), "--in-process", "--headless",
                  "--no-record", "--for", "1", "--json", "--set", "nodes.ego.outputs=[joint_forces]"});
  EXPECT_EQ(ended.status, 2) << ended.out;
  EXPECT_NE(ended.out.find("vehicle.no_joints"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace rodeira
