// SPDX-License-Identifier: Apache-2.0
// A file of another kind is known by its first bytes, and the command that takes it is named.
#include "common/core/base/file_kind.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "common/core/base/files.hpp"
#include "tests/names.hpp"
#include "tests/tree.hpp"

namespace rodeira::base {
namespace {

using namespace std::string_literals;

TEST(FileKind, ARecordingIsKnownByItsMark) {
  EXPECT_EQ(AboutFile("\x89MCAP0\r\n"s + "\0\1"s, "a/p07.mcap"),
            "a recording; watch it: rodeira replay a/p07.mcap --view; go on from it: rodeira replay a/p07.mcap --from "
            "SECONDS --branch KEY=VALUE --record NEW.mcap");
}

TEST(FileKind, EachFileOfTheSourceTreeIsKnown) {
  for (const auto& [file, names] : std::vector<std::pair<std::string, std::string>>{
           {"launch/demo.yaml", "launch file … rodeira run"},
           {"configs/worlds/n222.yaml", "world … rodeira world info"},
           {"configs/vehicles/default.yaml", "vehicle … rodeira vehicle test"},
           {"configs/maps/town.motors", "traffic map … rodeira map check"},
           {"configs/scenarios/car_ahead_brakes.yaml", "scenario"},
           {"configs/drivers/default.yaml", "driver"},
           {"configs/mechanisms/four_bar_40.yaml", "mechanism … rodeira mechanism run"}}) {
    const std::string path = SourceDir() + "/" + file;
    EXPECT_THAT(AboutFile(ReadText(path).value(), path), Names(names)) << file;
  }
}

TEST(FileKind, OtherFormatsAreKnownByTheirMarks) {
  EXPECT_THAT(AboutFile("<?xml version=\"1.0\"?>\n<OpenDRIVE>", "a.xml"), Names("OpenDRIVE … world info a.xml"));
  EXPECT_THAT(AboutFile("$comment\n[MDI_HEADER]\n", "a.txt"), Names("tyre … vehicle tyre a.txt"));
  EXPECT_THAT(AboutFile("PK\3\4", "a.fmu"), Names("FMU"));
}

TEST(FileKind, OtherTextsAreNotNamed) {
  for (const char* text : {"", "time_s,throttle\n", "rodeira: banana/1\n", "rodeira: launch\n", "# rodeira: launch/1\n",
                           "name: x\n  rodeira: launch/1\n"})
    EXPECT_EQ(AboutFile(text, "a.yaml"), "") << text;
  EXPECT_EQ(AboutOtherFormat("rodeira: launch/1\n", "a.yaml"), "") << "YAML";
}

}  // namespace
}  // namespace rodeira::base
