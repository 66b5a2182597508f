// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/command_answer.hpp"

#include <gtest/gtest.h>

#include "common/runtime/launch/command_text.hpp"
#include "common/runtime/lockstep/clock.hpp"
#include "common/runtime/lockstep/run_controller.hpp"

namespace rodeira::launch {
namespace {

using Done = base::Result<std::string>;

TEST(CommandAnswer, IsOneLineWithTheIdOfAnError) {
  EXPECT_EQ(AnswerLine(Done(std::string("paused at step 3"))), "ok paused at step 3");
  EXPECT_EQ(AnswerLine(Done(std::string("two\nlines"))), "ok two lines");
  EXPECT_EQ(AnswerLine(Done(base::WrongInput("command.wrong_value", "a text was expected", "mark"))),
            "wrong command.wrong_value mark: a text was expected");
  EXPECT_EQ(AnswerLine(Done(base::Failed("run.not_running", "the run is ending"))),
            "failed run.not_running the run is ending");
}

// Every error of a command keeps its id, its sentence and its status.
TEST(CommandAnswer, ReadsWhatWasWritten) {
  const lockstep::Roster roster =
      lockstep::Roster::Create(1'000'000, 8, {{"car", "t", lockstep::Role::kStepped, 1, 0, 0, {"x"}, {}}}).value();
  lockstep::Clock clock(roster, 10);
  lockstep::RunController controller(clock, lockstep::Pacer(roster.base_step_ns(), 1.0));
  std::vector<base::Error> errors;
  for (const char* line : {"", "pose", "step x", "mark", "restart", "pause now", "pace -1"})
    errors.push_back(ParseCommand(line).error());
  for (const char* line : {"pause", "restart cat", "restart car"})
    errors.push_back(controller.Do(ParseCommand(line).value(), {}).error());
  controller.Abort("broken", {});
  errors.push_back(controller.Do(ParseCommand("pause").value(), {}).error());
  for (const base::Error& error : errors) {
    const auto read = ReadAnswer(AnswerLine(Done(error)));
    ASSERT_FALSE(read.ok());
    EXPECT_EQ(read.error().id, error.id) << error.Text();
    EXPECT_EQ(read.error().Text(), error.Text());
    EXPECT_EQ(read.error().exit_status(), error.exit_status());
  }
  EXPECT_EQ(ReadAnswer("ok paused at step 3").value(), "paused at step 3");
}

TEST(CommandAnswer, OfAnotherFormIsAnError) {
  EXPECT_EQ(ReadAnswer("failed run.of_another_version it did").error().id.text(), "run.refused");
  EXPECT_EQ(ReadAnswer("failed run.of_another_version it did").error().Text(), "it did");
  EXPECT_EQ(ReadAnswer("").error().id.text(), "run.no_answer");
  EXPECT_EQ(ReadAnswer("perhaps it did").error().id.text(), "run.no_answer");
}

}  // namespace
}  // namespace rodeira::launch
