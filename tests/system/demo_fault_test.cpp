// SPDX-License-Identifier: Apache-2.0
// Each process of the demo killed and stopped in turn while it drives: named within a second, status 1, no process
// left, and the recording readable.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <tuple>

#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

// Until so much of a recording has reached the disk: the run drives then.
bool WaitForBytes(const std::string& path, std::uintmax_t bytes, std::chrono::seconds limit) {
  const auto until = std::chrono::steady_clock::now() + limit;
  std::error_code problem;
  while (std::chrono::steady_clock::now() < until) {
    const auto size = std::filesystem::file_size(path, problem);
    if (!problem && size > bytes) return true;
    ::usleep(5000);
  }
  return false;
}

class DemoFault : public ::testing::TestWithParam<std::tuple<std::string, int>> {
 protected:
  const cli::TemporaryFolder folder_;
};

TEST_P(DemoFault, IsNamedWithinASecondAndTheRecordingIsReadable) {
  const auto& [node, signal] = GetParam();
  const std::string run_name = "demo-fault-" + node + std::to_string(signal);
  const std::string recording = (folder_.path() / "cut.mcap").string();
  Started run({Bin("rodeira"), "run", LaunchFile("demo.yaml"), "--headless", "--for", "1000", "--pace", "real", "--run",
               run_name, "--record", recording, "--set",
               "nodes.view.config.frames.folder=" + (folder_.path() / "frames").string(), "--set",
               "nodes.view.config.width_px=160", "--set", "nodes.view.config.height_px=90"});
  ASSERT_TRUE(WaitForBytes(recording, 50'000, 60s));
  const auto victims = ProcessesWith("--run " + run_name, node == "clock" ? "/rodeira-clock" : "--node " + node);
  ASSERT_EQ(victims.size(), 1u);
  ::kill(victims[0], signal);
  const std::string named = node == "clock" ? "the clock" : "node '" + node + "'";
  const auto took =
      run.WaitFor(named + (signal == SIGKILL ? " was killed by signal 9" : " was stopped by signal 19"), 10s);
  const Ended ended = run.Wait(20s);
  EXPECT_GE(took, 0ms) << ended.out;
  EXPECT_LE(took, 1000ms) << ended.out;
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_TRUE(ProcessesWith("--run " + run_name).empty());

  const Ended info = RunCommand({Bin("rodeira"), "info", recording});
  EXPECT_EQ(info.status, node == "recorder" ? 1 : 0) << info.out;
  const auto reader = record::McapReader::Open(recording);
  ASSERT_TRUE(reader.ok()) << reader.error().Text();
  EXPECT_GT(reader.value().statistics().messages, 500u) << "a second of driving, or as much as a chunk takes";
  if (node == "recorder") return;  // what it had on the disk is there
  EXPECT_TRUE(reader.value().condition().whole);
  EXPECT_TRUE(reader.value().Verify().empty());
  const auto end = reader.value().FindMetadata("rodeira.end");
  ASSERT_TRUE(end.ok() && end.value());
  EXPECT_EQ(end.value()->entries.at("complete"), "false");
  // Time stopped everywhere at one step: every source's samples reach it, none is beyond.
  const std::int64_t last = std::stoll(end.value()->entries.at("last_step"));
  std::map<std::pair<std::string, std::uint32_t>, std::int64_t> newest;
  for (const Recorded& sample : SamplesOf(recording)) {
    if (sample.topic != idl::topics::kSnapshot)
      newest[{sample.topic, sample.source}] = sample.step;  // they are a second apart
  }
  EXPECT_EQ(newest.size(), 6u) << "controls, the car and what it touches, traffic, its details and its lights";
  for (const auto& [stream, step] : newest) {
    EXPECT_LE(step, last) << stream.first;
    EXPECT_GT(step, last - 10) << stream.first << ": the slowest period is ten steps";
  }
}

std::string NameOf(const ::testing::TestParamInfo<DemoFault::ParamType>& of) {
  return std::get<0>(of.param) + (std::get<1>(of.param) == SIGKILL ? "_killed" : "_stopped");
}

INSTANTIATE_TEST_SUITE_P(EachNode, DemoFault,
                         ::testing::Combine(::testing::Values("clock", "road", "driver", "ego", "traffic", "recorder",
                                                              "view"),
                                            ::testing::Values(SIGKILL, SIGSTOP)),
                         NameOf);

}  // namespace
}  // namespace rodeira::system_test
