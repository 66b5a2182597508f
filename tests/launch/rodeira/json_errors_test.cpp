// SPDX-License-Identifier: Apache-2.0
// `--json`: every error of a command is one line of JSON on standard error, as Python's json module reads it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "common/core/base/print_error.hpp"
#include "tests/common/world/traffic_map/sample_map.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using system_test::Bin;
using system_test::RunCommand;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

// Runs the program with the words and prints its status, then "id | context | message | status" of each line of its
// standard error; a line that is no object of these four members ends it with a message of Python.
constexpr const char* kReader = R"(
import json, subprocess, sys
done = subprocess.run(sys.argv[1:], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
print(done.returncode)
for line in done.stderr.decode("utf-8").splitlines():
    error = json.loads(line)
    assert list(error) == ["id", "message", "context", "status"], line
    assert isinstance(error["status"], int), line
    print(error["id"], error["context"], error["message"], error["status"], sep=" | ")
)";

// The lines that the reader prints for `rodeira WORDS`.
std::vector<std::string> ErrorsOf(std::vector<std::string> words) {
  words.insert(words.begin(),
               {"/usr/bin/env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", "python3", "-c", kReader, Bin("rodeira")});
  const system_test::Ended ended = RunCommand(words);
  EXPECT_EQ(ended.status, 0) << ended.out;
  std::istringstream lines(ended.out);
  std::vector<std::string> errors;
  for (std::string line; std::getline(lines, line);) errors.push_back(line);
  return errors;
}

TEST(JsonErrors, NameWhatIsWrongWithAnOption) {
  EXPECT_THAT(ErrorsOf({"run", "a.yaml", "--recrod=x", "--json"}),
              ElementsAre("2",
                          "command.unknown_option | rodeira run | unknown option '--recrod'; did you mean "
                          "'--record'? (see 'rodeira run --help') | 2"));
  EXPECT_THAT(ErrorsOf({"--json", "wrold"}),
              ElementsAre("2",
                          "command.unknown_command | rodeira | unknown command 'wrold'; did you mean 'world'? (see "
                          "'rodeira --help') | 2"));
  const auto has_id = [](const std::string& id) { return ElementsAre("2", AllOf(StartsWith(id + " | rodeira "))); };
  EXPECT_THAT(ErrorsOf({"map", "--json"}), has_id("command.missing_command"));
  EXPECT_THAT(ErrorsOf({"info", "--json"}), has_id("command.missing_argument"));
  EXPECT_THAT(ErrorsOf({"info", "a", "b", "--json"}), has_id("command.unexpected_argument"));
  EXPECT_THAT(ErrorsOf({"run", "a", "--for", "nan", "--json"}), has_id("command.wrong_value"));
  EXPECT_THAT(ErrorsOf({"world", "query", "a", "b", "1", "--json"}), has_id("command.wrong_value"));
  EXPECT_THAT(ErrorsOf({"polyline", "translate", "a", "-o", "b", "--by", "1", "--json"}),
              has_id("command.wrong_count"));
  EXPECT_THAT(ErrorsOf({"joysticks", "--for", "1", "--json"}), has_id("command.missing_option"));
  EXPECT_THAT(ErrorsOf({"run", "a", "--list", "--json"}), has_id("command.conflicting_options"));
  EXPECT_THAT(ErrorsOf({"run", "a", "--json", "--set", "seed"}),
              ElementsAre("2", "command.wrong_value | --set seed | KEY=VALUE was expected | 2"));
}

TEST(JsonErrors, OfACommandHaveItsPlaceAndStatus) {
  const TemporaryFolder folder;
  const std::string missing = (folder.path() / "a.mcap").string();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"info", missing},
                                                {"export", "--csv", missing + ".csv", missing},
                                                {"replay", "--verify", missing},
                                                {"repair", missing, "--out", missing + ".whole"},
                                                {"measures", missing},
                                                {"map", "check", missing},
                                                {"surface", "check", missing},
                                                {"vehicle", "test", missing},
                                                {"mechanism", "run", missing, "--until", "1", "--step", "0.1"},
                                                {"traffic", "run", missing},
                                                {"world", "info", missing},
                                                {"run", missing}}) {
    std::vector<std::string> with_json = words;
    with_json.push_back("--json");
    const auto errors = ErrorsOf(with_json);
    ASSERT_THAT(errors, SizeIs(2)) << words.front();
    EXPECT_EQ(errors[0], "2") << words.front();
    EXPECT_THAT(errors[1], AllOf(HasSubstr(missing), testing::EndsWith(" | 2"))) << words.front();
  }
}

