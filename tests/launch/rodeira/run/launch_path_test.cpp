// SPDX-License-Identifier: Apache-2.0
// Launch files that are no plain file in a plain folder, and texts that are not UTF-8.
#include "launch/rodeira/run/launch_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;
using system_test::Bin;
using system_test::LaunchFile;
using system_test::RunCommand;
using ::testing::HasSubstr;

class LaunchPathTest : public ::testing::Test {
 protected:
  // Where the launch file lies in the product: beside configs.
  static fs::path Installed() { return fs::canonical(fs::path(LaunchFile("empty.yaml")).parent_path()); }
  system_test::Ended Run(const std::string& words) {
    return RunCommand({"/bin/bash", "-c", Bin("rodeira") + " run " + words});
  }
  TemporaryFolder folder_;
};

TEST_F(LaunchPathTest, APlainFileIsItself) {
  const std::string file = folder_.Write("launch/a.yaml", "rodeira: launch/1\n");
  EXPECT_EQ(LaunchPath(file).value(), file);
  EXPECT_EQ(LaunchPath((folder_.path() / "none.yaml").string()).value(), (folder_.path() / "none.yaml").string());
}

TEST_F(LaunchPathTest, ALinkedFolderIsTheRealOne) {
  const std::string file = folder_.Write("shared/launch/a.yaml", "rodeira: launch/1\n");
  fs::create_directory_symlink(folder_.path() / "shared/launch", folder_.path() / "linked");
  EXPECT_EQ(LaunchPath((folder_.path() / "linked/a.yaml").string()).value(), file);
  // A linked file stays beside what lies in the link's folder.
  fs::create_symlink(file, folder_.path() / "own.yaml");
  EXPECT_EQ(LaunchPath((folder_.path() / "own.yaml").string()).value(), (folder_.path() / "own.yaml").string());
}

TEST_F(LaunchPathTest, ARunByALinkedFolderFindsItsFiles) {
  fs::create_directory_symlink(Installed(), folder_.path() / "linked");
  const auto run =
      Run((folder_.path() / "linked/first_drive.yaml").string() + " --in-process --headless --no-record --for 0.05");
  EXPECT_EQ(run.status, 0) << run.out;
}

TEST_F(LaunchPathTest, APipeIsRefusedWithTheReason) {
  const auto run = Run("<(cat " + LaunchFile("empty.yaml") + ") --no-record --for 0.05");
  EXPECT_EQ(run.status, 2) << run.out;
  EXPECT_THAT(run.out, HasSubstr("is not a regular file; every node reads the launch file"));
  const std::string pipe = (folder_.path() / "pipe.yaml").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(LaunchPath(pipe).ok()) << "not even opened, which would wait for a writer";
}

TEST_F(LaunchPathTest, TextsThatAreNotUtf8AreRefused) {
  const auto recording = (folder_.path() / "a.mcap").string();
  const auto meta = Run(LaunchFile("first_drive.yaml") + " --in-process --record " + recording +
                        " --for 0.05 --meta who=$'M\\xfcller'");
  EXPECT_EQ(meta.status, 2) << meta.out;
  EXPECT_THAT(meta.out, HasSubstr("--meta: 'who=M\\xfcller' is not UTF-8"));
  const std::string launch = folder_.Write("b.yaml", "rodeira: launch/1\nname: gr\xFC\xDF\nnodes: {}\n");
  const auto named = Run(launch + " --in-process --for 0.05");
  EXPECT_EQ(named.status, 2) << named.out;
  EXPECT_THAT(named.out, HasSubstr("b.yaml:2: byte 0xfc is not UTF-8"));
  EXPECT_FALSE(fs::exists(recording));
}

}  // namespace
}  // namespace rodeira::cli
