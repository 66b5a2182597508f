// SPDX-License-Identifier: Apache-2.0
// The OpenDRIVE file read again by its own rules, and compared with the map's lanes.
#include "common/world/traffic_map/open_drive.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "common/core/base/random.hpp"
#include "common/world/network/marking.hpp"
#include "common/world/road/world.hpp"
#include "common/world/traffic_map/map_network.hpp"
#include "tests/common/world/traffic_map/sample_map.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"
#include "tests/tree.hpp"

namespace rodeira::traffic_map {
namespace {

using V = Eigen::Vector2d;

// The last child with a start (`s` or `sOffset`) not behind s.
pugi::xml_node ChildAt(pugi::xml_node parent, const char* name, const char* start, double s) {
  pugi::xml_node found;
  for (const pugi::xml_node node : parent.children(name)) {
    if (node.attribute(start).as_double() <= s) found = node;
  }
  return found;
}

double Cubic3(pugi::xml_node node, const char* suffix, double d) {
  const auto c = [&](const char* letter) {
    return node.attribute((std::string(letter) + suffix).c_str()).as_double(NAN);
  };
  return c("a") + c("b") * d + c("c") * d * d + c("d") * d * d * d;
}

// OpenDRIVE 1.7: the reference line (7.3.6), the lane's borders (9.3, 9.5), the elevation (8.1) at s.
struct Read {
  V p, left, right;
  double z;
};
Read ReadAt(pugi::xml_node road, double s) {
  const pugi::xml_node geometry = ChildAt(road.child("planView"), "geometry", "s", s);
  const pugi::xml_node cubic = geometry.child("paramPoly3");
  const double d = s - geometry.attribute("s").as_double(), heading = geometry.attribute("hdg").as_double();
  const auto place = [&](double at) {
    const double u = Cubic3(cubic, "U", at), v = Cubic3(cubic, "V", at);
    return V(geometry.attribute("x").as_double() + u * std::cos(heading) - v * std::sin(heading),
             geometry.attribute("y").as_double() + u * std::sin(heading) + v * std::cos(heading));
  };
  const V tangent = (place(d + 1e-4) - place(d - 1e-4)).normalized(), normal(-tangent.y(), tangent.x());
  const pugi::xml_node lanes = road.child("lanes");
  const pugi::xml_node offset = ChildAt(lanes, "laneOffset", "s", s);
  const pugi::xml_node width = ChildAt(lanes.child("laneSection").child("right").child("lane"), "width", "sOffset", s);
  const double t = Cubic3(offset, "", s - offset.attribute("s").as_double());
  const pugi::xml_node elevation = ChildAt(road.child("elevationProfile"), "elevation", "s", s);
  return {place(d), place(d) + t * normal,
          place(d) + (t - Cubic3(width, "", s - width.attribute("sOffset").as_double())) * normal,
          Cubic3(elevation, "", s - elevation.attribute("s").as_double())};
}

class Drive : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    auto map = LoadLaneMap(std::filesystem::path(SourceDir()) / "configs/maps" / (std::string(GetParam()) + ".motors"));
    ASSERT_TRUE(map.ok()) << map.error().Text();
    map_ = std::move(map).value();
    auto drive = ToOpenDrive(map_, GetParam(), Junctions::kDirect);
    ASSERT_TRUE(drive.ok()) << drive.error().Text();
    drive_ = std::move(drive).value();
    ASSERT_TRUE(document_.load_string(drive_.xml.c_str()));
    for (const pugi::xml_node road : document_.child("OpenDRIVE").children("road"))
      roads_[road.attribute("id").as_int()] = road;
  }
  LaneMap map_;
  OpenDrive drive_;
  pugi::xml_document document_;
  std::map<int, pugi::xml_node> roads_;
};

