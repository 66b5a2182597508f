// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/command_text.hpp"

#include <gtest/gtest.h>

namespace rodeira::launch {
namespace {

using Kind = lockstep::Command::Kind;

TEST(CommandText, ReadsWhatAnOperatorSays) {
  EXPECT_EQ(ParseCommand("pause").value().kind, Kind::kPause);
  EXPECT_EQ(ParseCommand("  resume \r\n").value().kind, Kind::kResume);
  EXPECT_EQ(ParseCommand("step").value().steps, 1);
  EXPECT_EQ(ParseCommand("step 1000000000").value().steps, 1'000'000'000);
  EXPECT_EQ(ParseCommand("pace 0.25").value().pace, 0.25);
  EXPECT_EQ(ParseCommand("pace real").value().pace, 1.0);
  EXPECT_EQ(ParseCommand("pace max").value().pace, 0.0);
  EXPECT_EQ(ParseCommand("restart ego").value().text, "ego");
  EXPECT_EQ(ParseCommand("mark  second lap, 3 km ").value().text, "second lap, 3 km");
  EXPECT_EQ(ParseCommand("mark a\x1b[2J").value().text, "a\\x1b[2J") << "nothing that moves a cursor";
  ASSERT_FALSE(CommandNames().empty());
  for (const std::string& name : CommandNames()) {
    if (name != "pace" && name != "mark" && name != "restart") {
      EXPECT_TRUE(ParseCommand(name).ok()) << name;
    }
  }
}

TEST(CommandText, RefusesNonsenseWithASentence) {
  const auto refused = [](std::string_view line) {
    const auto command = ParseCommand(line);
    if (command.ok()) return std::string("taken");
    EXPECT_EQ(command.error().exit_status(), 2);
    return command.error().Text();
  };
  EXPECT_EQ(refused("puase"), "unknown command 'puase'; did you mean 'pause'?");
  EXPECT_NE(refused("").find("unknown command ''; known are pause, resume"), std::string::npos) << refused("");
  EXPECT_EQ(refused("restart"), "restart: the name of a node was expected");
  EXPECT_EQ(refused("pace 0"), "pace: '0' was found; max, real or a positive number was expected");
  EXPECT_EQ(refused("pace -1"), "pace: '-1' was found; max, real or a positive number was expected");
  EXPECT_EQ(refused("pace nan"), "pace: 'nan' was found; max, real or a positive number was expected");
  EXPECT_EQ(refused("pace"), "pace: '' was found; max, real or a positive number was expected");
  EXPECT_EQ(refused("step 0"), "step: '0' was found; a number of base steps from 1 to 1000000000 was expected");
  EXPECT_EQ(refused("step 99999999999999999999"),
            "step: '99999999999999999999' was found; a number of base steps from 1 to 1000000000 was expected");
  EXPECT_EQ(refused("step two"), "step: 'two' was found; a number of base steps from 1 to 1000000000 was expected");
  EXPECT_EQ(refused("mark"), "mark: a text was expected");
  EXPECT_EQ(refused("mark " + std::string(501, 'x')), "mark: 501 bytes of text were found, at most 500 were expected");
  EXPECT_EQ(refused("stop now"), "stop: 'now' was found behind it; nothing was expected");
}

}  // namespace
}  // namespace rodeira::launch
