// SPDX-License-Identifier: Apache-2.0
// `rodeira doctor` as a person runs it.
#include "launch/rodeira/doctor/doctor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

using system_test::Bin;
using system_test::RunCommand;
using ::testing::HasSubstr;

TEST(Doctor, AFaultIsStatusOneAWarningIsNot) {
  EXPECT_EQ(StatusOf(std::vector<Finding>{Ok("a", "b"), Warning("system.few_cores", "c", "d")}), 0);
  EXPECT_EQ(StatusOf(std::vector<Finding>{Ok("a", "b"), Fault("system.no_gl", "c", "d"), Ok("e", "f")}), 1);
  EXPECT_EQ(FindingLine(Fault("system.no_gl", "GL", "no driver")), "fault    GL                 no driver\n");
}

TEST(Doctor, SaysALineACheck) {
  const TemporaryFolder folder;
  const auto ended =
      RunCommand({"XDG_DATA_HOME=" + folder.path().string(), Bin("rodeira"), "doctor", "--domain", "231"});
  for (const char* check : {"packages", "programs", "mathematics", "GL", "display", "joysticks", "shared memory",
                            "ports", "DDS shared memory", "sockets", "cores", "memory", "disk"}) {
    EXPECT_THAT(ended.out, ::testing::ContainsRegex(std::string("(ok|warning|fault) +") + check + " ")) << ended.out;
  }
  // Status 1 only with a fault that says what to do; which one depends on the machine.
  EXPECT_EQ(ended.status, ended.out.find("\nfault ") == std::string::npos && !ended.out.starts_with("fault ") ? 0 : 1)
      << ended.out;
}

TEST(Doctor, QuietSaysOnlyWhatIsNotWell) {
  const TemporaryFolder folder;
  const auto file = folder.Write("file", "in the way");
  const auto ended = RunCommand(
      {"XDG_DATA_HOME=" + file.string(), Bin("rodeira"), "doctor", "--quiet", "--transport", "udp", "--domain", "230"});
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("fault    disk               recordings go to " + file.string() + "/rodeira, but " +
                                   file.string() + " is no folder"))
      << ended.out;
  EXPECT_FALSE(ended.out.starts_with("ok ") || ended.out.find("\nok ") != std::string::npos) << ended.out;
}

TEST(Doctor, AsJsonEachFindingIsAnObjectWithItsId) {
  const TemporaryFolder folder;
  const auto file = folder.Write("file", "in the way");
  const auto ended = RunCommand({"XDG_DATA_HOME=" + file.string(), Bin("rodeira"), "doctor", "--quiet", "--json",
                                 "--transport", "udp", "--domain", "228"});
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out,
              HasSubstr(R"({"id":"system.no_recording_folder","check":"disk","verdict":"fault","message":)"));
  std::istringstream lines(ended.out);
  for (std::string line; std::getline(lines, line);)
    EXPECT_THAT(line,
                ::testing::MatchesRegex(R"(\{"id":"[a-z]+\.[a-z_]+","check":".*","verdict":".*","message":".*"\})"));
}

TEST(Doctor, WithoutMesaItIsAFault) {
  const TemporaryFolder empty;
  const auto ended =
      RunCommand({"__EGL_VENDOR_LIBRARY_DIRS=" + empty.path().string(), Bin("rodeira"), "doctor", "--domain", "229"});
  EXPECT_EQ(ended.status, 1) << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("fault    GL")) << ended.out;
}

TEST(Doctor, WrongOptionsAreStatusTwo) {
  EXPECT_EQ(RunCommand({Bin("rodeira"), "doctor", "--transport", "tcp"}).status, 2);
  EXPECT_EQ(RunCommand({Bin("rodeira"), "doctor", "--domain", "233"}).status, 2);
  EXPECT_EQ(RunCommand({Bin("rodeira"), "doctor", "--dommain", "3"}).status, 2);
}

}  // namespace
}  // namespace rodeira::cli