TEST_P(Drive, EveryLaneLiesWithinACentimetre) {
  ASSERT_EQ(roads_.size(), map_.lanes.size());
  double worst = 0.0;
  for (const MapLane& lane : map_.lanes) {
    const pugi::xml_node road = roads_.at(lane.id);
    const double length = lane.shape.length_m();
    EXPECT_EQ(road.attribute("length").as_double(), length);
    for (int i = 0; i <= 137; ++i) {
      const LanePoint at = lane.shape.At(length * i / 137.0);
      const Read read = ReadAt(road, length * i / 137.0);
      const V left = at.p_W + at.left_m * at.left_W(), right = at.p_W + at.right_m * at.left_W();
      worst = std::max({worst, (read.p - at.p_W).norm(), (read.left - left).norm(), (read.right - right).norm(),
                        std::abs(read.z - at.z_m)});
    }
  }
  EXPECT_LT(worst, 0.01);
  const double said = std::max({drive_.middle_error_m, drive_.border_error_m, drive_.height_error_m});
  EXPECT_LT(said, 0.005);
  EXPECT_LT(worst, 1.3 * said + 1e-6);  // what is printed is what is there
}

TEST_P(Drive, PiecesMeet) {
  ASSERT_FALSE(roads_.empty());
  for (const auto& [id, road] : roads_) {
    for (pugi::xml_node piece = road.child("planView").first_child(); piece.next_sibling();
         piece = piece.next_sibling()) {
      const double s = piece.next_sibling().attribute("s").as_double();
      EXPECT_DOUBLE_EQ(piece.attribute("s").as_double() + piece.attribute("length").as_double(), s);
      EXPECT_LT((ReadAt(road, s - 1e-9).p - ReadAt(road, s).p).norm(), 1e-8);
    }
  }
}

// Every connection is there once: as a link of two roads from both sides, or in a junction that both roads name.
TEST_P(Drive, EveryConnectionIsThereOnce) {
  std::multiset<std::pair<int, int>> expected, found;
  for (const MapConnection& connection : map_.connections)
    expected.insert({map_.lanes[connection.from].id, map_.lanes[connection.to].id});
  for (const auto& [id, road] : roads_) {
    const pugi::xml_node next = road.child("link").child("successor");
    if (std::string(next.attribute("elementType").value()) != "road") continue;
    const int other = next.attribute("elementId").as_int();
    found.insert({id, other});
    EXPECT_EQ(roads_.at(other).child("link").child("predecessor").attribute("elementId").as_int(), id);
    EXPECT_STREQ(next.attribute("contactPoint").value(), "start");
  }
  std::size_t junctions = 0;
  for (const pugi::xml_node junction : document_.child("OpenDRIVE").children("junction")) {
    ++junctions;
    for (const pugi::xml_node connection : junction.children("connection")) {
      const int from = connection.attribute("incomingRoad").as_int(), to = connection.attribute("linkedRoad").as_int();
      found.insert({from, to});
      for (const pugi::xml_node side :
           {roads_.at(from).child("link").child("successor"), roads_.at(to).child("link").child("predecessor")}) {
        EXPECT_STREQ(side.attribute("elementType").value(), "junction");
        EXPECT_EQ(side.attribute("elementId").as_int(), junction.attribute("id").as_int());
      }
    }
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(junctions, drive_.junctions);
}

INSTANTIATE_TEST_SUITE_P(Maps, Drive, testing::Values("crossing", "roundabout", "ramp", "town", "overpass", "lights"),
                         [](const auto& made) { return made.param; });

TEST(OpenDrive, StopAndMarks) {
  const LaneMap map = MakeLaneMap(ParseMap(GoodMap(), "x.motors").value(), {}, "x.motors").value();
  const OpenDrive drive = ToOpenDrive(map, "a<b", Junctions::kDirect).value();
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(drive.xml.c_str()));
  EXPECT_STREQ(document.child("OpenDRIVE").child("header").attribute("name").value(), "a<b");
  const pugi::xml_node road = document.child("OpenDRIVE").child("road");
  EXPECT_STREQ(road.child("signals").child("signal").attribute("type").value(), "206");
  EXPECT_NEAR(road.child("signals").child("signal").attribute("s").as_double(), 30.0, 1e-9);
  const pugi::xml_node line = road.child("signals").child("signal").next_sibling("signal");
  EXPECT_STREQ(line.attribute("type").value(), "294");
  EXPECT_NEAR(line.attribute("s").as_double(), 29.7, 1e-9);
  EXPECT_NEAR(line.attribute("t").as_double(), 1.5, 1e-9);
  EXPECT_NEAR(line.attribute("width").as_double(), 3.0, 1e-9);
  EXPECT_FALSE(line.next_sibling("signal"));
  EXPECT_FALSE(road.next_sibling("road").child("signals"));
  const pugi::xml_node section = road.child("lanes").child("laneSection");
  EXPECT_STREQ(section.child("center").child("lane").child("roadMark").attribute("type").value(), "broken");
  EXPECT_STREQ(section.child("right").child("lane").child("roadMark").attribute("type").value(), "solid");
}

