// SPDX-License-Identifier: Apache-2.0
// OpenDRIVE files as a person types them at `rodeira world check`, `world build` and `traffic run`: options, measured
// surfaces, and files that hold no road.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <zip.h>
#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/core/base/files.hpp"
#include "tests/common/world/surface/made_crg.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/names.hpp"
#include "tests/system/command.hpp"

namespace rodeira::cli {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

system_test::Ended Rodeira(std::vector<std::string> words) {
  words.insert(words.begin(), system_test::Bin("rodeira"));
  return system_test::RunCommand(words);
}

// One road of 60 m with a lane of this type, and what stands before its end and the file's.
std::string Roads(const std::string& type = "driving", const std::string& of_road = "", const std::string& more = "") {
  return "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"1\" length=\"60\" "
         "junction=\"-1\">\n<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"60\"><line/></geometry>"
         "</planView>\n<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"" +
         type + "\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes>\n" +
         of_road + "</road>\n" + more + "</OpenDRIVE>\n";
}

// A surface that the file names is part of the check: missing, or laid in no way that there is, it is named with the
// file's line.
TEST(RoadFiles, MeasuredSurfacesOfAnOpenDriveFileAreLookedAt) {
  const TemporaryFolder folder;
  const auto check = [&](const std::string& surface) {
    const fs::path file = folder.Write(
        "s.xodr",
        "<?xml version=\"1.0\"?>\n<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"7\"/>\n<road id=\"1\" length=\"60\" "
        "junction=\"-1\">\n"
        "<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
        "length=\"60\"><line/></geometry></planView>\n<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center>"
        "<right><lane id=\"-1\" type=\"driving\"><width sOffset=\"0\" a=\"3\" b=\"0\" c=\"0\" "
        "d=\"0\"/></lane></right></laneSection></lanes>\n<surface>\n" +
            surface + "\n</surface></road>\n</OpenDRIVE>\n");
    return system_test::RunCommand({system_test::Bin("rodeira"), "world", "check", file.string()});
  };
  folder.Write("bumps.crg", surface::MadeCrg().Text());
  EXPECT_EQ(check(R"(<CRG file="bumps.crg" sStart="0" sEnd="10" orientation="same" mode="attached"/>)").status, 0);
  const system_test::Ended missing =
      check(R"(<CRG file="bumbs.crg" sStart="0" sEnd="10" orientation="same" mode="attached"/>)");
  EXPECT_EQ(missing.status, 0);
  EXPECT_THAT(missing.out, HasSubstr("s.xodr:8: rodeira.surface.file: road 1, s 0: "));
  EXPECT_THAT(missing.out, Names("s.xodr:8: rodeira.surface.file: … 'bumps.crg'"));
  const fs::path file = folder.path() / "s.xodr", repaired = folder.path() / "repaired.xodr";
  const auto again = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {system_test::Bin("rodeira"), "world", "check"});
    return system_test::RunCommand(options);
  };
  // Refused strictly; the repaired file is not.
  const auto expect_repaired = [&] {
    EXPECT_EQ(again({"--strict", file.string()}).status, 2);
    EXPECT_EQ(again({file.string(), "--force", "--repair", repaired.string()}).status, 0);
    EXPECT_EQ(again({"--strict", repaired.string()}).status, 0);
  };
  const system_test::Ended strict = again({"--strict", file.string()});
  EXPECT_THAT(strict.out, HasSubstr("s.xodr:8: rodeira.surface.file: road 1, s 0: "));
  expect_repaired();
  const system_test::Ended mode =
      check(R"(<CRG file="bumps.crg" sStart="0" sEnd="10" orientation="same" mode="attachd"/>)");
  EXPECT_EQ(mode.status, 0);
  EXPECT_THAT(mode.out, Names("s.xodr:8: road.surface.crg.mode: road 1, s 0: … 'attachd' … 'attached'"));
  expect_repaired();
  EXPECT_THAT(base::ReadText(repaired).value(), HasSubstr("mode=\"attached\""));
  // Cut in the middle of a number.
  const std::string whole = surface::MadeCrg().Text();
  folder.Write("cut.crg", whole.substr(0, whole.size() - 30));
  const system_test::Ended cut =
      check(R"(<CRG file="cut.crg" sStart="0" sEnd="10" orientation="same" mode="attached"/>)");
  EXPECT_EQ(cut.status, 0);
  EXPECT_THAT(cut.out, Names("s.xodr:8: rodeira.surface.damaged: road 1, s 0: … 'cut.crg' … cut.crg"));
  expect_repaired();
  const system_test::Ended beyond =
      check(R"(<CRG file="bumps.crg" sStart="0" sEnd="9000" orientation="same" mode="attached"/>)");
  EXPECT_EQ(beyond.status, 0);
  EXPECT_THAT(beyond.out, HasSubstr("s.xodr:8: road.surface.crg.s: road 1: the measured surface 'bumps.crg' lies from "
                                    "s = 0 to 9000; two places on the road, which is 60 m long, were expected; "
                                    "repaired: it is cut at the road's end"));
  EXPECT_EQ(system_test::RunCommand(
                {system_test::Bin("rodeira"), "world", "check", "--strict", (folder.path() / "s.xodr").string()})
                .status,
            2);
}

