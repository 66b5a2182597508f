// SPDX-License-Identifier: Apache-2.0
// A cache gives what was kept or nothing, whatever is done to its folder.
#include "common/core/base/file_cache.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/core/base/temporary_folder.hpp"
#include "common/core/base/user_folders.hpp"

namespace rodeira::base {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

Bytes BytesOf(std::size_t size, unsigned seed) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>((i * 131 + seed * 17 + (i >> 8)) & 0xFFU);
  return bytes;
}

class FileCaches : public testing::Test {
 protected:
  fs::path Folder() const { return above_.path() / "cache"; }
  std::vector<fs::path> Files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(Folder())) files.push_back(entry.path());
    return files;
  }
  fs::path OnlyFile() const {
    const auto files = Files();
    EXPECT_EQ(files.size(), 1u);
    return files.front();
  }

  TemporaryFolder above_ = TemporaryFolder::Make("cache-test").value();
  Bytes kept_ = BytesOf(5000, 1);
};

TEST_F(FileCaches, GivesWhatWasKeptByItsKindAndSource) {
  FileCache cache(Folder());
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
  cache.Keep("kind", 1, kept_);
  cache.Keep("kind", 2, {});
  EXPECT_EQ(cache.Find("kind", 1), kept_);
  EXPECT_EQ(cache.Find("kind", 2), Bytes());
  EXPECT_FALSE(cache.Find("other", 1).has_value());
  EXPECT_FALSE(cache.Find("kind", 3).has_value());
  EXPECT_EQ(FileCache(Folder()).Find("kind", 1), kept_) << "another process";
  const Bytes other = BytesOf(77, 2);
  cache.Keep("kind", 1, other);
  EXPECT_EQ(cache.Find("kind", 1), other);
}

TEST_F(FileCaches, AnotherBuildFindsNothing) {
  FileCache(Folder(), FileCache::kLimit_bytes, 1).Keep("kind", 1, kept_);
  EXPECT_FALSE(FileCache(Folder(), FileCache::kLimit_bytes, 2).Find("kind", 1).has_value());
  EXPECT_EQ(FileCache(Folder(), FileCache::kLimit_bytes, 1).Find("kind", 1), kept_);
}

TEST_F(FileCaches, EveryDamageIsFoundAndMendedByKeepingAgain) {
  FileCache cache(Folder());
  cache.Keep("kind", 1, kept_);
  const fs::path file = OnlyFile();
  const Bytes whole = ReadBytes(file).value();
  for (const std::size_t at : {std::size_t{0}, std::size_t{9}, std::size_t{17}, std::size_t{25}, std::size_t{32},
                               whole.size() / 2, whole.size() - 1}) {
    Bytes damaged = whole;
    damaged[at] ^= std::byte{1};
    ASSERT_TRUE(WriteWhole(file, damaged).ok());
    EXPECT_FALSE(cache.Find("kind", 1).has_value()) << at;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{31}, std::size_t{32}, whole.size() - 1}) {
    ASSERT_TRUE(WriteWhole(file, std::span(whole).first(size)).ok());
    EXPECT_FALSE(cache.Find("kind", 1).has_value()) << size;
  }
  Bytes longer = whole;
  longer.push_back(std::byte{0});
  ASSERT_TRUE(WriteWhole(file, longer).ok());
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
  cache.Keep("kind", 1, kept_);
  EXPECT_EQ(cache.Find("kind", 1), kept_);
}

// A file under the name of another: by an attack, or copied by mistake.
TEST_F(FileCaches, AFileUnderAnotherNameIsNotTaken) {
  FileCache cache(Folder());
  cache.Keep("kind", 1, kept_);
  const fs::path first = OnlyFile();
  cache.Keep("kind", 2, BytesOf(100, 3));
  for (const fs::path& file : Files()) {
    if (file != first) fs::copy_file(first, file, fs::copy_options::overwrite_existing);
  }
  EXPECT_FALSE(cache.Find("kind", 2).has_value());
}

TEST_F(FileCaches, LinksAndFoldersAndPipesInPlaceOfAFileAreNotRead) {
  FileCache cache(Folder());
  cache.Keep("kind", 1, kept_);
  const fs::path file = OnlyFile(), aside = above_.path() / "aside";
  fs::rename(file, aside);
  fs::create_symlink(aside, file);
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
  cache.Keep("kind", 1, kept_);
  EXPECT_EQ(cache.Find("kind", 1), kept_) << "the link is replaced";
  EXPECT_FALSE(fs::is_symlink(file));
  fs::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
  fs::remove(file);
  fs::create_directory(file);
  std::ofstream(file / "inside") << "kept";
  cache.Keep("kind", 1, kept_);
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
  EXPECT_TRUE(fs::exists(file / "inside"));
  EXPECT_EQ(Files().size(), 1u) << "nothing half written is left";
}