TEST(OpenDrive, LinesWhereOneStopsOrGivesWayAreSaidOnce) {
  const auto companion = ParseHeights(
      "rodeira: motors/1\nsigns:\n  - {lane: 1, kind: stop}\n  - {lane: 1, kind: give_way, before_end_m: 10}\n  - "
      "{lane: 2, kind: give_way}\n"
      "lights:\n  - phases: [{green: [3], for_s: 10}, {green: [], for_s: 10}]\n",
      "x.motors.yaml");
  ASSERT_TRUE(companion.ok()) << companion.error().Text();
  const auto map = MakeLaneMap(ParseMap(GoodMap(), "x.motors").value(), companion.value(), "x.motors");
  ASSERT_TRUE(map.ok()) << map.error().Text();
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(ToOpenDrive(map.value(), "a", Junctions::kDirect).value().xml.c_str()));
  std::vector<std::string> lines;
  for (const pugi::xml_node road : document.child("OpenDRIVE").children("road")) {
    for (const pugi::xml_node signal : road.child("signals").children("signal")) {
      const std::string type = signal.attribute("type").value();
      if (type == "294" || type == "341")
        lines.push_back(
            fmt::format("{} {} {:.1f}", road.attribute("id").value(), type, signal.attribute("s").as_double()));
    }
  }
  // Lane 1 has a STOP flag and a STOP sign at one place; lane 3 a light, and is the arc that the cubic makes.
  const double turn_m = map.value().lanes[2].shape.length_m();
  EXPECT_EQ(lines, (std::vector<std::string>{"1 341 19.7", "1 294 29.7", "2 341 29.7",
                                             fmt::format("3 294 {:.1f}", turn_m - 0.3)}));
}

// What docs/reference/traffic-maps.md says of a border type: lines, their width, strokes and gaps.
struct Measures {
  BorderType type;
  int lines;
  double width_m, stroke_m, gap_m;
};
constexpr std::array<Measures, kBorderTypes> kMeasures = {{{BorderType::kNone, 0, 0.0, 0.0, 0.0},
                                                           {BorderType::kBoundary, 1, 0.15, 0.0, 0.0},
                                                           {BorderType::kSingle, 1, 0.12, 0.0, 0.0},
                                                           {BorderType::kDashed, 1, 0.12, 4.0, 8.0},
                                                           {BorderType::kDashedSame, 1, 0.12, 3.0, 9.0},
                                                           {BorderType::kDashedSpeedCtrl, 1, 0.30, 1.5, 1.5},
                                                           {BorderType::kDashedWarn, 1, 0.12, 5.0, 2.0},
                                                           {BorderType::kDoubleDashed, 2, 0.12, 4.0, 8.0}}};
constexpr double kLong_m = 120.0, kRow_m = 20.0;

// A straight lane of 3 m to the east for each type, one north of the other, with that type on both of its sides.
LaneMap MapOfAllTypes() {
  LaneMap map;
  for (int i = 0; i < kBorderTypes; ++i) {
    const auto side = [&](double y) {
      return Border{{{V(0.0, y), V(kLong_m / 3.0, y), V(2.0 * kLong_m / 3.0, y), V(kLong_m, y)}}, {}};
    };
    const auto type = static_cast<BorderType>(i);
    map.lanes.push_back(
        {i + 1, LaneMode::kStart, type, type, LaneShape(side(kRow_m * i + 1.5), side(kRow_m * i - 1.5)), {}, {}});
  }
  return map;
}

