// SPDX-License-Identifier: Apache-2.0
// What exists is replaced only by --force, whatever command writes it.
#include "launch/rodeira/result_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using system_test::Bin;

class ResultFiles : public ::testing::Test {
 protected:
  base::Status Check(const std::string& words) {
    CLI::App app{"a program"};
    app.name("rodeira");
    CLI::App* command = app.add_subcommand("write");
    command->add_option("-o,--out", file_)->check(NewFile());
    command->add_option("--tables", tables_)->check(NewFolder());
    command->add_option("--read", read_);
    app.add_subcommand("read");
    AddForce(app);
    app.parse(words);
    return CheckResults(app);
  }
  std::string Path(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
  std::string file_, tables_, read_;
};

TEST_F(ResultFiles, AFileThatExistsNeedsForce) {
  (void)folder_.Write("old.csv", "precious");
  EXPECT_TRUE(Check("write -o " + Path("new.csv")).ok());
  EXPECT_TRUE(Check("write --read " + Path("old.csv")).ok());
  EXPECT_TRUE(Check("write -o /dev/null").ok());
  EXPECT_TRUE(Check("write -o " + Path("old.csv") + " --force").ok());
  EXPECT_TRUE(Check("read").ok());
  const auto refused = Check("write -o " + Path("old.csv"));
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().Text(), "rodeira write: --out " + Path("old.csv") +
                                        ": the file exists; name another one, or replace it by --force");
  EXPECT_EQ(refused.error().exit_status(), 2);
}

TEST_F(ResultFiles, AFolderWithFilesNeedsForce) {
  EXPECT_TRUE(Check("write --tables " + Path("new")).ok());
  std::filesystem::create_directories(Path("empty"));
  EXPECT_TRUE(Check("write --tables " + Path("empty")).ok());
  (void)folder_.Write("full/a.csv", "precious");
  EXPECT_TRUE(Check("write --force --tables " + Path("full")).ok());
  const auto refused = Check("write --tables " + Path("full"));
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error(), IsError("file.exists", "rodeira write: --tables … full … --force"));
}

// What a command wrote before it writes again; a folder that holds anything else it does not touch.
TEST_F(ResultFiles, AFolderIsRenewedByTheCommandThatWroteIt) {
  const std::string world = folder_.Write("w.yaml", "rodeira: world/2\nname: w\nground: {kind: plane}\n").string();
  const auto build = [&](const std::string& out) {
    return system_test::RunCommand({Bin("rodeira"), "world", "build", world, "-o", out, "--quiet", "--json"});
  };
  EXPECT_EQ(build(Path("built")).status, 0);
  EXPECT_EQ(build(Path("built")).status, 0);
  std::filesystem::remove(Path("built") + "/logical.txt");
  EXPECT_EQ(build(Path("built")).status, 2);

  (void)folder_.Write("tables/a.csv", "precious");
  EXPECT_THAT(build(Path("tables")).out, Names("file.exists … --force … world build: --out … tables"));
  const std::filesystem::directory_iterator left(Path("tables"));
  EXPECT_EQ(std::distance(begin(left), end(left)), 1) << "nothing was written";
}

// "town.xodr" is written beside "town.yaml", and beside no other file.
TEST_F(ResultFiles, WhatIsWrittenBesideOneIsNotReplacedEither) {
  (void)folder_.Write("town.xodr", "precious");
  const std::string none = Path("none");
  const auto convert = [&](const std::string& name, const char* more) {
    return system_test::RunCommand({Bin("rodeira"), "map", "convert", none, "-o", Path(name), more, "--json"}).out;
  };
  EXPECT_THAT(convert("town.yaml", "--json"), Names("file.exists … town.xodr … --force"));
  EXPECT_THAT(convert("town.yaml", "--force"), Names("file.not_found … none"));
  EXPECT_THAT(convert("town.svg", "--json"), Names("file.not_found … none"));
  (void)folder_.Write("table.measures.yaml", "precious");
  const system_test::Ended ended =
      system_test::RunCommand({Bin("rodeira"), "--json", "measures", none, "-o", Path("table.csv")});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.out, Names("file.exists … table.measures.yaml … --force"));
}

// Refused before anything is read: the inputs are not there.
TEST_F(ResultFiles, EveryCommandThatWritesKeepsTheRule) {
  const std::string old = folder_.Write("old.csv", "precious").string();
  (void)folder_.Write("full/a.csv", "precious");
  const std::string full = Path("full"), none = Path("none");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"measures", none, "-o", old},
           {"measures", none, "--series", old},
           {"report", none, "-o", old},
           {"traffic", "run", none, "--csv", full},
           {"traffic", "run", none, "--heat", old},
           {"traffic", "run", none, "--fcd", old},
           {"traffic", "run", none, "--tripinfo", old},
           {"traffic", "run", none, "--diagram", old},
           {"vehicle", "test", none, "--csv", old},
           {"vehicle", "test", none, "--svg", old},
           {"vehicle", "test", none, "--out", full},
           {"vehicle", "rig", none, "--out", full},
           {"vehicle", "tyre", none, "--csv", old},
           {"mechanism", "run", none, "--step", "0.001", "--until", "1", "--svg", old},
           {"polyline", "join", none, none, "-o", old},
           {"surface", "check", none, "--svg", old},
           {"map", "convert", none, "-o", old},
           {"world", "map", none, "-o", old},
           {"world", "build", none, "-o", full},
           {"world", "export", none, "-o", old},
           {"world", "import", none, "-o", old},
           {"world", "check", none, "--repair", old},
           {"world", "info", none, "--profile", old},
           {"input", "setup", "-o", old},
           {"replay", none, "--frames", full, "--at", "1"}}) {
    std::vector<std::string> line{Bin("rodeira"), "--json"};
    line.insert(line.end(), words.begin(), words.end());
    const system_test::Ended ended = system_test::RunCommand(line);
    EXPECT_EQ(ended.status, 2) << words.front();
    EXPECT_THAT(ended.out, Names("file.exists … --force")) << words.front() << " " << words[1];
  }
  EXPECT_EQ(base::ReadText(old, 100).value(), "precious");
}

}  // namespace
}  // namespace rodeira::cli