TEST_F(FileCaches, AFolderThatOthersCanWriteOrThatIsALinkIsNotUsed) {
  FileCache cache(Folder());
  cache.Keep("kind", 1, kept_);
  struct stat status {};
  ASSERT_EQ(::stat(Folder().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0700u);
  for (const mode_t mode : {0770U, 0707U}) {
    ASSERT_EQ(::chmod(Folder().c_str(), mode), 0);
    cache.Keep("kind", 2, kept_);
    EXPECT_FALSE(cache.Find("kind", 1).has_value()) << mode;
  }
  ASSERT_EQ(::chmod(Folder().c_str(), 0700), 0);
  EXPECT_EQ(cache.Find("kind", 1), kept_);
  EXPECT_FALSE(cache.Find("kind", 2).has_value()) << "nothing was kept there";
  ASSERT_EQ(::chmod(OnlyFile().c_str(), 0666), 0);
  EXPECT_FALSE(cache.Find("kind", 1).has_value()) << "a file that others can write";
  ASSERT_EQ(::chmod(OnlyFile().c_str(), 0600), 0);

  const fs::path link = above_.path() / "link";
  fs::create_directory_symlink(Folder(), link);
  FileCache linked(link);
  EXPECT_FALSE(linked.Find("kind", 1).has_value());
  linked.Keep("kind", 2, kept_);
  EXPECT_EQ(Files().size(), 1u);
}

TEST_F(FileCaches, WhatBelongsToAnotherUserIsNotUsed) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may give a folder to another user";
  FileCache cache(Folder());
  cache.Keep("kind", 1, kept_);
  ASSERT_EQ(::chown(OnlyFile().c_str(), 12345, 12345), 0);
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
  ASSERT_EQ(::chown(OnlyFile().c_str(), 0, 0), 0);
  ASSERT_EQ(::chown(Folder().c_str(), 12345, 12345), 0);
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
  cache.Keep("kind", 2, kept_);
  EXPECT_EQ(Files().size(), 1u);
  ASSERT_EQ(::chown(Folder().c_str(), 0, 0), 0);
  EXPECT_EQ(cache.Find("kind", 1), kept_);
}

// As another user: root writes everywhere.
TEST_F(FileCaches, WhereNothingCanBeWrittenNothingIsKeptAndWhatIsThereIsFound) {
  FileCache cache(Folder());
  cache.Keep("kind", 1, kept_);
  fs::permissions(above_.path(), fs::perms::all);
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0) {
      bool given = ::chown(Folder().c_str(), 12345, 12345) == 0;
      for (const fs::path& file : Files()) given = given && ::chown(file.c_str(), 12345, 12345) == 0;
      if (!given || ::setgid(12345) != 0 || ::setuid(12345) != 0) ::_exit(9);
    }
    if (::chmod(Folder().c_str(), 0500) != 0) ::_exit(8);
    FileCache own(Folder());
    own.Keep("kind", 2, kept_);
    const bool kept = own.Find("kind", 2).has_value(), found = own.Find("kind", 1) == kept_;
    (void)::chmod(Folder().c_str(), 0700);
    ::_exit((kept ? 2 : 0) + (found ? 0 : 1));
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST_F(FileCaches, AFullDiskKeepsNothingAndLeavesNothing) {
  const pid_t child = ::fork();
  if (child == 0) {
    (void)::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, 1000};
    if (::setrlimit(RLIMIT_FSIZE, &small) != 0) ::_exit(9);
    FileCache cache(Folder());
    cache.Keep("kind", 1, kept_);
    const bool kept = cache.Find("kind", 1).has_value();
    cache.Keep("kind", 2, BytesOf(100, 1));
    ::_exit((kept ? 2 : 0) + (cache.Find("kind", 2).has_value() ? 0 : 1));
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_EQ(Files().size(), 1u);
}

