// SPDX-License-Identifier: Apache-2.0
// The second table of docs/reference/ends.md: a node that ends by itself in the middle of a run, by each cause under
// each policy, with real processes.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/ends_table.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

constexpr std::array kPolicies = {"stop", "pause", "restart"};
// What the table calls a cause, and what nodes/empty calls it (`end_by`).
const std::map<std::string, std::string> kCauses = {
    {"an error of its step", "failure"}, {"exit(0)", "exit_0"},  {"exit(1)", "exit_1"}, {"an exception", "exception"},
    {"a failed assertion", "assertion"}, {"no memory", "memory"}};

std::vector<EndsRow> ReadRows() {
  return EndsRowsOf([](const std::string& cause) { return kCauses.contains(cause); });
}

class EndsByItself : public testing::TestWithParam<std::string> {
 protected:
  // Four nodes beside a recorder, so that a node can be started again.
  const cli::TemporaryFolder folder_;
  const std::string launch_ =
      folder_
          .Write("four.yaml",
                 "rodeira: launch/1\nduration_s: 1\nnodes: {a: {kind: empty}, b: {kind: empty}, c: {kind: empty}, "
                 "d: {kind: empty}, recorder: {kind: recorder}}\n")
          .string();
  std::vector<std::string> Command(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> command{Bin("rodeira"),
                                     "run",
                                     launch_,
                                     "--run",
                                     name,
                                     "--pace",
                                     "max",
                                     "--record",
                                     (folder_.path() / (name + ".mcap")).string(),
                                     "--set",
                                     "limits.step_s=5"};  // a step that fills memory is long under load
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
};

TEST_P(EndsByItself, AsTheTableSays) {
  const std::vector<EndsRow> rows = ReadRows();
  const auto row = std::ranges::find(rows, GetParam(), &EndsRow::cause);
  ASSERT_EQ(rows.size(), kCauses.size()) << "docs/reference/ends.md";
  ASSERT_NE(row, rows.end()) << GetParam();
  const Ended calm = RunCommand(Command(fmt::format("by-itself-{}-calm", ::getpid()), {}));
  ASSERT_EQ(calm.status, 0) << calm.out;
  for (std::size_t p = 0; p < kPolicies.size(); ++p) {
    const std::string name = fmt::format("by-itself-{}-{}", ::getpid(), kPolicies[p]), outcome = row->outcomes[p];
    const std::string once = (folder_.path() / (name + ".once")).string();
    Started run(Command(
        name, {"--set", fmt::format("recovery={}", kPolicies[p]), "--set", "nodes.b.config.end_at_step=200", "--set",
               "nodes.b.config.end_by=" + kCauses.at(row->cause), "--set", "nodes.b.config.end_once=" + once}));
    if (outcome == "waits") {
      EXPECT_GE(run.WaitFor("the run waits", 20s), 0ms) << name;
      ::kill(run.pid(), SIGTERM);
    }
    const Ended ended = run.Wait(40s);
    EXPECT_NE(ended.out.find(row->message), std::string::npos) << name << ": " << ended.out;
    EXPECT_EQ(ended.status, outcome == "goes on" ? 0 : 1) << name << ": " << ended.out;
    if (outcome == "goes on") {
      EXPECT_EQ(DigestIn(ended.out), DigestIn(calm.out)) << name << ": " << ended.out;
    }
    EXPECT_TRUE(ProcessesWith("--run " + name).empty()) << name;
    EXPECT_TRUE(std::filesystem::exists(once)) << name << ": the cause did not come";
    EXPECT_EQ(RunCommand({Bin("rodeira"), "info", (folder_.path() / (name + ".mcap")).string()}).status, 0)
        << name << ": the recording is not closed";
  }
}

INSTANTIATE_TEST_SUITE_P(Causes, EndsByItself,
                         testing::Values("an error of its step", "exit(0)", "exit(1)", "an exception",
                                         "a failed assertion", "no memory"),
                         [](const auto& cause) { return kCauses.at(cause.param); });

}  // namespace
}  // namespace rodeira::system_test