TEST(JsonErrors, AreOneForEachFinding) {
  const TemporaryFolder folder;
  const std::string map = folder.Write("a.motors", traffic_map::kGoodLines + "c,1,7,False\nc,1,8,False\ns,10\ni\n");
  EXPECT_THAT(ErrorsOf({"map", "check", map, "--json"}),
              ElementsAre("2", "map.no_lane | " + map + ":12 | connection 1 to 7: lane 7 does not exist | 2",
                          "map.no_lane | " + map + ":13 | connection 1 to 8: lane 8 does not exist | 2"));
}

TEST(JsonErrors, OfAnOpenDriveFileHaveTheIdsOfTheirRules) {
  const TemporaryFolder folder;
  const std::string file = folder.Write(
      "a.xodr",
      "<OpenDRIVE>\n<header revMajor='1' revMinor='7'/>\n<road id='1' length='60' junction='-1'><planView>\n"
      "<geometry s='0' x='0' y='0' hdg='0' length='40'><line/></geometry>\n"
      "<geometry s='40' x='40.5' y='0' hdg='0' length='20'><line/></geometry></planView>\n"
      "<lanes><laneSection s='0'><center><lane id='0'/></center><right><lane id='-1' type='driving'>"
      "<width sOffset='0' a='3' b='0' c='0' d='0'/></lane></right></laneSection></lanes></road>\n</OpenDRIVE>\n");
  EXPECT_THAT(ErrorsOf({"world", "check", file, "--strict", "--json"}),
              ElementsAre("2", AllOf(StartsWith("opendrive.road_geometry_contact_point | " + file +
                                                ":5 | road.geometry.contact_point: road 1, s 40: "),
                                     HasSubstr(" 0.5 m "))));
}

TEST(JsonErrors, OfAWarningHaveStatusZero) {
  const TemporaryFolder folder;
  const std::string map = folder.Write("a.motors", traffic_map::kGoodLines + "p,9,0,0,0,1,0,0,2,0,0,3,0,0\ns,10\ni\n");
  EXPECT_THAT(ErrorsOf({"map", "check", map, "--json"}),
              ElementsAre("0", "map.unused_curve | " + map + ":12 | curve 9: no lane uses it | 0"));
}

TEST(JsonErrors, OfARunNameItsFault) {
  const TemporaryFolder folder;
  const std::string vehicle = folder.Write("broken.yaml", "rodeira: vehicle/1\nmass_kg: heavy\n");
  const std::vector<std::string> words{"run",         "first_drive", "--for", "0.1",
                                       "--no-record", "--json",      "--set", "nodes.ego.config.vehicle=" + vehicle};
  std::vector<std::string> in_process = words;
  in_process.push_back("--in-process");
  for (const auto& command : {words, in_process}) {
    const auto errors = ErrorsOf(command);
    ASSERT_THAT(errors, SizeIs(2));
    EXPECT_EQ(errors[0], "2");
    EXPECT_THAT(errors[1], AllOf(HasSubstr("broken.yaml"), testing::EndsWith(" | 2")));
  }
}

// A disk that is full is no wrong input: status 1.
TEST(JsonErrors, OfAFullDiskHaveStatus1) {
  const auto full = RunCommand({"/bin/bash", "-c", Bin("rodeira") + " manual --json >/dev/full"});
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.out, AllOf(StartsWith(R"({"id":"file.cannot_write","message":"cannot write to standard output)"),
                              testing::EndsWith(R"(","context":"","status":1})"
                                                "\n")));
}

// Quotes and backslashes are escaped; what is no UTF-8 is made visible.
TEST(JsonErrors, HoldAnyFileName) {
  const auto errors = ErrorsOf({"info", "/no/a\"b\\c\n\xff\u00fc.mcap", "--json"});
  ASSERT_THAT(errors, SizeIs(2));
  EXPECT_THAT(errors[1], HasSubstr("/no/a\"b\\c\\n\\xff\u00fc.mcap"));
  const base::Error error{base::ErrorCode::kFailed, "file.cannot_open", "a \"b\"\t\\", "c\x01"};
  EXPECT_EQ(base::ErrorJson(error),
            R"({"id":"file.cannot_open","message":"a \"b\"\\t\\","context":"c\\x01","status":1})");
}

TEST(JsonErrors, AreOfferedByEveryCommand) {
  std::istringstream page(RunCommand({Bin("rodeira"), "manual"}).out);
  std::string command;
  int commands = 0;
  bool has_json = true;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with(".S")) {
      EXPECT_TRUE(has_json) << command;
      command = line;
      has_json = !line.starts_with(".SS");
      commands += has_json ? 0 : 1;
    }
    has_json = has_json || line == "\\fB\\-\\-json\\fR";
  }
  EXPECT_GT(commands, 30);
}

}  // namespace
}  // namespace rodeira::cli
