// SPDX-License-Identifier: Apache-2.0
// Digests of whole runs, pinned: a refactoring keeps them. A change of behaviour changes them on purpose, is named in
// docs/changelog.md, and brings the new digests.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/hash.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

struct PinnedRun {
  const char* launch_file;
  const char* digest;  // of ten seconds without a view
};

void PrintTo(const PinnedRun& run, std::ostream* out) { *out << run.launch_file; }

class PinnedRuns : public ::testing::TestWithParam<PinnedRun> {};

TEST_P(PinnedRuns, KeepTheirDigest) {
  const auto ended = system_test::RunCommand(
      {system_test::Bin("rodeira"), "run", system_test::LaunchFile(GetParam().launch_file), "--in-process",
       "--headless", "--no-record", "--for", "10", "--set", "nodes.view.kind=none"});
  ASSERT_EQ(ended.status, 0) << ended.out;
  EXPECT_EQ(system_test::DigestIn(ended.out), GetParam().digest);
}

INSTANTIATE_TEST_SUITE_P(
    LaunchFiles, PinnedRuns,
    ::testing::Values(PinnedRun{"demo.yaml", "2505b58430c63d34"}, PinnedRun{"first_drive.yaml", "29aa6c40f861ad31"},
                      PinnedRun{"scripted.yaml", "762c30527b10ef14"}, PinnedRun{"car_ahead.yaml", "28687a59046a5daf"},
                      PinnedRun{"rain.yaml", "ae7263a403afaa4d"}, PinnedRun{"lights.yaml", "fa3c35f156b02d8c"}));

struct PinnedTraffic {
  const char* map;
  const char* vehicles;
  const char* seconds;
  const char* digest;  // of trajectories.csv
};

void PrintTo(const PinnedTraffic& traffic, std::ostream* out) { *out << traffic.map; }

// The first `count` columns of a CSV text.
std::string FirstColumns(const std::string& text, std::size_t count) {
  std::string kept;
  std::size_t column = 0;
  for (const char letter : text) {
    if (letter == '\n')
      column = 0;
    else if (letter == ',')
      ++column;
    if (column < count) kept += letter;
  }
  return kept;
}

class PinnedTrajectories : public ::testing::TestWithParam<PinnedTraffic> {};

TEST_P(PinnedTrajectories, KeepTheirDigest) {
  const auto folder = base::TemporaryFolder::Make("rodeira-pinned").value();
  const auto ended = system_test::RunCommand({system_test::Bin("rodeira"), "traffic", "run",
                                              SourceDir() + "/" + GetParam().map, "--vehicles", GetParam().vehicles,
                                              "--for", GetParam().seconds, "--quiet", "--csv", folder.path().string()});
  ASSERT_EQ(ended.status, 0) << ended.out;
  const auto text = base::ReadText(folder.path() / "trajectories.csv");
  ASSERT_TRUE(text) << text.error().Text();
  // The columns that the file had when the digests were taken; behind them stand size, kind and lamps.
  EXPECT_EQ(base::Hex(base::Hash(FirstColumns(text.value(), 11))), GetParam().digest);
}

INSTANTIATE_TEST_SUITE_P(Maps, PinnedTrajectories,
                         ::testing::Values(PinnedTraffic{"configs/maps/town.motors", "40", "60", "86d3576586066ee2"},
                                           PinnedTraffic{"configs/maps/roundabout.motors", "30", "60",
                                                         "f923dae30a000e68"},
                                           PinnedTraffic{"configs/worlds/n222.yaml", "40", "30", "0d4db264c1b7eb5e"}));

system_test::Ended Verify(const std::string& recording) {
  return system_test::RunCommand(
      {system_test::Bin("rodeira"), "replay", "--verify", SourceDir() + "/tests/data/recordings/" + recording});
}

// 0.2 s of scripted.yaml, recorded by the first program with the aligning moment in its cars.
TEST(PinnedRecording, OfAnEarlierProgramIsComputedAgain) {
  const auto ended = Verify("scripted_aligning.mcap");
  EXPECT_EQ(ended.status, 0) << ended.out;
  EXPECT_NE(ended.out.find("identical: 200 steps"), std::string::npos) << ended.out;
}

// The same, recorded by the program of commit 2c2fa2f4, without the aligning moment.
TEST(PinnedRecording, OfAnotherVehicleModelIsTold) {
  const auto ended = Verify("scripted_2c2fa2f4.mcap");
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_NE(ended.out.find("node 'ego', topic rodeira/vehicle_state"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("recorded by another program"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace rodeira
