// SPDX-License-Identifier: Apache-2.0
// What `rodeira` does without rodeira-graphics.
#include "launch/rodeira/graphics/graphics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using system_test::Bin;
using system_test::LaunchFile;
using system_test::RunCommand;
using ::testing::HasSubstr;

// A copy of `rodeira` that lies alone in a folder.
class LoneFrontDoor : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::copy_file(Bin("rodeira"), program_); }

  const TemporaryFolder folder_;
  const std::filesystem::path program_ = folder_.path() / "rodeira";
};

TEST_F(LoneFrontDoor, CommandsThatDrawNameTheMissingProgram) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"edit"}, {"view"}, {"joysticks"}, {"input", "setup"}}) {
    std::vector<std::string> words{program_.string()};
    words.insert(words.end(), command.begin(), command.end());
    const auto ended = RunCommand(words);
    EXPECT_EQ(ended.status, 2) << ended.out;
    EXPECT_THAT(ended.out,
                HasSubstr("the program " + folder_.path().string() +
                          "/rodeira-graphics is needed (build with RODEIRA_VIEW=ON): No such file or directory"));
  }
}

// A world is built without what it looks like, and that is said: what a PC lacks where Rodeira is installed, too.
TEST_F(LoneFrontDoor, AWorldIsBuiltWithoutTilesAndThatIsSaid) {
  const auto prefix = folder_.path() / "prefix";
  std::filesystem::create_directories(prefix / "bin");
  std::filesystem::create_directories(prefix / "libexec/rodeira");
  std::filesystem::copy_file(program_, prefix / "bin/rodeira");
  const auto world = folder_.Write("w.yaml", "rodeira: world/2\nname: w\nground: {kind: plane}\n");
  for (const auto& [program, why] :
       {std::pair(program_, "built without the view"), std::pair(prefix / "bin/rodeira", "apt install rodeira")}) {
    const auto out = folder_.path() / "out";
    const auto ended = RunCommand({program.string(), "world", "build", world.string(), "--out", out.string()});
    EXPECT_EQ(ended.status, 0) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("warning: " + world.string() + ": no tiles are written: ")) << program;
    EXPECT_THAT(ended.out, HasSubstr(why)) << program;
    EXPECT_TRUE(std::filesystem::exists(out / "w.yaml"));
    EXPECT_FALSE(std::filesystem::exists(out / "world.osgb"));
  }
}

TEST_F(LoneFrontDoor, TheDoctorLooksForNoJoysticks) {
  const auto ended = RunCommand({program_.string(), "doctor", "--domain", "228"});
  EXPECT_THAT(ended.out, HasSubstr("ok       joysticks          not looked for")) << ended.out;
}

TEST(ContinueInGraphics, InAnotherProgramIsRefused) {
  EXPECT_FALSE(CanContinueInGraphics());
  testing::internal::CaptureStderr();
  EXPECT_EQ(ContinueInGraphics("edit"), 2);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("rodeira: edit: the program "));
}

TEST(NeedsGraphics, WhereAViewOrADeviceIs) {
  const auto needs = [](const std::string& nodes) {
    return NeedsGraphics(launch::Launch::Parse("rodeira: launch/1\nname: x\nnodes:\n" + nodes, "/tmp/x.yaml").value());
  };
  EXPECT_FALSE(needs("  hands: {kind: input, config: {source: script}}\n"));
  EXPECT_TRUE(needs("  hands: {kind: input, config: {source: joystick}}\n"));
  EXPECT_TRUE(needs("  hands: {kind: input, config: {source: gamepad}}\n"));
  EXPECT_TRUE(needs("  hands: {kind: input}\n  ego: {kind: vehicle}\n  picture: {kind: view}\n"));
}

}  // namespace
}  // namespace rodeira::cli
