// SPDX-License-Identifier: Apache-2.0
// A loss of power takes what is not on the disk (disk_journal.cpp). No name is given to a file that is not, what a
// command says it has written is, and a recording's part that is on the disk is a recording.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/system/recording.hpp"

namespace rodeira::system_test {
namespace {

using namespace std::chrono_literals;

struct Event {
  std::string what;         // write, sync, sync_all, names, rename
  std::uint64_t inode = 0;  // of a file, or of a folder that is renamed
  std::string copy, folder, from, to;
};

class PowerLoss : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(Watched());
    std::filesystem::create_directories(folder_.path() / "journal");
  }

  std::filesystem::path Watched() const { return folder_.path() / "watched"; }
  std::string Out(const std::string& name) const { return (Watched() / name).string(); }
  std::filesystem::path Copy(const Event& sync) const { return folder_.path() / "journal" / sync.copy; }

  std::vector<Event> Run(const std::vector<std::string>& words) const {
    std::vector<std::string> command = {"LD_PRELOAD=" + Bin("disk_journal.so"),
                                        "DISK_JOURNAL=" + (folder_.path() / "journal").string(),
                                        "DISK_JOURNAL_OF=" + Watched().string(), Bin("rodeira")};
    command.insert(command.end(), words.begin(), words.end());
    const Ended ended = Started(command).Wait(60s);
    EXPECT_EQ(ended.status, 0) << ended.out;
    std::vector<Event> events;
    std::ifstream in(folder_.path() / "journal" / "journal");
    for (std::string line; std::getline(in, line);) {
      std::istringstream words_in(line);
      Event event;
      words_in >> event.what;
      if (event.what == "names") words_in >> event.folder;
      if (event.what == "write" || event.what == "sync" || event.what == "rename") words_in >> event.inode;
      if (event.what == "sync") words_in >> event.copy;
      if (event.what == "rename") words_in >> event.from >> event.to;
      events.push_back(event);
    }
    return events;
  }

  static std::uint64_t InodeOf(const std::filesystem::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 ? status.st_ino : 0;
  }

  // Each rename of a file is of one that is on the disk; after the last event everything is, names included.
  void ExpectOnTheDisk(const std::vector<Event>& events) const {
    std::set<std::uint64_t> unsynced;
    std::map<std::string, std::string> unnamed;  // a new name, by its folder
    for (const Event& event : events) {
      if (event.what == "write") unsynced.insert(event.inode);
      if (event.what == "sync") unsynced.erase(event.inode);
      if (event.what == "sync_all") unsynced.clear(), unnamed.clear();
      if (event.what == "names") unnamed.erase(event.folder);
      if (event.what == "rename") {
        // A tile is read by the list of all of them with their hashes, which is written last.
        const std::filesystem::path to = event.to;
        if (to.parent_path().filename() != "tiles") {
          EXPECT_FALSE(unsynced.contains(event.inode)) << to << " is named before it is on the disk";
        }
        if (to.filename() == "visual.txt") {
          EXPECT_TRUE(unsynced.empty()) << "tiles are listed before they are on the disk";
        }
        if (std::filesystem::is_directory(event.to)) {
          EXPECT_TRUE(unsynced.empty()) << event.to << " is named before its files are on the disk";
        }
        unnamed[to.parent_path().string()] = event.to;
      }
    }
    for (const auto& [folder, name] : unnamed) ADD_FAILURE() << "the name " << name << " is not on the disk at the end";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(Watched())) {
      if (!entry.is_regular_file()) continue;
      ++files;
      EXPECT_FALSE(unsynced.contains(InodeOf(entry.path()))) << entry.path() << " is not on the disk at the end";
    }
    EXPECT_GT(files, 0u);
    EXPECT_GT(std::ranges::count(events, "write", &Event::what), 0) << "no write was seen";
  }

  const cli::TemporaryFolder folder_;
};

TEST_F(PowerLoss, TakesNothingThatWasSaidToBeWritten) {
  const std::string recording = (folder_.path() / "r.mcap").string();
  const Ended recorded =
      RunCommand({Bin("rodeira"), "run", "first_drive", "--for", "0.5", "--in-process", "--record", recording});
  ASSERT_EQ(recorded.status, 0) << recorded.out;
  const std::vector<std::vector<std::string>> commands = {
      {"world", "export", "n222", "-o", Out("n222.xodr")},
      {"world", "build", "flat", "-o", Out("flat"), "--quiet"},
      {"world", "map", "n222", "-o", Out("n222.svg")},
      {"export", recording, "--csv", Out("tables"), "--quiet"},
      {"repair", recording, "--out", Out("whole.mcap")},
      {"replay", recording, "--from", "0.2", "--for", "0.2", "--branch", "seed=2", "--record", Out("branch.mcap")},
      {"run", "first_drive", "--for", "0.5", "--in-process", "--record", Out("run.mcap")},
  };
  for (const auto& command : commands) {
    SCOPED_TRACE(command[0] + " " + command[1]);
    ExpectOnTheDisk(Run(command));
    std::filesystem::remove_all(Watched());
    std::filesystem::remove_all(folder_.path() / "journal");
    SetUp();
  }
}

// Whatever instant the power is lost at, the part of a recording that is on the disk by then is read or repaired, and
// holds samples of the run in their order.
TEST_F(PowerLoss, LeavesARecordingUpToItsLastSync) {
  const std::string recording = Out("r.mcap");
  const auto events = Run({"run", "first_drive", "--for", "8", "--in-process", "--record", recording});
  const auto whole = SamplesOf(recording);
  ASSERT_GT(whole.size(), 1000u);
  std::size_t syncs = 0, longest = 0;
  bool is_named = false;
  for (const Event& event : events) {
    if (event.what == "names" && event.folder == Watched().string()) is_named = true;
    if (event.what != "sync") continue;
    ++syncs;
    EXPECT_TRUE(is_named) << "a power loss would take the name of what is synced";
    const std::string repaired = (folder_.path() / fmt::format("{}.mcap", syncs)).string();
    const Ended ended = RunCommand({Bin("rodeira"), "repair", Copy(event).string(), "--out", repaired});
    // A record may have been half written while a thread brought the file to the disk: that much is told to be lost.
    if (ended.status != 0) {
      EXPECT_EQ(ended.status, 1) << ended.out;
      EXPECT_THAT(ended.out, ::testing::HasSubstr("from there to the end"));
    }
    const auto part = SamplesOf(repaired);
    EXPECT_TRUE(part.size() <= whole.size() && std::equal(part.begin(), part.end(), whole.begin()));
    longest = std::max(longest, part.size());
  }
  EXPECT_GE(syncs, 2u) << "nothing is brought to the disk before the end";
  EXPECT_EQ(longest, whole.size());
}

}  // namespace
}  // namespace rodeira::system_test