// Two roads of one kind of error: each is listed, or the file is refused by the first.
TEST(RoadFiles, VerboseListsAllAndNoRepairRefuses) {
  const TemporaryFolder folder;
  const std::string objects =
      "<objects><object id=\"1\" s=\"x\" t=\"0\"/>\n<object id=\"2\" s=\"y\" t=\"0\"/></objects>\n";
  const std::string file = folder.Write("two.xodr", Roads("driving", objects));
  const system_test::Ended usual = Rodeira({"world", "check", file});
  EXPECT_EQ(usual.status, 0) << usual.out;
  EXPECT_THAT(usual.out,
              testing::AllOf(HasSubstr("two.xodr:7: "), HasSubstr(" of this kind)"), Not(HasSubstr("two.xodr:8: "))));
  const system_test::Ended all = Rodeira({"world", "check", "--verbose", file});
  EXPECT_EQ(all.status, 0) << all.out;
  EXPECT_THAT(all.out,
              testing::AllOf(HasSubstr("two.xodr:7: "), HasSubstr("two.xodr:8: "), Not(HasSubstr("of this kind"))));
  const system_test::Ended refused = Rodeira({"world", "check", "--no-repair", file});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.out, testing::AllOf(HasSubstr("two.xodr:7: "), HasSubstr("two.xodr:8: "),
                                          Not(HasSubstr("repaired: ")), Not(HasSubstr("no error found"))));
}

// A number with a slip in a measured surface is passed over, and told with the surface's own line and column.
TEST(RoadFiles, ASlipInAMeasuredSurfaceIsToldWithItsPlace) {
  const TemporaryFolder folder;
  surface::MadeCrg crg;
  crg.sections = "$ROAD_CRG_OPTS\nBORDER_MODE_U = 2.0+e00\n$\n";
  const std::string text = crg.Text();
  const std::size_t at = text.find("BORDER_MODE_U");
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  folder.Write("slip.crg", text);
  const system_test::Ended said =
      Rodeira({"world", "check",
               folder.Write("s.xodr", Roads("driving",
                                            "<surface><CRG file=\"slip.crg\" sStart=\"0\" sEnd=\"10\" "
                                            "orientation=\"same\" mode=\"attached\"/></surface>\n"))});
  EXPECT_EQ(said.status, 0) << said.out;
  EXPECT_THAT(said.out, HasLine("slip.crg: … line " + std::to_string(line) + ": … column 20: … 2.0+e00"));
}

// Files in which nothing is to be driven, by every command: status 2, one sentence with the file's name, and nothing
// is written.
TEST(RoadFiles, WithoutARoadAreRefusedInOneSentenceAndLeaveNothing) {
  const TemporaryFolder folder;
  std::vector<std::string> files = {
      folder.Write("empty.xodr", ""),
      folder.Write("page.xodr", "<!DOCTYPE html>\n<html><body>404</body></html>\n"),
      folder.Write("itself.xodr", Roads("driving", "", "<include file=\"itself.xodr\"/>\n")),
      folder.Write("no_lane.xodr", Roads("sidewalk")),
      folder.path() / "bomb.xodrz",
      folder.path() / "outside.zip",
  };
  const std::string bomb = Roads() + std::string(20'000'000, ' ');
  gzFile packed = ::gzopen(files[4].c_str(), "wb9");
  ASSERT_EQ(::gzwrite(packed, bomb.data(), static_cast<unsigned>(bomb.size())), static_cast<int>(bomb.size()));
  ::gzclose(packed);
  const std::string road = Roads();
  zipFile zip = zipOpen64(files[5].c_str(), APPEND_STATUS_CREATE);
  ASSERT_EQ(zipOpenNewFileInZip(zip, "../../a.xodr", nullptr, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, 6), ZIP_OK);
  ASSERT_EQ(zipWriteInFileInZip(zip, road.data(), static_cast<unsigned>(road.size())), ZIP_OK);
  ASSERT_EQ(zipCloseFileInZip(zip), ZIP_OK);
  ASSERT_EQ(zipClose(zip, nullptr), ZIP_OK);
  const auto lying = [&] {
    std::map<std::string, std::string> bytes;
    for (const auto& each : fs::recursive_directory_iterator(folder.path()))
      bytes[each.path()] = each.is_regular_file() ? base::ReadText(each.path()).value() : "a folder";
    return bytes;
  };
  const auto before = lying();
  const std::string repaired = folder.path() / "out.xodr", built = folder.path() / "out";
  for (const std::string& file : files) {
    const std::vector<std::vector<std::string>> commands = {{"world", "check", file},
                                                            {"world", "check", file, "--repair", repaired},
                                                            {"world", "build", file, "-o", built},
                                                            {"traffic", "run", file, "--for", "1"}};
    for (const auto& command : commands) {
      const system_test::Ended said = Rodeira(command);
      EXPECT_EQ(said.status, 2) << testing::PrintToString(command) << said.out;
      EXPECT_THAT(said.out, testing::StartsWith("rodeira: " + file + ": ")) << testing::PrintToString(command);
      EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 1) << said.out;
      EXPECT_EQ(lying(), before) << testing::PrintToString(command);
    }
  }
}

}  // namespace
}  // namespace rodeira::cli
