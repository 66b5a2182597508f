// SPDX-License-Identifier: Apache-2.0
// Every node, restored at any step in a fresh process, gives the same bits from there on.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "common/core/base/files.hpp"
#include "common/core/base/mathematics.hpp"
#include "common/core/base/random.hpp"
#include "common/runtime/launch/launch.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "launch/rodeira/run/local_nodes.hpp"
#include "tests/tree.hpp"

namespace rodeira {
namespace {

constexpr lockstep::Step kLast = 9000;

std::string OutputOf(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  char text[256] = {};
  const bool read = std::fgets(text, sizeof(text), pipe) != nullptr;
  ::pclose(pipe);
  std::string line = read ? text : "";
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line;
}

void ExpectRestorable(const std::string& launch_file) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-restore-" + std::to_string(::getpid()));
  const auto launch = launch::Launch::Load(launch_file);
  ASSERT_TRUE(launch.ok()) << launch.error().Text();
  // Steps that are no round numbers, and no multiples of any period.
  const lockstep::Step every =
      1500 + static_cast<lockstep::Step>(base::RandomBits({static_cast<std::uint64_t>(::getpid())}) % 997);
  auto nodes = cli::LocalNodes::Make(launch.value());
  ASSERT_TRUE(nodes.ok()) << nodes.error().Text();
  lockstep::InProcessSettings settings;
  settings.last_step = kLast;
  settings.snapshot_every = every;
  settings.on_snapshot = [&](const lockstep::Snapshot& snapshot) {
    const auto path = folder / std::to_string(snapshot.at) / (std::to_string(snapshot.node) + ".snapshot");
    ASSERT_TRUE(base::WriteWhole(path, snapshot.Encode()).ok());
  };
  const auto whole = lockstep::RunThreaded(launch.value().roster(), nodes.value().nodes(), settings);
  ASSERT_TRUE(whole.ok) << whole.fault;
  int resumed = 0;
  for (lockstep::Step step = every; step + 100 < kLast; step += every, ++resumed) {
    const std::string command = BinaryDir() + "/bin/resume_run " + launch_file + " " +
                                (folder / std::to_string(step)).string() + " " + std::to_string(step) + " " +
                                std::to_string(kLast);
    EXPECT_EQ(OutputOf(command), base::Hex(whole.digest)) << "from step " << step;
  }
  EXPECT_GE(resumed, 3);
  std::filesystem::remove_all(folder);
}

TEST(Restore, TheFirstDrive) { ExpectRestorable(SourceDir() + "/tests/data/drive_without_recorder.yaml"); }
TEST(Restore, TheAutopilotAndTheTrafficOfN222) { ExpectRestorable(SourceDir() + "/tests/data/n222_traffic.yaml"); }
TEST(Restore, EmptyNodes) { ExpectRestorable(SourceDir() + "/launch/empty.yaml"); }

}  // namespace
}  // namespace rodeira

// The runs here must compute like the programs do (law L7).
int main(int argc, char** argv) {
  rodeira::base::PinMathLibrary(argv);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
