// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/files_from_here.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;

class FilesFromHere : public ::testing::Test {
 protected:
  FilesFromHere() {
    fs::create_directories(folder_.path() / "launch");
    fs::create_directories(folder_.path() / "here");
    fs::current_path(folder_.path() / "here");
    for (const char* file : {"kart.yaml", "script", "keys.yaml"}) folder_.Write(std::string("here/") + file, "");
  }
  ~FilesFromHere() override { fs::current_path(before_); }
  std::string Value(const std::string& key, const std::string& value) const {
    return WithFilesFromHere({{key, value}}, folder_.path() / "launch/demo.yaml").front().second;
  }
  const fs::path before_ = fs::current_path();
  const TemporaryFolder folder_;
};

TEST_F(FilesFromHere, AnExistingFileIsTakenFromTheCurrentDirectory) {
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "kart.yaml"), "\"../here/kart.yaml\"");
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "./kart.yaml"), "\"../here/kart.yaml\"");
  EXPECT_EQ(Value("nodes.driver.config", "{source: keyboard, keyboard: keys.yaml}"),
            "{source: keyboard, keyboard: ../here/keys.yaml}");
  EXPECT_EQ(WithFilesFromHere("kart.yaml"), "\"" + (fs::canonical(fs::current_path()) / "kart.yaml").string() + "\"");
}

TEST_F(FilesFromHere, EverythingElseStays) {
  EXPECT_EQ(Value("world", "../configs/none.yaml"), "../configs/none.yaml");
  EXPECT_EQ(Value("world", "/etc/hostname"), "/etc/hostname");
  EXPECT_EQ(Value("nodes.driver.config.source", "script"), "script") << "a word is no file";
  EXPECT_EQ(Value("nodes.recorder.config.file", "kart.yaml"), "kart.yaml") << "it is written";
  EXPECT_EQ(Value("duration_s", "2.5"), "2.5");
}

TEST_F(FilesFromHere, AMissingFileIsSoughtWhereItsFolderIs) {
  fs::create_directories(fs::current_path() / "cars");
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "cars/kart.yaml"), "\"../here/cars/kart.yaml\"");
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "trucks/kart.yaml"), "trucks/kart.yaml");
  fs::create_directories(folder_.path() / "launch/cars");
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "cars/kart.yaml"), "cars/kart.yaml") << "the launch file has this folder";
}

TEST_F(FilesFromHere, AMissingNameWithoutAFolderIsSoughtHere) {
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "truck.yaml"), "\"../here/truck.yaml\"");
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "cart.yaml"), "\"../here/cart.yaml\"") << "kart.yaml lies here";
  folder_.Write("launch/articulated_lorry.yaml", "");
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "articulated_lorry.yaml"), "articulated_lorry.yaml")
      << "it lies beside the launch file";
  EXPECT_EQ(Value("nodes.ego.config.vehicle", "articulated_lory.yaml"), "articulated_lory.yaml")
      << "nearly one beside the launch file";
  for (const char* no_file : {"2.5", "10.0.0.1", "pc.lan", "v1.2-rc", "car"})
    EXPECT_EQ(Value("discovery.interface", no_file), no_file);
}

TEST_F(FilesFromHere, FarFromTheLaunchFileItIsAbsolute) {
  const fs::path deep = folder_.path() / "a/b/c/d/e/f/g/h/i/demo.yaml";
  const auto value = WithFilesFromHere({{"world", "kart.yaml"}}, deep).front().second;
  EXPECT_EQ(value, "\"" + (fs::canonical(fs::current_path()) / "kart.yaml").string() + "\"");
}

}  // namespace
}  // namespace rodeira::cli
