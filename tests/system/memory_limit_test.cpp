// SPDX-License-Identifier: Apache-2.0
// A control group's limit of memory, as containers have it: the kernel kills a process without asking it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::uint64_t kLimit_bytes = std::uint64_t{250} << 20;

// A new group with a limit of memory, below this process's own; version 1 or 2 of control groups.
class ControlGroup {
 public:
  ControlGroup() {
    for (const auto& [parent, limit] : Parents()) {
      const std::filesystem::path folder = parent / fmt::format("rodeira-test-{}", ::getpid());
      std::error_code error;
      if (!std::filesystem::create_directory(folder, error)) continue;
      std::ofstream file(folder / limit);
      file << kLimit_bytes << std::flush;
      if (file) {
        folder_ = folder;
        return;
      }
      std::filesystem::remove(folder, error);
    }
  }
  ~ControlGroup() {
    // A killed process leaves its group when its last thread has ended.
    for (int i = 0; i < 1000 && !folder_.empty() && ::rmdir(folder_.c_str()) != 0; ++i) ::usleep(10'000);
  }
  ControlGroup(const ControlGroup&) = delete;
  ControlGroup& operator=(const ControlGroup&) = delete;
  bool is_made() const { return !folder_.empty(); }
  std::vector<std::string> With(const std::vector<std::string>& command) const {
    std::vector<std::string> words{"/bin/sh", "-c", "echo $$ > \"$0\" && exec \"$@\"",
                                   (folder_ / "cgroup.procs").string()};
    words.insert(words.end(), command.begin(), command.end());
    return words;
  }

 private:
  struct Parent {
    std::filesystem::path folder;
    std::string limit;  // the file of the limit
  };
  static std::vector<Parent> Parents() {
    std::vector<Parent> parents;
    std::ifstream file("/proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
      const auto path = line.find(":/");
      if (path == std::string::npos) continue;
      const std::string below = line.substr(path + 2);
      if (line.find(":memory:") != std::string::npos) {
        for (const std::string& place : {below, std::string()})
          parents.push_back({std::filesystem::path("/sys/fs/cgroup/memory") / place, "memory.limit_in_bytes"});
      }
      if (line.starts_with("0::")) parents.push_back({std::filesystem::path("/sys/fs/cgroup") / below, "memory.max"});
    }
    return parents;
  }
  std::filesystem::path folder_;
};

class MemoryLimit : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!group_.is_made()) GTEST_SKIP() << "no control group with a limit of memory can be made here";
  }
  std::vector<std::string> Command(const std::string& name, const std::vector<std::string>& more = {}) const {
    // The kernel looks long for memory before it kills, so a step may be long.
    std::vector<std::string> command{Bin("rodeira"),
                                     "run",
                                     launch_,
                                     "--run",
                                     name,
                                     "--set",
                                     "limits.step_s=60",
                                     "--record",
                                     (folder_.path() / (name + ".mcap")).string()};
    command.insert(command.end(), more.begin(), more.end());
    return command;
  }
  std::vector<std::string> Filling(const std::string& name, const std::string& policy) const {
    return group_.With(
        Command(name, {"--pace", "max", "--set", "recovery=" + policy, "--set", "nodes.b.config.end_at_step=200",
                       "--set", "nodes.b.config.end_by=memory_of_group", "--set",
                       "nodes.b.config.end_once=" + (folder_.path() / (name + ".once")).string()}));
  }
  const cli::TemporaryFolder folder_;
  const ControlGroup group_;
  const std::string launch_ =
      folder_
          .Write("two.yaml",
                 "rodeira: launch/1\nduration_s: 1\nnodes: {a: {kind: empty}, b: {kind: empty}, recorder: {kind: "
                 "recorder}}\n")
          .string();
};

TEST_F(MemoryLimit, ANodeThatTheKernelKillsIsNamedWithTheCause) {
  const Ended ended = RunCommand(Filling("group-stop", "stop"));
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, HasLine("rodeira: node 'b' … (Killed; … lack of memory"));
  EXPECT_TRUE(ProcessesWith("--run group-stop").empty());
  EXPECT_EQ(RunCommand({Bin("rodeira"), "info", (folder_.path() / "group-stop.mcap").string()}).status, 0);
}

TEST_F(MemoryLimit, ANodeThatTheKernelKillsIsStartedAgainWithTheSameBits) {
  const Ended calm = RunCommand(Command("group-calm", {"--pace", "max"}));
  ASSERT_EQ(calm.status, 0) << calm.out;
  const Ended ended = RunCommand(Filling("group-restart", "restart"));
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "group-restart.once")) << "the cause did not come";
  EXPECT_EQ(DigestIn(ended.out), DigestIn(calm.out)) << ended.out;
}

// A kill by a person is not said to be one for lack of memory.
TEST_F(MemoryLimit, AKillByAPersonHasNoSuchCause) {
  Started run(group_.With(Command("group-person", {"--for", "1000", "--pace", "0.1"})));
  ASSERT_TRUE(Runs("group-person"));
  const auto nodes = ProcessesWith("--run group-person", "--node b");
  ASSERT_EQ(nodes.size(), 1u);
  ::kill(nodes.front(), SIGKILL);
  const Ended ended = run.Wait(20s);
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("signal 9 (Killed)"));
  EXPECT_THAT(ended.out, Not(HasSubstr("lack of memory")));
}

}  // namespace
}  // namespace rodeira::system_test
