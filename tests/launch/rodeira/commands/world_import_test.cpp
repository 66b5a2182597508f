// SPDX-License-Identifier: Apache-2.0
// `rodeira world import` as a user sees it: what is printed, what is written, what is refused, and that the world
// drives.
#include "launch/rodeira/commands/world_import.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "common/core/base/files.hpp"
#include "common/traffic/traffic_model.hpp"
#include "common/world/lanes/lights.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "launch/rodeira/commands/traffic_command.hpp"
#include "launch/rodeira/commands/world_command.hpp"
#include "tests/launch/rodeira/said.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A village drawn by hand: a main street of two lanes a direction with lights where a side street crosses, a lane for
// buses, a one-way street, a path that no car uses.
const std::string kVillage = R"(<?xml version="1.0" encoding="UTF-8"?>
<osm version="0.6" generator="by hand">
 <node id="1" lat="60.1000" lon="24.9000"/>
 <node id="2" lat="60.1002" lon="24.9040"><tag k="highway" v="traffic_signals"/></node>
 <node id="3" lat="60.1003" lon="24.9085"/>
 <node id="4" lat="60.1008" lon="24.9130"/>
 <node id="5" lat="60.1022" lon="24.9043"/>
 <node id="6" lat="60.0985" lon="24.9038"/>
 <node id="7" lat="60.1020" lon="24.9088"/>
 <node id="8" lat="60.0990" lon="24.9080"/>
 <way id="100"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/>
  <tag k="highway" v="primary"/><tag k="name" v="Kyl&#228;tie"/><tag k="lanes" v="4"/><tag k="maxspeed" v="50"/></way>
 <way id="101"><nd ref="5"/><nd ref="2"/><nd ref="6"/>
  <tag k="highway" v="secondary"/><tag k="lanes" v="2"/><tag k="maxspeed" v="40"/></way>
 <way id="102"><nd ref="5"/><nd ref="7"/><nd ref="3"/>
  <tag k="highway" v="residential"/><tag k="oneway" v="yes"/><tag k="name" v="Kuja"/></way>
 <way id="103"><nd ref="3"/><nd ref="8"/><nd ref="6"/><tag k="highway" v="tertiary"/></way>
 <way id="104"><nd ref="7"/><nd ref="8"/><tag k="highway" v="footway"/></way>
</osm>
)";

class WorldImportTest : public testing::Test {
 protected:
  bool HasNetconvert() const { return std::system("command -v netconvert > /dev/null 2>&1") == 0; }
  Said Import(const std::string& file, const std::string& out, const std::string& elevation = "") const {
    return SaidBy(WorldImport, {file, out, elevation, true});
  }
  std::string Out(const std::string& name) const { return folder_.path() / name; }
  // The files that a refusal leaves: none but those that the test made.
  std::size_t Files() const {
    std::size_t count = 0;
    for (const auto& file : std::filesystem::directory_iterator(folder_.path())) count += file.exists() ? 1 : 0;
    return count;
  }
  void ExpectRefused(const std::string& file, const std::string& sentence) const {
    const std::size_t before = Files();
    const Said said = Import(file, Out("refused.yaml"));
    EXPECT_EQ(said.status, 2) << said.errors;
    EXPECT_THAT(said.errors, HasSubstr(sentence));
    EXPECT_THAT(said.errors, StartsWith("rodeira: " + file + ": "));
    EXPECT_EQ(said.errors.find('\n'), said.errors.size() - 1) << said.errors;
    EXPECT_EQ(said.out, "");
    EXPECT_EQ(Files(), before);
  }

  const TemporaryFolder folder_;
};