TEST_F(FileCaches, AboveItsLimitWhatWasNotUsedForLongestGoes) {
  constexpr std::uint64_t kLimit = 100'000;
  const auto keep = [&](Digest source) {  // each asks anew how large the folder is
    FileCache(Folder(), kLimit).Keep("kind", source, BytesOf(9'000, static_cast<unsigned>(source)));
  };
  for (Digest source = 0; source < 11; ++source) {
    keep(source);
    for (const fs::path& file : Files()) fs::last_write_time(file, fs::last_write_time(file) - 1s);
  }
  EXPECT_EQ(Files().size(), 11u) << "99 kB";
  FileCache cache(Folder(), kLimit);
  EXPECT_TRUE(cache.Find("kind", 0).has_value()) << "used now";
  keep(11);
  keep(12);
  std::uint64_t size = 0;
  for (const fs::path& file : Files()) size += fs::file_size(file);
  EXPECT_LE(size, kLimit);
  for (const Digest source : {0, 10, 11, 12})
    EXPECT_EQ(cache.Find("kind", source), BytesOf(9'000, static_cast<unsigned>(source))) << source;
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
  cache.Keep("kind", 20, BytesOf(30'000, 1));
  EXPECT_FALSE(cache.Find("kind", 20).has_value()) << "more than a quarter of the limit";
}

TEST_F(FileCaches, WhatIsNotItsOwnStaysAndOldHalvesGo) {
  fs::create_directory(Folder());
  ASSERT_EQ(::chmod(Folder().c_str(), 0700), 0);
  for (const char* name : {"photo.jpg", "old.part", "new.part"}) std::ofstream(Folder() / name) << "text";
  for (const char* name : {"photo.jpg", "old.part"})
    fs::last_write_time(Folder() / name, fs::file_time_type::clock::now() - 48h);
  FileCache(Folder()).Keep("kind", 1, kept_);
  EXPECT_TRUE(fs::exists(Folder() / "photo.jpg"));
  EXPECT_TRUE(fs::exists(Folder() / "new.part"));
  EXPECT_FALSE(fs::exists(Folder() / "old.part"));
}

// Ten processes with four threads each keep and find the same names: what is found is always whole.
TEST_F(FileCaches, ManyProcessesAtOnceFindOnlyWholeFiles) {
  constexpr int kProcesses = 10, kThreads = 4, kNames = 6, kRounds = 40;
  std::vector<pid_t> children;
  for (int process = 0; process < kProcesses; ++process) {
    const pid_t child = ::fork();
    if (child == 0) {
      FileCache cache(Folder());
      std::atomic<int> wrong{0};
      std::vector<std::thread> threads;
      for (int thread = 0; thread < kThreads; ++thread)
        threads.emplace_back([&, thread] {
          for (int round = 0; round < kRounds; ++round) {
            const auto source = static_cast<unsigned>((round + thread + process) % kNames);
            const Bytes expected = BytesOf(20'000 + source, source);
            const auto found = cache.Find("kind", source);
            if (found && *found != expected) ++wrong;
            cache.Keep("kind", source, expected);
          }
        });
      for (std::thread& thread : threads) thread.join();
      ::_exit(wrong == 0 ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
  EXPECT_EQ(Files().size(), static_cast<std::size_t>(kNames));
}

TEST_F(FileCaches, WithoutAFolderNothingIsKept) {
  FileCache cache{fs::path()};
  EXPECT_FALSE(cache.is_used());
  cache.Keep("kind", 1, kept_);
  EXPECT_FALSE(cache.Find("kind", 1).has_value());
}

TEST(UserCacheFolder, IsTheEnvironmentsThenThatOfXdgThenOfHome) {
  const auto with = [](const char* name, const char* value) {
    return value == nullptr ? ::unsetenv(name) : ::setenv(name, value, 1);
  };
  const std::string before = std::getenv("RODEIRA_CACHE") != nullptr ? std::getenv("RODEIRA_CACHE") : "";
  with("RODEIRA_CACHE", nullptr), with("XDG_CACHE_HOME", nullptr), with("HOME", "/home/ada");
  EXPECT_EQ(UserCacheFolder(), "/home/ada/.cache/rodeira");
  with("XDG_CACHE_HOME", "/var/x");
  EXPECT_EQ(UserCacheFolder(), "/var/x/rodeira");
  with("RODEIRA_CACHE", "/fast/disk");
  EXPECT_EQ(UserCacheFolder(), "/fast/disk");
  with("RODEIRA_CACHE", "off");
  EXPECT_EQ(UserCacheFolder(), "");
  with("RODEIRA_CACHE", before.c_str());
}

// The oracle is the note that the linker has written into this program's file.
TEST(BuildDigest, IsOfTheLinkersNoteWhereThereIsOne) {
  const Bytes program = ReadBytes("/proc/self/exe").value();
  const std::string note("\x04\0\0\0\x14\0\0\0\x03\0\0\0GNU\0", 16);
  const std::string_view all(reinterpret_cast<const char*>(program.data()), program.size());
  const auto at = all.find(note);
  const Digest expected = at == std::string_view::npos ? Hash(program) : Hash(all.substr(at + note.size(), 20));
  EXPECT_EQ(BuildDigest(), expected);
}

}  // namespace
}  // namespace rodeira::base
