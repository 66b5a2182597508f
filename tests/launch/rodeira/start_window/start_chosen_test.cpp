// SPDX-License-Identifier: Apache-2.0
// The start window by a person's mouse and keys: a world, a vehicle, a recording are chosen, a run is begun, read and
// stopped.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "common/core/base/files.hpp"
#include "tests/launch/rodeira/start_window/start_hands.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;

class StartChosen : public StartHands {
 protected:
  // A program that says what it was told, and goes on until Ctrl-C.
  std::string Program() const {
    const fs::path file = folder_->path() / "program";
    EXPECT_TRUE(
        base::WriteWhole(file, std::string_view("#!/bin/sh\ntrap 'echo stopped; exit 0' INT\nfor word in \"$@\"; do "
                                                "echo \"word $word\"; done\nwhile :; do sleep 0.02; done\n"))
            .ok());
    fs::permissions(file, fs::perms::owner_all);
    return file.string();
  }
  void Recording(const char* name, int minutes_ago) const {
    const fs::path file = folder_->path() / name;
    EXPECT_TRUE(base::WriteWhole(file, std::string_view("x")).ok());
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::minutes(minutes_ago));
  }
  template <typename Is>
  bool Until(Is is) {
    for (int i = 0; i < 1000; ++i) {
      Frame();
      if (is()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  // Bright pixels where the log stands: its letters. -1: it is not drawn.
  int LettersOfTheLog() {
    const window::Image seen = Frame();
    for (const ImGuiWindow* panel : ImGui::GetCurrentContext()->Windows) {
      if (std::string_view(panel->Name).substr(0, 10) != "start/said" || !panel->WasActive) continue;
      int bright = 0;
      for (int y = static_cast<int>(panel->InnerClipRect.Min.y); y < static_cast<int>(panel->InnerClipRect.Max.y);
           ++y) {
        for (int x = static_cast<int>(panel->InnerClipRect.Min.x); x < static_cast<int>(panel->InnerClipRect.Max.x);
             ++x)
          bright += seen.At(x, y)[0] > 160 ? 1 : 0;
      }
      return bright;
    }
    return -1;
  }
};

TEST_F(StartChosen, AWorldInAFolderOfItsOwnIsInTheListAndAnyOtherOneIsTyped) {
  ASSERT_TRUE(Click("##world"));
  Keep("start_worlds.png");
  ASSERT_TRUE(Click("example/world.yaml", "##Combo_00"));
  EXPECT_EQ(start_->choice().world.lexically_normal(), "configs/worlds/example/world.yaml");
  const fs::path own = folder_->path() / "mine.yaml";
  ASSERT_TRUE(base::WriteWhole(own, std::string_view("rodeira: world/2\n")).ok());
  ASSERT_TRUE(Click("world"));
  TypeInstead(own.string());
  EXPECT_EQ(start_->choice().world, own);
  ASSERT_TRUE(Click("vehicle"));
  TypeInstead("configs/vehicles/none.yaml");
  EXPECT_EQ(start_->choice().vehicle, "configs/vehicles/none.yaml");
  EXPECT_FALSE(Click("start")) << "the file is missing, and so is the button";
  ASSERT_TRUE(Click("vehicle"));
  TypeInstead("configs/vehicles/ode.yaml");
  Open("/bin/true");
  ASSERT_TRUE(Click("start"));
  ASSERT_TRUE(start_->run().has_value());
}

TEST_F(StartChosen, ARecentRunIsWatchedReadAndStopped) {
  Recording("older.mcap", 20);
  Recording("newer.mcap", 10);
  Open(Program());
  EXPECT_FALSE(Click("older.mcap")) << "who drives sees no recordings";
  ASSERT_TRUE(Click("watch a recording"));
  EXPECT_EQ(start_->choice().way, StartWay::kWatch);
  EXPECT_EQ(start_->choice().recording, folder_->path() / "newer.mcap") << "the newest, to begin with";
  ASSERT_TRUE(Click("older.mcap"));
  EXPECT_EQ(start_->choice().recording, folder_->path() / "older.mcap");
  Keep("start_watch.png");
  EXPECT_EQ(LettersOfTheLog(), -1) << "nothing was begun";
  ASSERT_TRUE(Click("start"));
  ASSERT_TRUE(start_->run().has_value());
  ASSERT_TRUE(Until([&] { return start_->run()->lines().size() == 3; }));
  EXPECT_THAT(start_->run()->lines(),
              ElementsAre("word replay", "word " + (folder_->path() / "older.mcap").string(), "word --view"));
  const int three_lines = LettersOfTheLog();
  EXPECT_GT(three_lines, 100) << "the log is drawn";
  EXPECT_FALSE(start_->run()->ended());
  (void)Click("newer.mcap");
  EXPECT_EQ(start_->choice().recording, folder_->path() / "older.mcap") << "while it goes on nothing else is chosen";
  Keep("start_runs.png");
  ASSERT_TRUE(Click("stop it"));
  ASSERT_TRUE(Until([&] { return start_->run()->ended(); }));
  EXPECT_THAT(start_->run()->lines(), Contains("stopped"));
  EXPECT_EQ(start_->run()->State(), "has ended");
  EXPECT_GT(LettersOfTheLog(), three_lines) << "its last line too";
  EXPECT_FALSE(Click("stop it")) << "there is nothing to stop";
  ASSERT_TRUE(Click("newer.mcap")) << "and one may choose again";
}

// What was just driven is what one watches next.
TEST_F(StartChosen, ARunThatHasEndedIsAmongTheRecentOnes) {
  Recording("older.mcap", 20);
  Recording("oldest.mcap", 30);
  const fs::path program = folder_->path() / "drive";
  ASSERT_TRUE(
      base::WriteWhole(program, "#!/bin/sh\necho x > '" + (folder_->path() / "driven.mcap").string() + "'\n").ok());
  fs::permissions(program, fs::perms::owner_all);
  Open(program.string());
  ASSERT_TRUE(Click("start"));
  ASSERT_TRUE(Until([&] { return start_->run()->ended(); }));
  ASSERT_TRUE(Click("watch a recording"));
  EXPECT_EQ(start_->choice().recording, folder_->path() / "driven.mcap")
      << "the newest is chosen where nothing else was";
  ASSERT_TRUE(Click("oldest.mcap"));
  Recording("another.mcap", 0);
  ASSERT_TRUE(Click("watch a recording"));
  EXPECT_EQ(start_->choice().recording, folder_->path() / "oldest.mcap");
  EXPECT_TRUE(Click("another.mcap")) << "of a run that was begun in a terminal";
}

TEST_F(StartChosen, ARecordingAnywhereIsWatchedByItsPath) {
  ASSERT_TRUE(Click("watch a recording"));
  EXPECT_FALSE(Click("start")) << "there are none yet";
  ASSERT_TRUE(Click("file"));
  TypeInstead((folder_->path() / "elsewhere.bin").string());
  EXPECT_EQ(WhatIsMissing(FindStartFiles(".", folder_->path(), folder_->path()), start_->choice()),
            "there is no file '" + (folder_->path() / "elsewhere.bin").string() + "'");
  EXPECT_FALSE(Click("start"));
  Recording("elsewhere.bin", 1);
  ASSERT_TRUE(Click("start"));
  EXPECT_TRUE(start_->run().has_value());
  ASSERT_TRUE(Until([&] { return start_->run()->ended(); }));
  ASSERT_TRUE(Click("drive"));
  EXPECT_EQ(start_->choice().way, StartWay::kDrive);
}

}  // namespace
}  // namespace rodeira::cli
