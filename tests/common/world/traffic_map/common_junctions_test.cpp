// SPDX-License-Identifier: Apache-2.0
// Maps with common junctions and connecting roads, as other programs read them: the same lanes, the same ways between
// them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include "common/core/base/files.hpp"
#include "common/world/opendrive/import.hpp"
#include "common/world/traffic_map/open_drive.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic_map {
namespace {

LaneMap Load(const std::string& name) {
  return LoadLaneMap(std::filesystem::path(SourceDir()) / "configs/maps" / (name + ".motors")).value();
}

class CommonJunctions : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    map_ = Load(GetParam());
    plan_ = PlanRoads(map_, Junctions::kCommon);
    const auto drive = ToOpenDrive(map_, GetParam());
    ASSERT_TRUE(drive.ok()) << drive.error().Text();
    xml_ = drive.value().xml;
    const auto import = opendrive::Read(xml_, "map.xodr");
    ASSERT_TRUE(import.ok()) << import.error().Text();
    for (const auto& error : import.value().errors) ADD_FAILURE() << error.Text();
    // Lanes that go on into one another keep the curvatures that they were drawn with, and headings to what their
    // file's digits leave (within a milliradian, or it is an error).
    for (const auto& warning : import.value().warnings)
      EXPECT_TRUE(warning.rule == "road.geometry.curvature" || warning.rule == "road.geometry.contact_heading")
          << warning.Text();
    network_ = import.value().network;
    ASSERT_NE(network_, nullptr);
  }
  LaneMap map_;
  RoadPlan plan_;
  std::string xml_;
  std::shared_ptr<const network::Network> network_;
};

// Every stretch of every lane lies on its own road, or on each connecting road that it is a part of.
TEST_P(CommonJunctions, EveryLaneIsThereWhole) {
  for (std::size_t lane = 0; lane < map_.lanes.size(); ++lane) {
    const LaneShape& shape = map_.lanes[lane].shape;
    for (int i = 0; i < 60; ++i) {
      const double s = shape.length_m() * (i + 0.5) / 60.0;
      const LanePoint at = shape.At(s);
      int found = 0;
      for (std::size_t r = 0; r < plan_.roads.size(); ++r) {
        double before = 0.0;
        for (const RoadPart& part : plan_.roads[r].parts) {
          const bool holds = part.lane == lane && s > part.from_m && s < part.to_m;
          if (holds) {
            const network::Road& road = network_->roads()[r];
            const double along = before + s - part.from_m;
            const auto span = road.SpanAt(road.SectionIndex(along), -1, along);
            ASSERT_TRUE(span.has_value());
            EXPECT_NEAR((road.Surface(along, 0.0).p_W.head<2>() - at.p_W).norm(), 0.0, 0.01)
                << map_.lanes[lane].id << " at " << s;
            EXPECT_NEAR(road.Surface(along, 0.0).p_W.z(), at.z_m, 0.01);
            EXPECT_NEAR(span->inner_t_m, at.left_m, 0.01);
            EXPECT_NEAR(span->outer_t_m, at.right_m, 0.01);
            ++found;
          }
          before += part.length_m();
        }
      }
      EXPECT_GE(found, 1) << map_.lanes[lane].id << " at " << s;
    }
  }
}

// From a lane's own road, through connecting roads that are no lane's own, one comes to the lanes that its connections
// say.
TEST_P(CommonJunctions, WaysLeadWhereConnectionsSay) {
  const auto own = [&](std::uint32_t road) { return road < map_.lanes.size(); };  // the lanes' roads come first
  for (std::uint32_t lane = 0; lane < map_.lanes.size(); ++lane) {
    std::set<std::uint32_t> expected, found;
    for (const std::size_t i : map_.lanes[lane].onward)
      expected.insert(static_cast<std::uint32_t>(map_.connections[i].to));
    for (const network::LaneEnd& next :
         network_->AtEnd({lane, static_cast<std::uint32_t>(network_->roads()[lane].spec().sections.size() - 1), -1})) {
      if (own(next.lane.road)) {
        found.insert(next.lane.road);
        continue;
      }
      const auto& sections = network_->roads()[next.lane.road].spec().sections;
      for (const network::LaneEnd& after :
           network_->AtEnd({next.lane.road, static_cast<std::uint32_t>(sections.size() - 1), -1}))
        found.insert(after.lane.road);
    }
    EXPECT_EQ(found, expected) << "lane " << map_.lanes[lane].id;
  }
}