// The street and the junction lie where the file's degrees say, by another projection than the import's: metres on the
// sphere from the file's first node.
TEST_F(WorldImportTest, AVillageLiesWhereItsDegreesSay) {
  if (!HasNetconvert()) GTEST_SKIP() << "SUMO's netconvert is not installed";
  const std::string file = folder_.Write("village.osm", kVillage);
  const Said said = Import(file, Out("village.yaml"));
  ASSERT_EQ(said.status, 0) << said.errors;
  EXPECT_THAT(said.out, HasSubstr("lights: 1 with 2 controllers\n"));
  EXPECT_THAT(said.out, HasSubstr("wrote " + Out("village.yaml") + " and " + Out("village.xodr")));
  const auto world = road::World::Load(Out("village.yaml"));
  ASSERT_TRUE(world) << world.error().Text();
  const auto west = road::PlaceOnMap(*world.value(), 24.9000, 60.1000),
             east = road::PlaceOnMap(*world.value(), 24.9130, 60.1008);
  ASSERT_TRUE(west && east);
  constexpr double kRadius_m = 6378137.0, kDegree = M_PI / 180.0;
  const double x = 0.0130 * kDegree * kRadius_m * std::cos(60.1 * kDegree), y = 0.0008 * kDegree * kRadius_m;
  EXPECT_NEAR((east.value() - west.value()).norm(), std::hypot(x, y), 5.0);  // the ellipsoid: 0.5 %
  // On the street's middle there is road at both ends of the street, 8 m inside of them.
  const Eigen::Vector2d along = (east.value() - west.value()).normalized();
  EXPECT_TRUE(world.value()->At(west.value().x() + 8.0 * along.x(), west.value().y() + 8.0 * along.y()).inside);
  const std::string drive = base::ReadText(Out("village.xodr")).value();
  EXPECT_NE(drive.find("road name=\"102"), std::string::npos);  // the way's id, maybe with the number of a part
  EXPECT_NE(drive.find("code=\"sumo:street\" value=\"Kuja\""), std::string::npos);
  EXPECT_EQ(drive.find("name=\"104"), std::string::npos);  // the path
}

// Sixty seconds of traffic by the command, and by the model: no vehicle off its lane, none passes a line at red.
TEST_F(WorldImportTest, AVillageIsDriven) {
  if (!HasNetconvert()) GTEST_SKIP() << "SUMO's netconvert is not installed";
  const std::string file = folder_.path() / "village.osm.gz";
  gzFile packed = ::gzopen(file.c_str(), "wb");
  ASSERT_EQ(::gzwrite(packed, kVillage.data(), static_cast<unsigned>(kVillage.size())),
            static_cast<int>(kVillage.size()));
  ::gzclose(packed);
  ASSERT_EQ(Import(file, Out("village.yaml")).status, 0);
  TrafficOptions traffic;
  traffic.map = Out("village.yaml"), traffic.vehicles = 30, traffic.duration_s = 60.0;
  const Said driven = SaidBy(TrafficRun, traffic);
  EXPECT_EQ(driven.status, 0) << driven.errors;
  EXPECT_THAT(driven.out, HasSubstr("collisions       0\n"));
  EXPECT_THAT(driven.out, HasSubstr("beside its lane  0 times, a wheel off the road 0 times"));

  traffic::TrafficSettings settings;
  settings.vehicles = 30;
  const std::shared_ptr<const road::World> world = road::World::Load(Out("village.yaml")).value();
  traffic::TrafficModel model = std::move(traffic::TrafficModel::Make(settings, world, {})).value();
  // The line ahead of a vehicle's front, and its light.
  const auto ahead = [&](std::uint32_t id) -> std::optional<std::pair<double, std::uint32_t>> {
    const traffic::Agent& agent = model.agent(id);
    const double front = agent.o_m + 0.5 * model.traits(id).length_m;
    for (const traffic::Piece& piece : agent.path) {
      const auto lights = lanes::LightsOf(model.graph(), piece.track);
      if (!lights.empty() && piece.begin_m <= agent.o_m)
        return std::pair(piece.zero_m + lights[0].d_m - front, lights[0].controller);
    }
    return std::nullopt;
  };
  std::vector<double> gaps(settings.vehicles, -1.0);
  int passed = 0;
  for (int step = 0; step < 18000; ++step) {
    const std::vector<network::LightColour> before = model.colours();
    model.Step(0.01, {});
    for (const traffic::AgentPose& pose : model.poses()) {
      const auto line = ahead(pose.id);
      if (line && gaps[pose.id] >= 0.0 && line->first < 0.0) {
        ++passed;
        const network::LightColour colour = before[line->second];
        ASSERT_TRUE(colour == network::LightColour::kGreen || colour == network::LightColour::kAmber) << pose.id;
      }
      gaps[pose.id] = line ? line->first : -1.0;
    }
  }
  EXPECT_GE(passed, 5);
}

