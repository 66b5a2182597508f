// SPDX-License-Identifier: Apache-2.0
// The message for a mistyped command, option or value.
#include "launch/rodeira/option_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using system_test::Bin;
using testing::HasSubstr;

// Status 2 and the sentence.
std::string Refused(std::vector<std::string> words) {
  words.insert(words.begin(), Bin("rodeira"));
  const system_test::Ended ended = system_test::RunCommand(words);
  EXPECT_EQ(ended.status, 2) << ended.out;
  return ended.out;
}

TEST(OptionErrors, NameTheCommandThatWasMeant) {
  EXPECT_THAT(Refused({"wrold", "check", "a.yaml"}),
              HasSubstr("rodeira: unknown command 'wrold'; did you mean 'world'? (see 'rodeira --help')\n"));
  EXPECT_THAT(Refused({"trafic", "run", "a.motors"}),
              HasSubstr("rodeira: unknown command 'trafic'; did you mean 'traffic'? (see 'rodeira --help')\n"));
  EXPECT_THAT(
      Refused({"world", "chekc", "a.yaml"}),
      HasSubstr("rodeira world: unknown command 'chekc'; did you mean 'check'? (see 'rodeira world --help')\n"));
  EXPECT_THAT(Refused({"map"}),
              HasSubstr("rodeira map: a command is missing; expected check, convert (see 'rodeira map --help')\n"));
}

TEST(OptionErrors, NameTheOptionThatWasMeant) {
  EXPECT_THAT(Refused({"traffic", "run", "a.motors", "--vehicels", "4"}),
              HasSubstr("rodeira traffic run: unknown option '--vehicels'; did you mean '--vehicles'? (see 'rodeira "
                        "traffic run --help')\n"));
  EXPECT_THAT(
      Refused({"run", "a.yaml", "--recrod=x"}),
      HasSubstr("rodeira run: unknown option '--recrod'; did you mean '--record'? (see 'rodeira run --help')\n"));
  EXPECT_THAT(Refused({"info", "a.mcap", "b.mcap"}),
              HasSubstr("rodeira info: unexpected argument 'b.mcap' (see 'rodeira info --help')\n"));
}

TEST(OptionErrors, SayWhatAValueShouldBe) {
  EXPECT_THAT(Refused({"traffic", "run", "a.motors", "--driver", "moters"}),
              HasSubstr("rodeira traffic run: --driver: 'moters' was found; did you mean 'motors'? (see 'rodeira "
                        "traffic run --help')\n"));
  EXPECT_THAT(Refused({"traffic", "run", "a.motors", "--seed", "-1"}),
              HasSubstr("rodeira traffic run: --seed: '-1' was found; a whole number from 0 on was expected (see "
                        "'rodeira traffic run --help')\n"));
  EXPECT_THAT(Refused({"polyline", "scale", "a.csv", "-o", "b.csv", "--by", "0"}),
              HasSubstr("rodeira polyline scale: --by: '0' was found; a number above 0 was expected (see 'rodeira "
                        "polyline scale --help')\n"));
  EXPECT_THAT(Refused({"run", "a.yaml", "--for", "nan"}),
              HasSubstr("'nan' was found; a positive number of seconds was expected (see 'rodeira run --help')\n"));
}

TEST(OptionErrors, SayWhatIsNoNumber) {
  EXPECT_THAT(Refused({"world", "query", "a.yaml", "a", "2"}),
              Names("rodeira world query: X: 'a' was found; a number … (see 'rodeira world query --help')\n"));
  EXPECT_THAT(Refused({"world", "build", "a.yaml", "-o", "b", "--threads", "many"}),
              HasSubstr("rodeira world build: --threads: 'many' was found; a whole number was expected (see 'rodeira "
                        "world build --help')\n"));
}

