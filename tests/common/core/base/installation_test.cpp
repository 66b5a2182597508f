// SPDX-License-Identifier: Apache-2.0
#include "common/core/base/installation.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "common/core/base/temporary_folder.hpp"
#include "common/core/base/version.hpp"

namespace rodeira::base {
namespace {

namespace fs = std::filesystem;

class Installation : public ::testing::Test {
 protected:
  void SetUp() override { ::unsetenv("RODEIRA_DATA"); }

  fs::path Folder(const std::string& name) const {
    fs::create_directories(folder_.path() / name);
    return folder_.path() / name;
  }
  void Program(const std::string& name) const {
    Folder(fs::path(name).parent_path().string());
    std::ofstream(folder_.path() / name) << "program";
  }
  // A prefix with the front door, a node and the shared files.
  fs::path Installed(const std::string& name) const {
    Program(name + "/bin/rodeira");
    Program(name + "/libexec/rodeira/rodeira-clock");
    Folder(name + "/share/rodeira/launch");
    Folder(name + "/share/rodeira/configs");
    return folder_.path() / name;
  }

  TemporaryFolder folder_ = std::move(TemporaryFolder::Make("rodeira-installation")).value();
};

TEST_F(Installation, ProgramsOfABuildFolderLieSideBySide) {
  Program("tree/build/bin/rodeira");
  const fs::path bin = folder_.path() / "tree/build/bin";
  EXPECT_FALSE(IsInstalled(bin));
  EXPECT_EQ(FindProgram("rodeira", bin), bin / "rodeira");
  EXPECT_EQ(FindProgram("rodeira-clock", bin), bin / "rodeira-clock");  // missing: where it is expected
}

TEST_F(Installation, FrontDoorAndNodesFindEachOther) {
  const fs::path prefix = Installed("usr");
  for (const fs::path& folder : {prefix / "bin", prefix / "libexec/rodeira"}) {
    EXPECT_TRUE(IsInstalled(folder)) << folder;
    EXPECT_EQ(FindProgram("rodeira", folder), prefix / "bin/rodeira");
    EXPECT_EQ(FindProgram("rodeira-clock", folder), prefix / "libexec/rodeira/rodeira-clock");
    EXPECT_EQ(FindProgram("rodeira-view", folder), folder / "rodeira-view");
    EXPECT_EQ(SharedDataFolder(folder), prefix / "share/rodeira");
  }
}

TEST_F(Installation, ThePrefixMovesAsAWhole) {
  const fs::path prefix = Installed("usr");
  fs::rename(prefix, folder_.path() / "opt");
  EXPECT_EQ(FindProgram("rodeira-clock", folder_.path() / "opt/bin"),
            folder_.path() / "opt/libexec/rodeira/rodeira-clock");
  EXPECT_EQ(SharedDataFolder(folder_.path() / "opt/bin"), folder_.path() / "opt/share/rodeira");
}

TEST_F(Installation, ABuildFolderUsesTheFilesOfItsSourceTree) {
  Folder("tree/launch");
  Folder("tree/configs");
  EXPECT_EQ(SharedDataFolder(Folder("tree/build/bin")), folder_.path() / "tree");
  EXPECT_EQ(SharedDataFolder(Folder("elsewhere/build/bin")), fs::path());
}

// A source tree that holds an installation, or an installation below a source tree: the nearest counts.
TEST_F(Installation, AnInstallationBelowASourceTreeUsesItsOwnFiles) {
  Folder("tree/launch");
  Folder("tree/configs");
  const fs::path prefix = Installed("tree/out/usr");
  EXPECT_EQ(SharedDataFolder(prefix / "bin"), prefix / "share/rodeira");
  fs::remove_all(prefix / "share/rodeira/configs");
  EXPECT_EQ(SharedDataFolder(prefix / "bin"), fs::path());  // incomplete: not the tree's by accident
}

TEST_F(Installation, TheEnvironmentNamesOtherFiles) {
  const fs::path prefix = Installed("usr");
  ::setenv("RODEIRA_DATA", "/somewhere/else", 1);
  EXPECT_EQ(SharedDataFolder(prefix / "bin"), fs::path("/somewhere/else"));
  ::setenv("RODEIRA_DATA", "", 1);
  EXPECT_EQ(SharedDataFolder(prefix / "bin"), prefix / "share/rodeira");
}

TEST(Version, IsThreeNumbers) {
  int major = -1, minor = -1, patch = -1, read = 0;
  ASSERT_EQ(std::sscanf(std::string(Version()).c_str(), "%d.%d.%d%n", &major, &minor, &patch, &read), 3);
  EXPECT_EQ(static_cast<std::size_t>(read), Version().size());
}

}  // namespace
}  // namespace rodeira::base