TEST(OpenDrive, EveryBorderTypeIsReadAgainWithItsMeasures) {
  const auto network = ToNetwork(MapOfAllTypes(), "types");
  ASSERT_TRUE(network.ok()) << network.error().Text();
  ASSERT_EQ(network.value()->roads().size(), kMeasures.size());
  for (const Measures& expected : kMeasures) {
    const network::Road& road = network.value()->roads()[static_cast<std::size_t>(expected.type)];
    const auto markings = network::MarkingsOf(road);
    ASSERT_EQ(markings.size(), static_cast<std::size_t>(2 * expected.lines)) << road.id();
    std::vector<double> places;
    for (const network::Marking& line : markings) {
      EXPECT_EQ(line.width_m, expected.width_m) << road.id();
      EXPECT_EQ(line.stroke_m, expected.gap_m > 0.0 ? expected.stroke_m : 0.0) << road.id();
      EXPECT_EQ(line.gap_m, expected.gap_m) << road.id();
      places.push_back(network::MarkingAt(road, line, 50.0).value);
      double painted = 0.0;
      for (const network::Stroke& stroke : network::StrokesOf(road, line)) painted += stroke.to_s_m - stroke.from_s_m;
      const double period = expected.stroke_m + expected.gap_m;
      const double whole = expected.gap_m == 0.0 ? kLong_m
                                                 : std::floor(kLong_m / period) * expected.stroke_m +
                                                       std::min(std::fmod(kLong_m, period), expected.stroke_m);
      EXPECT_NEAR(painted, whole, 1e-6) << road.id();
    }
    std::sort(places.begin(), places.end());
    const std::vector<double> one = {-1.5, 1.5}, two = {-1.62, -1.38, 1.38, 1.62};
    if (expected.lines == 0) continue;
    EXPECT_THAT(places, testing::Pointwise(testing::DoubleNear(1e-6), expected.lines == 1 ? one : two)) << road.id();
  }
}

TEST(OpenDrive, EveryBorderTypeIsPaintToSuelo) {
  const cli::TemporaryFolder folder;
  const auto world = road::World::Load(folder.Write("types.xodr", ToOpenDrive(MapOfAllTypes(), "types").value().xml));
  ASSERT_TRUE(world.ok()) << world.error().Text();
  int painted = 0;
  for (const Measures& expected : kMeasures) {
    for (std::uint64_t i = 0; i < 4'000; ++i) {
      const auto row = static_cast<std::uint64_t>(expected.type);
      const double x = base::RandomUniform({row, i, 1}, 0.0, kLong_m),
                   in = base::RandomUniform({row, i, 2}, 0.0, 0.4);  // from the lane's edge
      const double into = expected.gap_m > 0.0 ? std::fmod(x, expected.stroke_m + expected.gap_m) : 0.0;
      const double off = std::fabs(in - (expected.lines == 2 ? 0.12 : 0.0));
      if (std::fabs(off - 0.5 * expected.width_m) < 1e-4 || std::fabs(into - expected.stroke_m) < 1e-4) continue;
      const bool paint =
          expected.lines > 0 && off < 0.5 * expected.width_m && (expected.gap_m == 0.0 || into < expected.stroke_m);
      const double side = i % 2 == 0 ? 1.5 - in : in - 1.5;
      const road::SurfacePoint at = world.value()->At(x, kRow_m * static_cast<double>(row) + side);
      EXPECT_EQ(at.surface == ground::Surface::kRoadMark, paint)
          << "type " << row << " at " << x << ", " << in << " from the edge";
      painted += paint;
    }
  }
  EXPECT_GT(painted, 1500);
}

// (t², t³) from −1 to 1 turns back on itself at its cusp.
TEST(OpenDrive, ACuspIsRefused) {
  const auto cusp = [](double aside) {
    return Border{{{V(10, -10 + aside), V(-10.0 / 3.0, 10 + aside), V(-10.0 / 3.0, -10 + aside), V(10, 10 + aside)}},
                  {}};
  };
  LaneMap map;
  map.lanes.push_back(
      {7, LaneMode::kStart, BorderType::kNone, BorderType::kNone, LaneShape(cusp(1.5), cusp(-1.5)), {}, {}});
  const auto drive = ToOpenDrive(map, "x");
  ASSERT_FALSE(drive.ok());
  EXPECT_THAT(drive.error().Text(), testing::HasSubstr("lane 7: it turns too sharply at"));
}

}  // namespace
}  // namespace rodeira::traffic_map
