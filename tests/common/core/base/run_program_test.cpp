// SPDX-License-Identifier: Apache-2.0
// Programs of the system as children: what a shell is told to do is what is found of it.
#include "common/core/base/run_program.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include <cstdlib>

namespace rodeira::base {
namespace {

ProgramRun Shell(const std::string& script) {
  ProgramRun run;
  run.program = "/bin/sh";
  run.arguments = {"-c", script};
  return run;
}

TEST(RunProgram, GivesStatusAndErrors) {
  const auto end = RunProgram(Shell("echo lost; echo one >&2; echo two >&2; exit 3"));
  ASSERT_TRUE(end);
  EXPECT_EQ(end.value().status, 3);
  EXPECT_EQ(end.value().signal, 0);
  EXPECT_EQ(end.value().text, "one\ntwo\n");
}

TEST(RunProgram, KeepsWhatComesOnAnotherDescriptor) {
  ProgramRun run = Shell("echo three >&3; echo two >&2; [ $(cut -d ' ' -f 5 /proc/$$/stat) = $$ ]");
  run.text_descriptor = 3;
  run.is_own_group = true;
  const auto end = RunProgram(run);
  ASSERT_TRUE(end.ok());
  EXPECT_EQ(end.value().text, "three\n");
  EXPECT_EQ(end.value().status, 0) << "the program leads a group of its own";
}

TEST(RunProgram, NamesTheSignalThatEndsIt) {
  const auto end = RunProgram(Shell("kill -ABRT $$"));
  ASSERT_TRUE(end);
  EXPECT_EQ(end.value().signal, SIGABRT);
}

// A program that would not end by itself is killed, by the caller's word or by the limit.
TEST(RunProgram, KillsAProgramThatDoesNotEnd) {
  ProgramRun run = Shell("while :; do :; done");
  run.stop = [asked = 0]() mutable { return ++asked > 3; };
  auto end = RunProgram(run);
  ASSERT_TRUE(end);
  EXPECT_TRUE(end.value().stopped);
  run.stop = {};
  run.limit = std::chrono::seconds(1);
  end = RunProgram(run);
  ASSERT_TRUE(end);
  EXPECT_TRUE(end.value().too_long);
  EXPECT_FALSE(end.value().stopped);
}

// More than a pipe holds, and more than is kept: the program is not held up.
TEST(RunProgram, KeepsTheBeginningOfALongText) {
  ProgramRun run = Shell("yes 0123456789 | head -c 1000000 >&2");
  run.text_limit_bytes = 1000;
  const auto end = RunProgram(run);
  ASSERT_TRUE(end);
  EXPECT_EQ(end.value().status, 0);
  EXPECT_EQ(end.value().text.size(), 1000u);
}

TEST(RunProgram, SetsVariablesThatAreNotSet) {
  ProgramRun run = Shell("printf '%s %s' \"$RODEIRA_TEST_NEW\" \"$PATH\" >&2");
  run.environment = {{"RODEIRA_TEST_NEW", "new"}, {"PATH", "other"}};
  const auto end = RunProgram(run);
  ASSERT_TRUE(end);
  EXPECT_EQ(end.value().text, std::string("new ") + std::getenv("PATH"));
}

TEST(RunProgram, FindsProgramsInPath) {
  ASSERT_TRUE(FindInPath("sh"));
  EXPECT_EQ(FindInPath("sh")->filename(), "sh");
  EXPECT_FALSE(FindInPath("rodeira-no-such-program"));
  ProgramRun run;
  run.program = "/no/such/program";
  const auto end = RunProgram(run);
  ASSERT_FALSE(end);
  EXPECT_EQ(end.error().exit_status(), 1);
}

}  // namespace
}  // namespace rodeira::base