TEST_F(WorldImportTest, RefusesWhatIsNoMapWithOneSentence) {
  ExpectRefused(folder_.Write("page.osm", "<!DOCTYPE html>\n<html><body>Too many requests</body></html>"),
                "<!DOCTYPE>; <osm> was expected");
  ExpectRefused(folder_.Write("page.net.xml", "<html></html>"), "<html>; <net> was expected");
  ExpectRefused(folder_.Write("empty.osm", ""), "the file is empty");
  ExpectRefused(folder_.Write("text.osm", "Bad gateway"), "there is no XML element; <osm> was expected");
  ExpectRefused(folder_.Write("broken.osm.gz", "\x1f\x8b\x08nothing"), "the file cannot be unpacked");
  ExpectRefused(folder_.Write("map.osm.pbf", "x"), "osmium cat");
  ExpectRefused(folder_.Write("map.xml", "x"), "(.net.xml, .net.xml.gz) was expected");
  ExpectRefused(folder_.path() / "none.osm", "no such file");
}

TEST_F(WorldImportTest, RefusesAMapWithoutARoad) {
  if (!HasNetconvert()) GTEST_SKIP() << "SUMO's netconvert is not installed";
  ExpectRefused(folder_.Write("sea.osm", "<osm version=\"0.6\"><node id=\"1\" lat=\"1\" lon=\"2\"/></osm>"), "");
  ExpectRefused(folder_.Write("cut.osm", kVillage.substr(0, kVillage.size() / 2)), "netconvert refuses it: ");
  // A network of one path for people on foot.
  ExpectRefused(
      folder_.Write(
          "path.net.xml",
          "<net version=\"1.9\"><location netOffset=\"0,0\" convBoundary=\"0,0,100,0\" "
          "origBoundary=\"0,0,100,0\" projParameter=\"!\"/>"
          "<edge id=\"p\" from=\"a\" to=\"b\" priority=\"1\"><lane id=\"p_0\" index=\"0\" "
          "allow=\"pedestrian\" speed=\"2\" length=\"100\" shape=\"0,0 100,0\"/></edge>"
          "<junction id=\"a\" type=\"dead_end\" x=\"0\" y=\"0\" incLanes=\"\" intLanes=\"\" shape=\"0,0 0,1\"/>"
          "<junction id=\"b\" type=\"dead_end\" x=\"100\" y=\"0\" incLanes=\"p_0\" intLanes=\"\" "
          "shape=\"100,0 100,1\"/></net>"),
      "no lane for driving");
}

TEST_F(WorldImportTest, WritesNothingOverAnything) {
  const std::string file = folder_.Write("village.osm", kVillage);
  folder_.Write("there.xodr", "mine");
  for (const char* out : {"there.yaml", "there.xodr"}) {
    const Said said = Import(file, Out(out));
    EXPECT_EQ(said.status, 2);
    EXPECT_EQ(said.errors, "rodeira: " + Out("there.xodr") + ": this file exists; another name was expected\n");
  }
  EXPECT_EQ(base::ReadText(Out("there.xodr")).value(), "mine");
  EXPECT_EQ(Import(file, Out("world.txt")).status, 2);
  EXPECT_EQ(Files(), 2u);
}

// Without netconvert in PATH the package is named.
TEST_F(WorldImportTest, NamesThePackageOfNetconvert) {
  const std::string file = folder_.Write("village.osm", kVillage);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", folder_.path().c_str(), 1);
  const Said said = Import(file, Out("village.yaml"));
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(said.status, 2);
  EXPECT_THAT(said.errors, HasSubstr("netconvert"));
  EXPECT_THAT(said.errors, HasSubstr("`apt install sumo`"));
  EXPECT_EQ(Files(), 1u);
}

}  // namespace
}  // namespace rodeira::cli
