// SPDX-License-Identifier: Apache-2.0
// Folders that go with their owners, also where the owner was killed.
#include "common/core/base/temporary_folder.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace rodeira::base {
namespace {

namespace fs = std::filesystem;

// Purposes of this test alone, so that no other folders are touched.
const std::string kPurpose = "test-folder" + std::to_string(::getpid());

TEST(TemporaryFolder, GoesWithItsOwner) {
  fs::path path;
  {
    auto folder = TemporaryFolder::Make(kPurpose);
    ASSERT_TRUE(folder.ok()) << folder.error().Text();
    path = folder.value().path();
    std::ofstream(path / "file") << "text";
    const TemporaryFolder moved = std::move(folder).value();
    EXPECT_TRUE(fs::exists(path / "file"));
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(TemporaryFolder, WhatAKilledOwnerLeftIsRemovedByTheNextAndALivingOnesIsNot) {
  int pipe[2];
  ASSERT_EQ(::pipe(pipe), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    auto folder = TemporaryFolder::Make(kPurpose);
    std::ofstream(folder.value().path() / "file") << "text";
    const std::string name = folder.value().path().string();
    if (::write(pipe[1], name.data(), name.size()) < 0) ::_exit(1);
    ::close(pipe[1]);
    for (;;) ::pause();
  }
  ::close(pipe[1]);
  std::string name(4096, '\0');
  const auto size = ::read(pipe[0], name.data(), name.size());
  ::close(pipe[0]);
  ASSERT_GT(size, 0);
  const fs::path left = name.substr(0, static_cast<std::size_t>(size));
  const fs::path foreign =
      left.parent_path() / ("rodeira-" + kPurpose + "-notes");  // not one of ours by its name's length
  fs::create_directory(foreign);
  {
    const auto while_it_lives = TemporaryFolder::Make(kPurpose);
    EXPECT_TRUE(fs::exists(left / "file"));
  }
  ::kill(child, SIGKILL);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_TRUE(fs::exists(left / "file"));
  const auto next = TemporaryFolder::Make(kPurpose);
  ASSERT_TRUE(next.ok());
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(next.value().path()));
  EXPECT_TRUE(fs::exists(foreign));
  fs::remove(foreign);
}

}  // namespace
}  // namespace rodeira::base
