// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {

// A run of six parts with recovery, and an undisturbed recording to compare with.
class Recovery : public ::testing::Test {
 protected:
  static inline const std::string kLaunch = SourceDir() + "/tests/data/n222_traffic.yaml";
  static inline const std::vector<std::string> kParts{"clock", "road", "driver", "ego", "traffic", "recorder"};

  static std::vector<pid_t> ProcessesOf(const std::string& run, const std::string& part) {
    return ProcessesWith("--run " + run, part == "clock" ? "/rodeira-clock" : "--node " + part);
  }

  static pid_t Find(const std::string& run, const std::string& part) {
    return ProcessWith("--run " + run, part == "clock" ? "/rodeira-clock" : "--node " + part);
  }

  // Until a recording is closed, without a pause: what its recorder does then takes microseconds.
  static void AwaitItsMark(const std::string& recording) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    int file = -1;
    for (; file < 0 && std::chrono::steady_clock::now() < until; ::usleep(1000))
      file = ::open(recording.c_str(), O_RDONLY | O_CLOEXEC);
    char mark[8] = {};
    for (unsigned i = 0; file >= 0 && (i % 1000 != 0 || std::chrono::steady_clock::now() < until); ++i) {
      const off_t size = ::lseek(file, 0, SEEK_END);
      if (size > 100'000 && ::pread(file, mark, 8, size - 8) == 8 && std::string(mark, 8) == "\x89MCAP0\r\n") break;
    }
    if (file >= 0) ::close(file);
  }

  std::string File(const std::string& name) const { return (folder_.path() / name).string(); }
  // At a pace: a fast machine's run would be over before a node was killed.
  std::vector<std::string> Command(const std::string& run, const std::string& recording, const std::string& seconds,
                                   const std::string& policy) const {
    return {Bin("rodeira"),
            "run",
            kLaunch,
            "--run",
            run,
            "--for",
            seconds,
            "--record",
            recording,
            "--pace",
            "2",
            "--set",
            "recovery=" + policy};
  }
  void Undisturbed(const std::string& seconds) {
    const Ended calm =
        RunCommand({Bin("rodeira"), "run", kLaunch, "--in-process", "--for", seconds, "--record", File("calm.mcap")});
    ASSERT_EQ(calm.status, 0) << calm.out;
    digest_ = DigestIn(calm.out);
    samples_ = SamplesOf(File("calm.mcap"));
    ASSERT_GT(samples_.size(), 1000u);
  }
  void ExpectUndisturbed(const Ended& ended, const std::string& recording) const {
    ASSERT_EQ(ended.status, 0) << ended.out;
    EXPECT_EQ(DigestIn(ended.out), digest_) << ended.out;
    EXPECT_EQ(FirstDifference(samples_, SamplesOf(recording)), "") << ended.out;
    const Ended info = RunCommand({Bin("rodeira"), "info", recording});
    EXPECT_EQ(info.status, 0) << info.out;
  }
  const cli::TemporaryFolder folder_;
  std::string digest_;
  std::vector<Recorded> samples_;
};

}  // namespace rodeira::system_test
