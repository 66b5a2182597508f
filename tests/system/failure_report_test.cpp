// SPDX-License-Identifier: Apache-2.0
// A run that failed leaves one file with what is known of it, and names it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class FailureReport : public ::testing::Test {
 protected:
  std::vector<std::string> Command(const std::string& run_name) const {
    return {Bin("rodeira"), "run",      LaunchFile("empty.yaml"), "--for", "1000", "--pace", "real", "--run",
            run_name,       "--record", Recording().string()};
  }
  std::filesystem::path Recording() const { return folder_.path() / "drive.mcap"; }
  std::string Report() const {
    const auto text = base::ReadText(folder_.path() / "drive-failure.txt", 1u << 20);
    return text.ok() ? text.value() : "";
  }
  base::TemporaryFolder folder_ = std::move(base::TemporaryFolder::Make("rodeira-failure")).value();
};

TEST_F(FailureReport, ACrashLeavesItsBacktrace) {
  Started run(Command("failure-crash"));
  ASSERT_TRUE(Runs("failure-crash"));
  const auto victims = ProcessesWith("--run failure-crash", "--node b");
  ASSERT_EQ(victims.size(), 1u);
  ::kill(victims[0], SIGSEGV);
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("report of the failure: " + (folder_.path() / "drive-failure.txt").string()));
  EXPECT_THAT(ended.out, Not(HasSubstr("backtrace")));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_THAT(Report(), AllOf(HasSubstr("== last lines of b ==\nrodeira: crash: SIGSEGV; backtrace:\n"),
                              HasSubstr("rodeira-empty(+0x")));
#endif
  EXPECT_THAT(Report(), AllOf(HasLine("fault       node 'b' … signal 11"), HasSubstr("part        clock: "),
                              HasSubstr("rodeira: launch/1")));
}

TEST_F(FailureReport, StoppedRunsAndWrongInputLeaveNone) {
  Started run(Command("failure-none"));
  ASSERT_TRUE(Runs("failure-none"));
  ::kill(run.pid(), SIGINT);
  EXPECT_EQ(run.Wait(20s).status, 0);
  EXPECT_EQ(RunCommand({Bin("rodeira"), "run", LaunchFile("empty.yaml"), "--record",
                        (folder_.path() / "other.mcap").string(), "--set", "nodes.b.config.nonsense=1"})
                .status,
            2);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "drive-failure.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "other-failure.txt"));
}

}  // namespace
}  // namespace rodeira::system_test