// What OpenDRIVE 1.7 asks of common junctions: incoming roads are no connecting ones, connecting roads belong to the
// junction that names them.
TEST_P(CommonJunctions, ConnectingRoadsBelongToTheirJunctions) {
  std::set<std::string> named;
  for (const network::Junction& junction : network_->junctions()) {
    EXPECT_EQ(junction.type, "default");
    for (const network::JunctionConnection& connection : junction.connections) {
      EXPECT_EQ(network_->roads()[*network_->FindRoad(connection.incoming_road)].spec().junction, "");
      EXPECT_EQ(network_->roads()[*network_->FindRoad(connection.connecting_road)].spec().junction, junction.id);
      EXPECT_TRUE(named.insert(connection.connecting_road).second) << connection.connecting_road;
    }
  }
  for (const network::Road& road : network_->roads()) {
    if (road.spec().junction.empty()) continue;
    EXPECT_TRUE(named.contains(road.id())) << road.id();
    for (const auto& link : {road.spec().predecessor, road.spec().successor}) {
      ASSERT_TRUE(link.has_value() && !link->junction) << road.id();
      EXPECT_EQ(network_->roads()[*network_->FindRoad(link->id)].spec().junction, "");
    }
  }
}

// The text of an attribute that stands behind a place.
std::string Attribute(const std::string& text, const std::string& name, std::size_t from) {
  const std::size_t begin = text.find(" " + name + "=\"", from) + name.size() + 3;
  return text.substr(begin, text.find('"', begin) - begin);
}

// How long a line of "x,y[,z]" is in the plane.
double LengthOf(const std::string& shape) {
  std::istringstream words(shape);
  std::string word;
  double length = 0.0, x = 0.0, y = 0.0, before_x = 0.0, before_y = 0.0;
  for (int count = 0; words >> word; ++count, before_x = x, before_y = y) {
    std::sscanf(word.c_str(), "%lf,%lf", &x, &y);
    if (count > 0) length += std::hypot(x - before_x, y - before_y);
  }
  return length;
}

// Of the line that OpenDRIVE's lanes are counted from, which is what SUMO draws an edge along.
double CentreLength(const network::Road& road) {
  constexpr int kSteps = 2000;
  double length = 0.0;
  Eigen::Vector2d before;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = road.length_m() * i / kSteps;
    const Eigen::Vector2d p = road.Surface(s, road.CentreAt(s).value).p_W.head<2>();
    if (i > 0) length += (p - before).norm();
    before = p;
  }
  return length;
}

// SUMO's edges before it cuts them by shapes of junctions of its own, and all of its connections.
TEST_P(CommonJunctions, NetconvertReadsThemWithTheSameLengthsAndWays) {
  if (std::system("command -v netconvert > /dev/null 2>&1") != 0) GTEST_SKIP() << "SUMO's netconvert is not installed";
  const cli::TemporaryFolder folder;
  folder.Write("it.xodr", xml_);
  const std::string command =
      "cd " + folder.path().string() +
      " && { [ -n \"$SUMO_HOME\" ] || [ ! -d /usr/share/sumo ] || export SUMO_HOME=/usr/share/sumo; } && netconvert "
      "--opendrive-files it.xodr "
      "--opendrive.curve-resolution 0.2 --precision 6 --plain-output-prefix it --output-file it.net.xml > log 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << base::ReadText(folder.path() / "log").value();
  const std::string edges = base::ReadText(folder.path() / "it.edg.xml").value(),
                    net = base::ReadText(folder.path() / "it.net.xml").value();
  std::size_t expected = 0, found = 0, ways = 0, connections = 0;
  for (std::size_t i = 0; i < plan_.roads.size(); ++i) {
    const PlannedRoad& road = plan_.roads[i];
    ways += road.junction != kNoJunction || road.behind.road != kNoRoad;
    if (road.junction != kNoJunction) continue;
    ++expected;
    const std::size_t edge = edges.find("<edge id=\"-" + std::to_string(road.id) + "\"");
    ASSERT_NE(edge, std::string::npos) << road.name;
    const double length = CentreLength(network_->roads()[i]);
    EXPECT_NEAR(LengthOf(Attribute(edges, "shape", edge)), length, 2e-4 * length + 0.03)
        << road.name;  // SUMO sets its ends off by its chords of 0.2 m
  }
  for (std::size_t at = edges.find("<edge id="); at != std::string::npos; at = edges.find("<edge id=", at + 1)) ++found;
  EXPECT_EQ(found, expected);
  for (std::size_t at = net.find("<connection from=\"-"); at != std::string::npos;
       at = net.find("<connection from=\"-", at + 1))
    ++connections;
  EXPECT_EQ(connections, ways);
}

INSTANTIATE_TEST_SUITE_P(Maps, CommonJunctions,
                         testing::Values("crossing", "roundabout", "ramp", "town", "overpass", "lights"),
                         [](const auto& made) { return made.param; });

}  // namespace
}  // namespace rodeira::traffic_map
