// SPDX-License-Identifier: Apache-2.0
// The demo's scenario again and again, every node a process of its own, beside programs that leave it no processor:
// every sample, every digest and every frame is the same. RODEIRA_REPEAT_FOR sets how many seconds are driven (1
// otherwise).
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <thread>

#include "common/core/base/files.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/long_form.hpp"
#include "tests/system/command.hpp"
#include "tests/system/load.hpp"
#include "tests/system/recording.hpp"

namespace rodeira::system_test {
namespace {

std::string Seconds() {
  const char* set = std::getenv("RODEIRA_REPEAT_FOR");
  return set == nullptr ? "1" : set;
}

// What a run of the demo leaves.
struct Left {
  std::string digest;
  std::vector<Recorded> samples;
  std::map<std::string, base::Digest> frames;
};

class Repeat : public ::testing::Test {
 protected:
  Left Drive(const std::string& name, std::vector<std::string> more) const {
    const auto folder = folder_.path() / name;
    const std::string recording = (folder_.path() / (name + ".mcap")).string();
    std::vector<std::string> command{
        Bin("rodeira"), "run", LaunchFile("demo.yaml"), "--headless", "--for", Seconds(), "--record", recording};
    command.insert(command.end(), {"--set", "nodes.view.config.frames.folder=" + folder.string(), "--set",
                                   "nodes.view.config.frames.times_s=[0.5, 1]", "--set",
                                   "nodes.view.config.width_px=320", "--set", "nodes.view.config.height_px=180",
                                   "--set", "nodes.view.config.quality=" + BriefOrLong<std::string>("low", "medium")});
    command.insert(command.end(), more.begin(), more.end());
    const Ended ended = RunCommand(command);
    EXPECT_EQ(ended.status, 0) << ended.out;
    Left left{DigestIn(ended.out), SamplesOf(recording), {}};
    for (const auto& frame : std::filesystem::directory_iterator(folder)) {
      left.frames[frame.path().filename().string()] = base::Hash(base::ReadBytes(frame.path()).value());
    }
    return left;
  }
  const cli::TemporaryFolder folder_;
};

TEST_F(Repeat, RunsOfTheDemoUnderLoadAndOneInOneProcessAreTheSame) {
  const Left first = Drive("0", {});
  ASSERT_EQ(first.digest.size(), 16u);
  ASSERT_GE(first.samples.size(), 1001u + 101u + 101u);  // the car's, the driver's and the traffic's
  ASSERT_EQ(first.frames.size(), 2u);
  const auto expect_same = [&first](const Left& other, const std::string& which) {
    EXPECT_EQ(other.digest, first.digest) << which;
    EXPECT_EQ(FirstDifference(other.samples, first.samples), "") << which;
    EXPECT_EQ(other.frames, first.frames) << which;
  };
  for (unsigned i = 1; i < BriefOrLong(2u, 10u); ++i) {
    const CpuLoad load((1 + (i + 1) % 2) *
                       std::thread::hardware_concurrency());  // as many as there are processors, and twice that
    expect_same(Drive(std::to_string(i), {}), "run " + std::to_string(i) + " under load");
  }
  expect_same(Drive("one_process", {"--in-process"}), "in one process");
}

TEST_F(Repeat, AnotherSeedIsAnotherRun) {
  const Left one = Drive("one", {"--in-process"});
  const Left two = Drive("two", {"--in-process", "--seed", "2"});
  EXPECT_NE(one.digest, two.digest);
  EXPECT_EQ(one.samples.size(), two.samples.size());
  // The traffic is another one from the beginning: the seed is no decoration.
  const std::string where = FirstDifference(one.samples, two.samples);
  EXPECT_NE(where.find("rodeira/traffic_state"), std::string::npos) << where;
  EXPECT_NE(where.find("at step 0 "), std::string::npos) << where;
  EXPECT_NE(one.frames, two.frames);
}

}  // namespace
}  // namespace rodeira::system_test
