// SPDX-License-Identifier: Apache-2.0
// Which requests `rodeira traffic run` refuses, before anything drives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <vector>

#include "common/core/base/files.hpp"
#include "launch/rodeira/commands/traffic_command.hpp"
#include "tests/launch/rodeira/commands/traffic_files_fixture.hpp"
#include "tests/tree.hpp"

namespace rodeira::cli {
namespace {

using testing::HasSubstr;

TEST_F(TrafficFilesTest, WrongTimesAreRefused) {
  options_.warm_s = 90.0;
  EXPECT_THAT(RunWith(options_).errors, HasSubstr("--warm: 90 s are left out of 90 s; less was expected"));
  options_.warm_s = 0.0, options_.physics = "full", options_.step_s = 0.2;
  EXPECT_THAT(RunWith(options_).errors, HasSubstr("--step: 0.2 s were given with full physics; at most 0.1 s"));
  options_.physics.clear(), options_.step_s = 0.05, options_.every_s = 10.0;
  EXPECT_THAT(RunWith(options_).errors,
              HasSubstr("--every: a table every so many seconds was asked for, and no folder for it"));
  options_.every_s = 0.0, options_.fcd = In("cars.csv");
  const Said said = RunWith(options_);
  EXPECT_EQ(said.status, 2);
  EXPECT_THAT(said.errors, HasSubstr("a file on .xml was expected"));
  options_.fcd.clear(), options_.heat = In("a.svg"), options_.pixel_m = 2.0;
  EXPECT_THAT(RunWith(options_).errors, HasSubstr("--pixel: a pixel of 2 m was given"));
}

TEST_F(TrafficFilesTest, AnImpossibleOptionIsRefusedBeforeAnythingDrives) {
  struct Case {
    std::function<void(TrafficOptions&)> change;
    int status;
    std::string sentence;
  };
  ASSERT_TRUE(base::WriteWhole(In("file"), "a file").ok());
  std::filesystem::create_directory(In("folder.svg"));
  ASSERT_TRUE(base::WriteWhole(In("bad.yaml"), "rodeira: traffic/1\nvariety: 0.6\n").ok());
  for (const Case& c : std::vector<Case>{
           {[&](TrafficOptions& o) { o.heat = In("heat.png"); }, 2,
            "--heat: '" + In("heat.png") + "' was found; a file on .svg or .tif was expected"},
           {[&](TrafficOptions& o) { o.diagram = In("d.svg"), o.lane = "1:-7"; }, 2,
            "--lane: '1:-7' was found; a drivable lane as ROAD:LANE was expected"},
           {[&](TrafficOptions& o) { o.diagram = In("d.svg"), o.lane = "1"; }, 2,
            "--lane: '1' was found; a drivable lane as ROAD:LANE was expected"},
           {[&](TrafficOptions& o) { o.csv = In("file") + "/out"; }, 1,
            In("file") + "/out: the folder cannot be written to"},
           {[&](TrafficOptions& o) { o.heat = In("file") + "/heat.svg"; }, 1,
            In("file") + "/heat.svg: the file cannot be created"},
           {[&](TrafficOptions& o) { o.heat = In("file") + "/heat.tif"; }, 1,
            In("file") + "/heat.tif: the file cannot be created"},
           {[&](TrafficOptions& o) { o.diagram = In("folder.svg"); }, 1,
            In("folder.svg") + ": the file cannot be written: a folder has that name"},
           {[&](TrafficOptions& o) { o.heat = In("heat.tif"), o.pixel_m = 0.01; }, 2, In("heat.tif") + ": "},
           {[&](TrafficOptions& o) { o.fcd = In("no/such/cars.xml"); }, 1,
            In("no/such/cars.xml") + ": the file cannot be written"},
           {[&](TrafficOptions& o) { o.settings = In("bad.yaml"); }, 2, In("bad.yaml") + ":2: 'variety' is 0.6"},
           {[&](TrafficOptions& o) { o.settings = In("none.yaml"); }, 2, In("none.yaml")},
           {[&](TrafficOptions& o) { o.map = In("none.motors"); }, 2, In("none.motors")},
           {[&](TrafficOptions& o) { o.map = In("none.yaml"); }, 2, In("none.yaml")},
           {[&](TrafficOptions& o) { o.map = In("file"); }, 2, In("file")},
       }) {
    TrafficOptions options = options_;
    c.change(options);
    const Said said = RunWith(options);
    EXPECT_EQ(said.status, c.status) << c.sentence;
    EXPECT_THAT(said.errors, testing::StartsWith("rodeira: " + c.sentence));
    EXPECT_EQ(said.out, "") << c.sentence;
  }
  for (const auto& left : std::filesystem::directory_iterator(folder_.path()))
    EXPECT_EQ(left.path().string().find("heat"), std::string::npos) << left.path();
}

// What is wrong with a map is told with its line; nothing drives.
TEST_F(TrafficFilesTest, AMapThatIsWrongIsRefused) {
  const std::string whole = base::ReadText(SourceDir() + "/configs/maps/lights.motors").value();
  const auto replaced = [&](const std::string& what, const std::string& with) {
    std::string text = whole;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
      text.replace(at, what.size(), with);
    return text;
  };
  options_.map = In("it.motors");
  const auto says = [&](const std::string& text, const std::string& companion, const std::string& sentence) {
    ASSERT_TRUE(base::WriteWhole(options_.map, text).ok());
    ASSERT_TRUE(base::WriteWhole(options_.map + ".yaml", companion).ok());
    const Said said = RunWith(options_);
    EXPECT_EQ(said.status, 2) << sentence;
    EXPECT_THAT(said.errors, testing::AllOf(testing::StartsWith("rodeira: "), HasSubstr(sentence)));
    EXPECT_EQ(said.out, "") << sentence;
  };
  const std::string none = "rodeira: motors/1\n";
  says(whole.substr(0, 1000), none, "it.motors: the file ends at byte 1000");
  says(replaced(",1,1\n", ",1,0\n"), none, "start");
  says(replaced("s,34", "c,1,999,False,0,0,0\ns,34"), none, "999");
  says(whole, none + "lights:\n  - phases: [{green: [1, 3], for_s: 20}, {green: [5, 7], for_s: 20}]\n",
       "green or amber together");
}

}  // namespace
}  // namespace rodeira::cli
