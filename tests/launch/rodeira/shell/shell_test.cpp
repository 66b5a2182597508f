// SPDX-License-Identifier: Apache-2.0
// `rodeira completion`, `rodeira manual`: what bash, zsh and man make of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "launch/rodeira/option_errors.hpp"
#include "launch/rodeira/shell/command_table.hpp"
#include "launch/rodeira/shell/completion.hpp"
#include "launch/rodeira/shell/manual.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using system_test::Bin;
using system_test::RunCommand;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

bool Has(const std::string& program) { return RunCommand({"/bin/sh", "-c", "command -v " + program}).status == 0; }

// What bash offers for the last of these words.
std::vector<std::string> Offered(const std::string& words) {
  const TemporaryFolder folder;
  const auto script = folder.Write("rodeira.bash", RunCommand({Bin("rodeira"), "completion", "bash"}).out);
  const auto said = RunCommand({"/bin/bash", "-c",
                                "cd " + folder.path().string() + " && . " + script.string() + " && COMP_WORDS=(" +
                                    words + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _rodeira " + Bin("rodeira") +
                                    "; printf '%s\\n' \"${COMPREPLY[@]}\""});
  std::istringstream lines(said.out);
  std::vector<std::string> offered;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty()) offered.push_back(line);
  }
  return offered;
}

TEST(Completion, BashOffersCommandsOptionsWordsAndNames) {
  EXPECT_THAT(Offered("rodeira ''"), IsSupersetOf({"run", "world", "replay", "doctor", "--help"}));
  EXPECT_THAT(Offered("rodeira repl"), ElementsAre("replay"));
  EXPECT_THAT(Offered("rodeira world ''"), AllOf(IsSupersetOf({"check", "list"}), Not(Contains("run"))));
  EXPECT_THAT(Offered("rodeira run --hea"), ElementsAre("--headless"));
  EXPECT_THAT(Offered("rodeira run dem"), ElementsAre("demo"));
  EXPECT_THAT(Offered("rodeira run demo --head"), ElementsAre("--headless"));
  EXPECT_THAT(Offered("rodeira world info n2"), ElementsAre("n222"));
  EXPECT_THAT(Offered("rodeira vehicle test proto"), ElementsAre("prototype"));
  EXPECT_THAT(Offered("rodeira traffic run --driver ''"), ElementsAre("standard", "motors"));
  EXPECT_THAT(Offered("rodeira completion ''"), IsSupersetOf({"bash", "zsh"}));
  EXPECT_THAT(Offered("rodeira run --record rod"), ElementsAre("rodeira.bash"));  // files
  EXPECT_THAT(Offered("rodeira run --seed rod"), ElementsAre());                  // a number is expected
}

TEST(Completion, ZshReadsIts) {
  if (!Has("zsh")) GTEST_SKIP() << "zsh is not installed";
  const TemporaryFolder folder;
  const auto script = folder.Write("_rodeira", RunCommand({Bin("rodeira"), "completion", "zsh"}).out);
  EXPECT_EQ(RunCommand({"/usr/bin/env", "zsh", "-n", script.string()}).out, "");
}

TEST(Manual, ManPrintsItWithoutAWarning) {
  if (!Has("man") || !Has("groff")) GTEST_SKIP() << "man-db and groff are not installed";
  const TemporaryFolder folder;
  const auto page = folder.Write("rodeira.1", RunCommand({Bin("rodeira"), "manual"}).out);
  const auto said = RunCommand({"/usr/bin/env", "LC_ALL=C.UTF-8", "MANROFFOPT=-ww", "MANWIDTH=100", "man", "--warnings",
                                "-P", "cat", "-l", page.string()});
  EXPECT_EQ(said.status, 0);
  EXPECT_THAT(said.out, Not(HasSubstr(": warning: ")));  // troff: FILE:LINE: warning: TEXT
  EXPECT_THAT(said.out, AllOf(HasSubstr("rodeira run [OPTION]... [LAUNCH.yaml]"), HasSubstr("EXIT STATUS")));
}

// Texts with everything that a shell or man could take for its own.
TEST(Completion, TextsWithSignsOfTheShellAreTexts) {
  CLI::App app{"a program"};
  app.name("rodeira");
  CLI::App* odd = app.add_subcommand("odd", "it's $HOME: `id` \\ \"quoted\"");
  int number = 0;
  std::string word, file;
  odd->add_option("--number", number, "'n'");
  odd->add_option("--word", word, "one of")->check(OneOf({"a", "b"}));
  odd->add_option("FILE.mcap", file, ".hidden 'recording'")->required();
  odd->add_option("--secret", word)->group("");
  const auto table = CommandTable(app);
  ASSERT_EQ(table.size(), 2u);
  EXPECT_EQ(table[0].commands, std::vector<std::string>{"odd"});
  ASSERT_EQ(table[1].options.size(), 4u);  // FILE, --help, --number, --word
  EXPECT_TRUE(table[1].options[0].is_argument);
  EXPECT_EQ(table[1].options[2].value, "NUMBER");
  EXPECT_THAT(table[1].options[3].choices, ElementsAre("a", "b"));
  const TemporaryFolder folder;
  const auto bash = folder.Write("c.bash", BashCompletion(table));
  EXPECT_EQ(RunCommand({"/bin/bash", "-n", bash.string()}).out, "");
  EXPECT_THAT(BashCompletion(table), Not(HasSubstr("--secret")));
  EXPECT_THAT(ZshCompletion(table), HasSubstr("'odd:it'\\''s $HOME: `id` \\ \"quoted\"'"));
  const std::string page = ManualPage(table, "1.2.3");
  EXPECT_THAT(
      page, AllOf(HasSubstr("\n\\&.hidden"), HasSubstr("it's $HOME: `id` \\e \"quoted\""), HasSubstr("Rodeira 1.2.3")));
}

// Commands in commands are a level deeper; what the program itself has stands there only.
TEST(Manual, MarkdownHasEachCommandWithItsOptions) {
  CLI::App app{"a program"};
  app.name("rodeira");
  std::string text;
  bool json = false;
  app.add_flag("--json", json, "errors as JSON");
  CLI::App* outer = app.add_subcommand("outer", "the *outer* one");
  CLI::App* inner = outer->add_subcommand("inner", "the inner one");
  inner->add_flag("--json", json, "errors as JSON");
  inner->add_option("FILE", text, "a file_name <here>, as `a * b`")->required();
  inner->add_option("-o,--out", text, std::string(20, 'a') + " " + std::string(100, 'b'));
  inner->add_option("--secret", text)->group("");
  EXPECT_EQ(ManualMarkdown(CommandTable(app)),
            "## `rodeira`\n\nA program.\n\n- `-h`, `--help`: Print this help message and exit\n"
            "- `--json`: errors as JSON\n"
            "\n## `rodeira outer`\n\nThe \\*outer\\* one.\n"
            "\n### `rodeira outer inner FILE`\n\nThe inner one.\n\n"
            "- `FILE`: a file\\_name \\<here>, as `a * b`\n"
            "- `-o`, `--out TEXT`: " +
                std::string(20, 'a') + "\n  " + std::string(100, 'b') + "\n");
}

}  // namespace
}  // namespace rodeira::cli
