// SPDX-License-Identifier: Apache-2.0
// `rodeira joysticks`, and what the doctor says of them.
#include "launch/rodeira/commands/joysticks_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using system_test::Bin;
using system_test::RunCommand;
using ::testing::HasSubstr;

const input_devices::JoystickInfo kWheel{"A wheel", "030000006d0400004fc2000011010000", 4, 25};

TEST(JoysticksCommand, ListsWhatIsThere) {
  EXPECT_THAT(JoystickTable({kWheel}), HasSubstr("030000006d0400004fc2000011010000     4       25  A wheel\n"));
  EXPECT_THAT(JoystickTable({}), HasSubstr("no device is connected"));
  const auto ended = RunCommand({Bin("rodeira"), "joysticks"});
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_FALSE(ended.out.empty());
  EXPECT_EQ(RunCommand({Bin("rodeira"), "joysticks", "--wach"}).status, 2);
  EXPECT_EQ(RunCommand({Bin("rodeira"), "joysticks", "--for", "3"}).status, 2) << "of nothing";
}

TEST(JoysticksCommand, SaysWhatMoves) {
  input_devices::DeviceReading before{true, {0.0, 32767.0}, {0, 0}};
  EXPECT_EQ(JoystickMoves("A wheel", before, {true, {300.0, 32767.0}, {0, 0}}), "") << "noise";
  EXPECT_EQ(JoystickMoves("A wheel", before, {true, {700.0, 32767.0}, {0, 1}}),
            "A wheel: axis 0: 0 -> 700\nA wheel: button 1: down\n");
  EXPECT_EQ(JoystickMoves("A wheel", before, {true, {900.0, 32767.0}, {0, 1}}), "") << "since the last line";
  EXPECT_EQ(JoystickMoves("A wheel", before, {false, {}, {}}), "A wheel: was unplugged\n");
  EXPECT_EQ(JoystickMoves("A wheel", before, {true, {0.0, 0.0}, {0, 0}}), "A wheel: is there\n");
}

TEST(JoysticksCommand, TheDoctorNamesThemAndTheDevicesThatMayNotBeRead) {
  const TemporaryFolder folder;
  EXPECT_EQ(CheckJoysticks({kWheel}, folder.path()).verdict, Verdict::kOk);
  EXPECT_THAT(CheckJoysticks({kWheel}, folder.path()).sentence, HasSubstr(kWheel.guid));
  EXPECT_EQ(CheckJoysticks({}, folder.path()).verdict, Verdict::kOk);
  // Root may read everything, so the device leads nowhere: that no user can read.
  std::filesystem::create_symlink("nowhere", folder.path() / "event3");
  const Finding closed = CheckJoysticks({}, folder.path());
  EXPECT_EQ(closed.verdict, Verdict::kWarning);
  EXPECT_THAT(closed.sentence, HasSubstr("group input"));
}

}  // namespace
}  // namespace rodeira::cli