TEST(OptionErrors, SayThatNoNumberIsMeantByNan) {
  EXPECT_THAT(Refused({"polyline", "translate", "a.csv", "-o", "b.csv", "--by", "nan", "2"}),
              HasSubstr("rodeira polyline translate: --by: 'nan' was found; a finite number was expected (see 'rodeira "
                        "polyline translate --help')\n"));
  EXPECT_THAT(Refused({"polyline", "rotate", "a.csv", "-o", "b.csv", "--deg", "inf"}),
              HasSubstr("rodeira polyline rotate: --deg: 'inf' was found; a finite number was expected (see 'rodeira "
                        "polyline rotate --help')\n"));
  EXPECT_THAT(Refused({"polyline", "offset", "a.csv", "-o", "b.csv", "--left", "nan"}),
              HasSubstr("rodeira polyline offset: --left: 'nan' was found; a finite number was expected (see 'rodeira "
                        "polyline offset --help')\n"));
  EXPECT_THAT(Refused({"polyline", "join", "a.csv", "b.csv", "-o", "c.csv", "--within", "nan"}),
              HasSubstr("rodeira polyline join: --within: 'nan' was found; a number from 0 on was expected (see "
                        "'rodeira polyline join --help')\n"));
  EXPECT_THAT(Refused({"world", "query", "a.yaml", "nan", "0"}),
              HasSubstr("rodeira world query: X: 'nan' was found; a finite number was expected (see 'rodeira world "
                        "query --help')\n"));
}

TEST(OptionErrors, SayHowManyValuesThereShouldBe) {
  EXPECT_THAT(Refused({"polyline", "translate", "a.csv", "-o", "b.csv", "--by", "1"}),
              HasSubstr("rodeira polyline translate: --by: 1 value was found; 2 to 3 were expected (see 'rodeira "
                        "polyline translate --help')\n"));
  EXPECT_THAT(Refused({"polyline", "rotate", "a.csv", "-o", "b.csv", "--deg", "9", "--about", "1"}),
              HasSubstr("rodeira polyline rotate: --about: 1 value was found; 2 were expected (see 'rodeira polyline "
                        "rotate --help')\n"));
  EXPECT_THAT(Refused({"traffic", "run", "a.motors", "--step", "1.5"}),
              HasSubstr("rodeira traffic run: --step: '1.5' was found; a number from 0.001 to 1 was expected (see "
                        "'rodeira traffic run --help')\n"));
}

// A missing folder is no place to write into: it is more likely mistyped.
TEST(OptionErrors, NoFolderIsMadeForAFile) {
  const TemporaryFolder folder;
  const std::string missing = (folder.path() / "no/such").string();
  const auto says = [&](std::vector<std::string> words) {
    EXPECT_THAT(Refused(std::move(words)),
                HasSubstr("'" + missing + "/it' was found; there is no folder '" + missing + "' (see 'rodeira "));
  };
  says({"world", "map", "a.yaml", "-o", missing + "/it"});
  says({"world", "export", "a.yaml", "-o", missing + "/it"});
  says({"world", "info", "a.yaml", "--svg", missing + "/it"});
  says({"map", "convert", "a.motors", "-o", missing + "/it"});
  says({"traffic", "run", "a.yaml", "--heat", missing + "/it"});
  says({"polyline", "scale", "a.csv", "--by", "2", "-o", missing + "/it"});
  says({"surface", "check", "a.crg", "--svg", missing + "/it"});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "no"));
}

TEST(OptionErrors, HelpAndVersionAreNoErrors) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--help"}, {"--version"}, {"world", "--help"}}) {
    std::vector<std::string> command{Bin("rodeira")};
    command.insert(command.end(), words.begin(), words.end());
    const system_test::Ended ended = system_test::RunCommand(command);
    EXPECT_EQ(ended.status, 0);
    EXPECT_FALSE(ended.out.empty());
    EXPECT_EQ(ended.out.find("rodeira: "), std::string::npos);
  }
}

TEST(OptionErrors, HelpIsAWordToo) {
  const auto said = [](const std::vector<std::string>& words) {
    std::vector<std::string> command{Bin("rodeira")};
    command.insert(command.end(), words.begin(), words.end());
    const system_test::Ended ended = system_test::RunCommand(command);
    EXPECT_EQ(ended.status, 0) << ended.out;
    return ended.out;
  };
  EXPECT_EQ(said({"help"}), said({"--help"}));
  EXPECT_EQ(said({"help", "world", "check"}), said({"world", "check", "--help"}));
}

}  // namespace
}  // namespace rodeira::cli
