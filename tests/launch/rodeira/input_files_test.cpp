// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/input_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class InputFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    (void)shared_.Write("launch/demo.yaml", "rodeira: launch/1\n");
    (void)shared_.Write("launch/demo", "#!/bin/sh\n", 0755);  // a script, not a launch file
    (void)shared_.Write("launch/rain.yaml", "rodeira: launch/1\n");
    (void)shared_.Write("configs/worlds/n222.yaml", "rodeira: world/2\n");
    (void)shared_.Write("configs/worlds/town.xodr", "<OpenDRIVE/>");
    (void)shared_.Write("configs/worlds/example/world.yaml", "rodeira: world/2\n");
    (void)own_.Write("launch/demo.yaml", "rodeira: launch/1\n");
    (void)own_.Write("configs/worlds/hill.yaml", "rodeira: world/2\n");
  }
  std::string Resolved(InputKind kind, const std::string& text) const {
    const auto file = ResolveInputFile(kind, text, folders());
    return file ? file.value() : file.error().Text();
  }
  std::vector<InputFolder> folders() const { return {{own_.path(), "yours"}, {shared_.path(), "Rodeira"}}; }

  TemporaryFolder shared_, own_;
};

TEST_F(InputFiles, ANameMeansTheFirstFolderThatHasIt) {
  EXPECT_EQ(Resolved(InputKind::kLaunch, "demo"), (own_.path() / "launch/demo.yaml").string());
  EXPECT_EQ(Resolved(InputKind::kLaunch, "rain"), (shared_.path() / "launch/rain.yaml").string());
  EXPECT_EQ(Resolved(InputKind::kLaunch, "rain.yaml"), (shared_.path() / "launch/rain.yaml").string());
  EXPECT_EQ(Resolved(InputKind::kWorld, "town"), (shared_.path() / "configs/worlds/town.xodr").string());
  EXPECT_EQ(Resolved(InputKind::kWorld, "example/world"),
            (shared_.path() / "configs/worlds/example/world.yaml").string());
}

TEST_F(InputFiles, AScriptOfTheSameNameIsNoLaunchFile) {
  fs::remove(own_.path() / "launch/demo.yaml");
  EXPECT_EQ(Resolved(InputKind::kLaunch, "demo"), (shared_.path() / "launch/demo.yaml").string());
}

TEST_F(InputFiles, APathMeansItself) {
  const std::string file = (shared_.path() / "launch/rain.yaml").string();
  EXPECT_EQ(Resolved(InputKind::kLaunch, file), file);
  EXPECT_EQ(Resolved(InputKind::kLaunch, "/nowhere/rain.yaml"), "/nowhere/rain.yaml");
  EXPECT_EQ(Resolved(InputKind::kLaunch, "nowhere/rain.yaml"), "nowhere/rain.yaml");
  EXPECT_EQ(Resolved(InputKind::kLaunch, "rani.yaml"), "rani.yaml");  // its reader names the problem
}

TEST_F(InputFiles, AnUnknownNameIsRefusedWithTheNearest) {
  EXPECT_EQ(Resolved(InputKind::kLaunch, "dmeo"),
            "dmeo: no such file, and no launch file has this name; did you mean 'demo'?");
  EXPECT_THAT(Resolved(InputKind::kWorld, "quite_another"),
              HasSubstr("known are hill, n222, town.xodr, example/world"));
  EXPECT_EQ(ResolveInputFile(InputKind::kVehicle, "x", folders()).error().exit_status(), 2);
}

TEST_F(InputFiles, TheListNamesWhatEachNameFinds) {
  std::vector<std::string> names;
  for (const InputFile& file : FindInputFiles(InputKind::kWorld, folders())) {
    names.push_back(file.name + " " + file.from);
    EXPECT_EQ(Resolved(InputKind::kWorld, file.name), file.path.string());
  }
  EXPECT_THAT(names, ElementsAre("hill yours", "n222 Rodeira", "town.xodr Rodeira", "example/world Rodeira"));
  const std::string table = ListInputFiles(InputKind::kWorld, folders());
  EXPECT_THAT(table, HasSubstr("name           from     file\nhill           yours    " +
                               (own_.path() / "configs/worlds/hill.yaml").string() + "\n"));
  EXPECT_EQ(ListInputFiles(InputKind::kVehicle, folders()), "no vehicle was found\n");
}

// The current directory comes first, the user's own next, Rodeira's last; each once.
TEST_F(InputFiles, FoldersComeFromTheUserAndTheInstallation) {
  const fs::path before = fs::current_path();
  ::setenv("XDG_DATA_HOME", own_.path().c_str(), 1);
  ::setenv("RODEIRA_DATA", shared_.path().c_str(), 1);
  fs::create_directories(own_.path() / "rodeira");
  const auto names = [] {
    std::vector<std::string> shown;
    for (const InputFolder& folder : InputFolders()) shown.push_back(folder.from + " " + folder.path.string());
    return shown;
  };
  const std::string yours = "yours " + (own_.path() / "rodeira").string(), ours = "Rodeira " + shared_.path().string();
  fs::current_path(own_.path() / "launch");
  EXPECT_THAT(names(), ElementsAre("here " + (own_.path() / "launch").string(), yours, ours));
  fs::current_path(shared_.path());
  EXPECT_THAT(names(), ElementsAre(yours, ours));
  fs::current_path(before);
  ::unsetenv("XDG_DATA_HOME");
  ::unsetenv("RODEIRA_DATA");
}

}  // namespace
}  // namespace rodeira::cli
