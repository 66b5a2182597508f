// SPDX-License-Identifier: Apache-2.0
// docs/tutorials/first-road.md is what a newcomer does: its file, and its commands as they stand there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "common/core/base/files.hpp"
#include "idl/messages.hpp"
#include "idl/topics.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"
#include "tests/tree.hpp"

namespace rodeira::system_test {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

// What stands between the first line that is `fence` and the next line of three strokes, from `at` on, which then lies
// behind it.
std::string BlockOf(const std::string& document, const std::string& fence, std::size_t& at) {
  const std::size_t from = document.find(fence + "\n", at);
  EXPECT_NE(from, std::string::npos) << fence;
  if (from == std::string::npos) return "";
  const std::size_t begin = from + fence.size() + 1, end = document.find("\n```\n", begin);
  at = end + 5;
  return document.substr(begin, end + 1 - begin);
}

class FirstRoad : public ::testing::Test {
 protected:
  FirstRoad() {
    const std::string document = base::ReadText(SourceDir() + "/docs/tutorials/first-road.md").value();
    std::size_t at = 0;
    world_ = BlockOf(document, "```yaml", at);
    std::istringstream lines(BlockOf(document, "\n```", at));
    for (std::string line; std::getline(lines, line);) commands_.push_back(line);
    sentence_ = BlockOf(document, "\n```", at);
    folder_.Write("first_road.yaml", world_);
    // As in the project's folder.
    for (const char* name : {"launch", "configs"})
      fs::create_directory_symlink(fs::path(SourceDir()) / name, folder_.path() / name);
    fs::create_directories(folder_.path() / "build");
    fs::create_directory_symlink(fs::path(Bin("rodeira")).parent_path(), folder_.path() / "build/bin");
  }
  Ended Do(const std::string& line) const {
    return RunCommand({"/usr/bin/env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", "sh", "-c",
                       "cd " + folder_.path().string() + " && " + line});
  }
  // The document's line that says this.
  std::string Line(const std::string& part) const {
    for (const std::string& line : commands_) {
      if (line.find(part) != std::string::npos) return line.substr(0, line.find('#'));
    }
    ADD_FAILURE() << "no command says " << part;
    return "false";
  }
  const cli::TemporaryFolder folder_;
  std::string world_, sentence_;
  std::vector<std::string> commands_;
};

TEST_F(FirstRoad, IsCheckedDrawnAskedAndBuilt) {
  EXPECT_EQ(commands_.size(), 6u);
  const Ended checked = Do(Line("world check"));
  EXPECT_EQ(checked.status, 0) << checked.out;
  EXPECT_EQ(checked.out, "first_road.yaml: no problem found\n");
  EXPECT_EQ(Do(Line("world map")).status, 0);
  EXPECT_THAT(base::ReadText(folder_.path() / "first_road.svg").value(), HasSubstr("valley"));
  EXPECT_THAT(base::ReadText(folder_.path() / "first_road_profile.svg").value(), HasSubstr("valley"));
  EXPECT_THAT(Do(Line("world query")).out, HasSubstr("asphalt"));
  const Ended built = Do(Line("world build"));
  EXPECT_EQ(built.status, 0) << built.out;
  EXPECT_TRUE(fs::exists(folder_.path() / "first_road/world.osgb"));
  // The mistake that the document makes is told as it says.
  std::string wrong = world_;
  const std::size_t at = wrong.find("length_m: 160");
  ASSERT_NE(at, std::string::npos);
  folder_.Write("first_road.yaml", wrong.replace(at, 13, "length: 160"));
  const Ended refused = Do(Line("world check"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.out, sentence_);
}

TEST_F(FirstRoad, IsDrivenByTheAutopilotAmongCars) {
  const Ended driven = Do(Line("launch/haste.yaml") + " --record drive.mcap");
  ASSERT_EQ(driven.status, 0) << driven.out;
  const auto states =
      MessagesOf<msg::VehicleState>((folder_.path() / "drive.mcap").string(), idl::topics::kVehicleState);
  ASSERT_GT(states.size(), 1000u);
  const auto& last = states.back();
  EXPECT_GT(last.header().time_ns(), 19'900'000'000);
  EXPECT_GT(last.position_w_m().x(), 150.0);  // 20 s from standing, along the valley
  EXPECT_NEAR(last.position_w_m().z(), 18.0, 4.0);
}

TEST_F(FirstRoad, IsDrivenByKeys) {
  const Ended driven = Do(Line("launch/keyboard.yaml") + " --headless --for 1 --pace max --no-record");
  EXPECT_EQ(driven.status, 0) << driven.out;
}

}  // namespace
}  // namespace rodeira::system_test
