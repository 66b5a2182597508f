// SPDX-License-Identifier: Apache-2.0
// What stands at roads, as it is drawn: against closed forms, SUELO, and the roads' own frames.
#include "common/view/scene/road_furniture/static_objects.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <string>

#include "common/view/scene/road_furniture/models.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"
#include "tests/tree.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector3d;

// A road with one lane a side, straight to the east or on a circle to the left, and what stands at it.
std::shared_ptr<const road::World> WorldWith(const std::string& more, const std::string& geometry = "<line/>",
                                             double length_m = 200.0) {
  const std::string width = "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>";
  return OpenDriveWorld(
      fmt::format("<road id=\"1\" length=\"{}\" junction=\"-1\"><planView><geometry s=\"0\" x=\"10\" y=\"20\" "
                  "hdg=\"0\" length=\"{}\">{}</geometry></planView>"
                  "<elevationProfile><elevation s=\"0\" a=\"5\" b=\"0\" c=\"0\" d=\"0\"/></elevationProfile>"
                  "<lanes><laneSection s=\"0\"><left><lane id=\"1\" type=\"driving\">{}</lane></left><center><lane "
                  "id=\"0\"/></center>"
                  "<right><lane id=\"-1\" type=\"driving\">{}</lane></right></laneSection></lanes>{}</road>\n",
                  length_m, length_m, geometry, width, width, more));
}

std::vector<Mesh> DrawAll(const StaticObjects& things, int level) {
  std::vector<Mesh> all;
  for (const auto& [key, tile] : things.tiles()) {
    DrawnStaticObjects drawn = DrawStaticObjects(tile, key, level);
    for (Mesh& mesh : drawn.meshes) all.push_back(std::move(mesh));
    for (Mesh& mesh : Merged(drawn.repeated)) all.push_back(std::move(mesh));
  }
  return all;
}

std::size_t Triangles(const StaticObjects& things, int level) {
  std::size_t count = 0;
  for (const Mesh& mesh : DrawAll(things, level)) count += mesh.triangle_count();
  return count;
}

// Of a body with its lower face on z = 0, and is missing: the flux of (0, 0, z).
double Volume(const Mesh& mesh) {
  double volume = 0.0;
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const Vector3d a = mesh.PositionW(mesh.triangles[3 * i]), b = mesh.PositionW(mesh.triangles[3 * i + 1]),
                   c = mesh.PositionW(mesh.triangles[3 * i + 2]);
    volume += (a.z() + b.z() + c.z()) / 6.0 * (b - a).cross(c - a).z();
  }
  return volume;
}

// A filling station has a roof on posts that a lorry passes under, fits its box, and stands where it was put.
TEST(StaticObjects, AFillingStationStandsInItsBox) {
  const auto world = WorldWith(
      R"(<objects><object id="f" type="building" subtype="filling_station" s="50" t="20" zOffset="0" length="24"
          width="14" height="6"/></objects>)");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  Vector3d low = Vector3d::Constant(1e9), high = -low;
  bool roof = false;
  for (const Mesh& mesh : DrawAll(things, 0)) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vector3d p = mesh.PositionW(i);
      low = low.cwiseMin(p), high = high.cwiseMax(p);
      roof = roof || (p.z() > 5.0 + 4.0 && mesh.normals[i].z() < -0.9F);  // seen from below
    }
  }
  EXPECT_NEAR((low - Vector3d(48.0, 33.0, 5.0)).head<2>().norm(), 0.0, 1.0);
  EXPECT_NEAR((high - Vector3d(72.0, 47.0, 11.0)).norm(), 0.0, 1.0);
  EXPECT_TRUE(roof);
}

TEST(StaticObjects, APlateStandsAtItsPlaceAndReadsFromLeftToRightForItsTraffic) {
  const auto world = WorldWith(
      R"(<signals><signal id="a" s="50" t="-5" zOffset="2" orientation="+" dynamic="no" type="274" subtype="-1"
          country="DE" value="70" unit="km/h" width="0.6" height="0.6"/></signals>)");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  int faces = 0;
  for (const Mesh& mesh : DrawAll(things, 0)) {
    if (mesh.material != Material::kSign) continue;
    ++faces;
    EXPECT_EQ(mesh.face, "speed_limit 70");
    ASSERT_EQ(mesh.on_face.size(), mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vector3d p = mesh.PositionW(i);
      EXPECT_NEAR(p.x(), 60.0 - 0.042, 1e-5);  // before its post, where traffic along s sees it
      // A car to the east has the south on the right: the picture's left edge lies north.
      EXPECT_NEAR(p.y(), 20.0 - 5.0 + 0.6 * (0.5 - static_cast<double>(mesh.on_face[i].x())), 1e-5);
      EXPECT_NEAR(p.z(), 5.0 + 2.0 + 0.6 * static_cast<double>(mesh.on_face[i].y()), 1e-5);
      EXPECT_NEAR((mesh.normals[i] - Eigen::Vector3f(-1.0F, 0.0F, 0.0F)).norm(), 0.0F, 1e-6F);
    }
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      const Vector3d a = mesh.PositionW(mesh.triangles[3 * i]), b = mesh.PositionW(mesh.triangles[3 * i + 1]),
                     c = mesh.PositionW(mesh.triangles[3 * i + 2]);
      EXPECT_LT((b - a).cross(c - a).x(), 0.0);  // seen from the west
    }
  }
  EXPECT_EQ(faces, 1);
}

// A board of two signs and a display for traffic to the east: it stands on its posts, what is on it lies a
// centimetre before it, to the left or right as its readers see it, on no post of its own.
TEST(StaticObjects, SignsLieOnTheirBoardAndADisplayIsNoTrafficLight) {
  const auto world = WorldWith(
      R"(<signals><signal id="a" s="50" t="-5" zOffset="2" orientation="+" dynamic="yes" type="multiBoard" subtype="-1"
          width="2" height="1.5">
    <staticBoard><sign id="l" country="DE" type="274" subtype="-1" value="70" unit="km/h" v="0.5" z="0.2" width="0.6"
      height="0.6"/><sign id="r" country="DE" type="206" subtype="-1" v="-0.5" z="0.3" width="0.6" height="0.6"/>
      </staticBoard>
    <vmsBoard displayType="text" v="0" z="1" displayWidth="1.8" displayHeight="0.4"/></signal></signals>)");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  std::map<std::string, Thing> by_face;
  for (const auto& [key, tile] : things.tiles()) {
    for (const Thing& thing : tile.things) by_face.emplace(thing.face, thing);
  }
  ASSERT_EQ(by_face.size(), 4u);
  for (const auto& [face, thing] : by_face) {
    EXPECT_EQ(thing.kind, ThingKind::kSign) << face;
    EXPECT_EQ(thing.on_post, face == "board") << face;
    EXPECT_FALSE(thing.both_sides);
  }
  EXPECT_NEAR(by_face.at("board").stand.foot_W.y(), 15.0, 1e-9);
  EXPECT_NEAR(by_face.at("speed_limit 70").stand.foot_W.y(), 15.5, 1e-9);  // their left is the north
  EXPECT_NEAR(by_face.at("stop").stand.foot_W.y(), 14.5, 1e-9);
  EXPECT_NEAR(by_face.at("stop").stand.foot_W.x(), by_face.at("board").stand.foot_W.x() - 0.01, 1e-9);
  EXPECT_NEAR(by_face.at("stop").above_m, 2.3, 1e-9);
  EXPECT_NEAR(by_face.at("display").above_m, 3.0, 1e-9);
  EXPECT_NEAR(by_face.at("display").width_m, 1.8, 1e-9);
}

TEST(StaticObjects, ASignSeenInTheWorldHangsAtItsHeight) {
  const auto world = OpenDriveWorld(
      "<road id=\"1\" length=\"100\" junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
      "length=\"100\"><line/></geometry></planView>"
      "<elevationProfile><elevation s=\"0\" a=\"7\" b=\"0\" c=\"0\" d=\"0\"/></elevationProfile>"
      "<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\"><width "
      "sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes>"
      "<signals><signal id=\"a\" s=\"30\" t=\"-5\" zOffset=\"2\" orientation=\"+\" dynamic=\"no\" type=\"206\" "
      "subtype=\"-1\" country=\"DE\"><positionInertial x=\"40\" y=\"-1\" z=\"12.5\" "
      "hdg=\"0\"/></signal></signals></road>\n");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  ASSERT_EQ(things.tiles().size(), 1u);
  const Thing& sign = things.tiles().begin()->second.things.at(0);
  EXPECT_NEAR(sign.stand.foot_W.z(), 7.0, 1e-9);
  EXPECT_NEAR(sign.above_m, 5.5, 1e-9);
  EXPECT_NEAR(sign.stand.foot_W.x(), 40.0, 1e-12);
  EXPECT_NEAR(sign.stand.x_W.x(), -1.0, 1e-12);  // it faces traffic to the east
}

TEST(StaticObjects, BothSidesOneWayOfLightsAndWhatHangsHasNoPost) {
  const auto world = WorldWith(R"(<signals>
    <signal id="both" s="50" t="5" zOffset="2" orientation="none" dynamic="no" type="267" subtype="-1" country="DE"/>
    <signal id="hangs" s="80" t="-2" zOffset="5" orientation="+" dynamic="no" type="999" subtype="-1" country="DE"/>
    <signal id="light" s="120" t="-5" zOffset="2.2" orientation="+" dynamic="yes" type="1000001" subtype="-1"
      country="OpenDRIVE"/>
    <signal id="arrow" s="122" t="-2" zOffset="0" orientation="+" dynamic="no" type="-1" subtype="-1"
      country="OpenDRIVE" height="0.03" width="0.8"/>
    <signal id="tall" s="123" t="-5" zOffset="0" orientation="+" dynamic="yes" type="1000001" subtype="-1"
      country="OpenDRIVE" height="3.22" width="0.45"/>
    <signal id="line" s="125" t="0" zOffset="0" orientation="+" dynamic="no" type="294" subtype="-1"
      country="OpenDRIVE"/></signals>)");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  std::vector<Thing> all;
  for (const auto& [key, tile] : things.tiles()) all.insert(all.end(), tile.things.begin(), tile.things.end());
  ASSERT_EQ(all.size(), 4u);
  EXPECT_NEAR(all[3].above_m + all[3].height_m, 3.22, 1e-12);  // a post counted with its lights
  EXPECT_LT(all[3].height_m, 1.0);
  EXPECT_TRUE(all[0].both_sides && all[0].on_post);
  EXPECT_EQ(all[1].face, "plate");
  EXPECT_FALSE(all[1].on_post);
  EXPECT_EQ(all[2].kind, ThingKind::kTrafficLight);
  bool east = false, west = false;
  for (const Mesh& mesh : DrawAll(things, 0)) {
    if (mesh.face != "no_entry") continue;
    for (const auto& normal : mesh.normals) east |= normal.x() > 0.9F, west |= normal.x() < -0.9F;
  }
  EXPECT_TRUE(east && west);
}

TEST(StaticObjects, ARailFollowsItsBendWithoutAGap) {
  // Half a circle of 50 m to the left about (10, 70), its rail 5 m to the right: 55 m from the middle.
  const double length = 150.0;
  const auto world = WorldWith(
      R"(<objects><object id="r" type="barrier" subtype="guardRail" s="0" t="-5" height="0.75" width="0.3">
          <repeat s="0" length="150" distance="0" tStart="-5" tEnd="-5"/></object></objects>)",
      "<arc curvature=\"0.02\"/>", length);
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  EXPECT_GT(things.tiles().size(), 0u);
  std::vector<RailPiece> pieces;
  for (const auto& [key, tile] : things.tiles()) pieces.insert(pieces.end(), tile.rails.begin(), tile.rails.end());
  const auto angle = [](const RailPiece& piece) {
    return std::atan2(piece.foot_W[0].x() - 10.0, 70.0 - piece.foot_W[0].y());
  };
  std::sort(pieces.begin(), pieces.end(), [&](const RailPiece& a, const RailPiece& b) { return angle(a) < angle(b); });
  double chords = 0.0;
  const Vector3d middle(10.0, 70.0, 5.0);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    EXPECT_FALSE(pieces[i].wall);
    if (i > 0) {
      EXPECT_EQ(pieces[i].foot_W[0], pieces[i - 1].foot_W[1]);
      EXPECT_EQ(pieces[i].left_W[0], pieces[i - 1].left_W[1]);
    }
    EXPECT_NEAR((pieces[i].foot_W[0] - middle).norm(), 55.0, 1e-9);
    EXPECT_GT((0.5 * (pieces[i].foot_W[0] + pieces[i].foot_W[1]) - middle).norm(), 55.0 - 0.03);
    chords += (pieces[i].foot_W[1] - pieces[i].foot_W[0]).norm();
  }
  EXPECT_NEAR(chords, length * 55.0 / 50.0, 0.1);
  for (const Mesh& mesh : DrawAll(things, 1)) {
    ASSERT_FALSE(mesh.positions.empty());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vector3d p = mesh.PositionW(i);
      EXPECT_NEAR((p - middle).head<2>().norm(), 55.0, 0.15);
      EXPECT_GE(p.z(), 5.0 - 1e-4);
      EXPECT_LE(p.z(), 5.75 + 1e-4);
    }
  }
}

TEST(StaticObjects, BodiesHaveTheirDeclaredVolumes) {
  EXPECT_NEAR(Volume(PlainModel({4.0, 3.0, 2.5}, 0.0, {}, 0)), 30.0, 1e-5);
  EXPECT_NEAR(Volume(PlainModel({0.0, 0.0, 2.0}, 1.5, {}, 0)),
              2.0 * 5.0 * std::sin(2.0 * 3.14159265358979 / 10.0) * 2.25, 1e-5);  // ten sides
  // An L of 6 x 4 m less 3 x 2 m, once each way round.
  const std::vector<Vector3d> corners = {{0, 0, 0}, {6, 0, 0}, {6, 2, 0}, {3, 2, 0}, {3, 4, 0}, {0, 4, 0}};
  const std::vector<double> heights(6, 3.0);
  Mesh one, other;
  AddOutline(one, corners, heights, true, {}, {});
  AddOutline(other, std::vector<Vector3d>(corners.rbegin(), corners.rend()), heights, true, {}, {});
  EXPECT_NEAR(Volume(one), 18.0 * 3.0, 1e-5);
  EXPECT_NEAR(Volume(other), 18.0 * 3.0, 1e-5);
  // A house: upright walls add nothing to the flux, the lid on them its height, the roof the mean of eaves and ridge.
  const double eaves = 0.68 * 7.0;
  EXPECT_NEAR(Volume(HouseModel({12.0, 9.0, 7.0}, 5, 1)), 108.0 * eaves + 108.0 * 0.5 * (7.0 + eaves), 1e-3);
}

TEST(StaticObjects, ObjectsByTheirKindsAndDeclaredSizes) {
  const auto world = WorldWith(R"(<objects>
    <object id="tree" type="tree" s="10" t="8" zOffset="0" radius="2" height="7"/>
    <object id="box" type="obstacle" s="30" t="8" zOffset="0.5" length="4" width="2" height="3" hdg="0.5"/>
    <object id="paint" type="parkingSpace" s="40" t="8" zOffset="0" length="5" width="2.5" height="0"/>
    <object id="block" type="building" s="60" t="20" zOffset="0" height="9"><outline>
      <cornerLocal u="-5" v="-4" z="0" height="9"/><cornerLocal u="5" v="-4" z="0" height="9"/>
      <cornerLocal u="5" v="4" z="0" height="9"/><cornerLocal u="-5" v="4" z="0" height="9"/></outline></object>
      </objects>)");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  ASSERT_EQ(things.tiles().size(), 1u);
  const auto& tile = things.tiles().begin()->second;
  ASSERT_EQ(tile.things.size(), 3u);
  EXPECT_EQ(tile.things[0].kind, ThingKind::kTree);
  EXPECT_EQ(tile.things[2].kind, ThingKind::kOutline);
  // The turned box: its corners' extremes along the world's axes.
  StaticObjects::Tile box;
  box.things.push_back(tile.things[1]);
  double low_z = 1e9, high_z = -1e9, east = -1e9;
  for (const Mesh& mesh : DrawStaticObjects(box, {0, 0}, 0).meshes) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const Vector3d p = mesh.PositionW(i);
      low_z = std::min(low_z, p.z()), high_z = std::max(high_z, p.z()), east = std::max(east, p.x());
    }
  }
  EXPECT_NEAR(low_z, 5.5, 1e-5);
  EXPECT_NEAR(high_z, 8.5, 1e-5);
  EXPECT_NEAR(east, 10.0 + 30.0 + 2.0 * std::cos(0.5) + 1.0 * std::sin(0.5), 1e-5);
}

// An island 0.15 m high with a kerb: the frame stands a centimetre over the filling, and both fill the outline.
TEST(StaticObjects, AnIslandHasItsKerbAndItsFilling) {
  const auto world = WorldWith(
      R"(<objects><object id="i" type="trafficIsland" s="50" t="0" height="0.15"><outlines>
          <outline id="0" fillType="grass"><cornerLocal u="-3" v="-1" z="0" height="0.15"/>
          <cornerLocal u="3" v="-1" z="0" height="0.15"/>
      <cornerLocal u="3" v="1" z="0" height="0.15"/><cornerLocal u="-3" v="1" z="0" height="0.15"/></outline>
        </outlines><borders><border outlineId="0" type="curb" width="0.25" useCompleteOutline="true"/></borders>
        </object></objects>)");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  ASSERT_EQ(things.tiles().size(), 1u);
  const StaticObjects::Tile& tile = things.tiles().begin()->second;
  ASSERT_EQ(tile.things.size(), 5u);  // four sides and what is within
  double kerb_m2 = 0.0, filled_m3 = 0.0;
  for (const Thing& thing : tile.things) {
    StaticObjects::Tile one;
    one.things.push_back(thing);
    const bool filling = thing.heights_m[0] == 0.15;
    for (Mesh& mesh : DrawStaticObjects(one, {0, 0}, 0).meshes) {
      mesh.origin_W.z() -= 5.0;  // the road's height: its lower face, which is missing, comes to lie on 0
      if (filling)
        filled_m3 += Volume(mesh);
      else
        kerb_m2 += Volume(mesh) / 0.16;
    }
    EXPECT_TRUE(thing.top.has_value());
  }
  EXPECT_NEAR(filled_m3, 6.0 * 2.0 * 0.15, 1e-4);
  EXPECT_NEAR(kerb_m2, 12.0 - 5.5 * 1.5, 1e-3);
}

// ASAM's example of a mast with an arm over the road: tapered round bars, and nothing of its box.
TEST(StaticObjects, AMastIsItsSkeleton) {
  const auto world =
      WorldWith(R"(<objects><object id="m" type="pole" s="50" t="-5" height="4" length="0.3" width="5"><skeleton>
      <polyline id="1"><vertexRoad s="50" t="-5" dz="0" radius="0.15"/><vertexRoad s="50" t="-5" dz="4" radius="0.1"/>
        </polyline>
      <polyline id="2"><vertexLocal u="0" v="0" z="3.5" width="0.1" length="0.2"/>
        <vertexLocal u="0" v="4" z="3.5" width="0.1" length="0.2"/></polyline></skeleton></object></objects>)");
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  ASSERT_EQ(things.tiles().size(), 1u);
  const StaticObjects::Tile& tile = things.tiles().begin()->second;
  ASSERT_EQ(tile.things.size(), 2u);
  const auto extent = [&](std::size_t which, Vector3d& low, Vector3d& high) {
    StaticObjects::Tile one;
    one.things.push_back(tile.things[which]);
    low = Vector3d::Constant(1e9), high = -low;
    double volume = 0.0;
    for (const Mesh& mesh : DrawStaticObjects(one, {0, 0}, 0).meshes) {
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        low = low.cwiseMin(mesh.PositionW(i)), high = high.cwiseMax(mesh.PositionW(i));
      volume += Volume(mesh);
    }
    return volume;
  };
  Vector3d low, high;
  // A frustum of ten sides.
  EXPECT_NEAR(extent(0, low, high),
              4.0 / 3.0 * 5.0 * std::sin(2.0 * 3.14159265358979 / 10.0) * (0.15 * 0.15 + 0.15 * 0.1 + 0.1 * 0.1),
              5e-4);  // float32, 60 m from the origin
  EXPECT_NEAR((low - Vector3d(60.0 - 0.15, 15.0 - 0.15, 5.0)).norm(), 0.0, 0.01);
  EXPECT_NEAR(high.z(), 9.0, 1e-4);
  // The arm lies along v: its width along u, its length upright.
  EXPECT_NEAR(extent(1, low, high), 4.0 * 0.1 * 0.2, 5e-4);
  EXPECT_NEAR((low - Vector3d(60.0 - 0.05, 15.0, 8.4)).norm(), 0.0, 1e-4);
  EXPECT_NEAR((high - Vector3d(60.0 + 0.05, 19.0, 8.6)).norm(), 0.0, 1e-4);
}

// A wall beside half a circle, said to leave the road's line: straight from its beginning to its end.
TEST(StaticObjects, ARailThatLeavesTheRoadsLineIsStraight) {
  const auto world = WorldWith(
      R"(<objects><object id="r" type="barrier" subtype="guardRail" s="0" t="-5" height="0.75" width="0.3">
          <repeat s="0" length="100" distance="0" tStart="-5" tEnd="-5" detachFromReferenceLine="true"/></object>
          </objects>)",
      "<arc curvature=\"0.02\"/>", 150.0);
  ASSERT_NE(world, nullptr);
  const StaticObjects things(*world);
  const Eigen::Vector2d begin(10.0, 15.0), end(10.0 + 55.0 * std::sin(2.0), 70.0 - 55.0 * std::cos(2.0)),
      way = (end - begin).normalized();
  double chords = 0.0;
  for (const auto& [key, tile] : things.tiles()) {
    for (const RailPiece& piece : tile.rails) {
      chords += (piece.foot_W[1] - piece.foot_W[0]).head<2>().norm();
      for (const Vector3d& foot : piece.foot_W)
        EXPECT_NEAR((foot.head<2>() - begin).dot(Eigen::Vector2d(-way.y(), way.x())), 0.0, 1e-9);
    }
  }
  EXPECT_NEAR(chords, (end - begin).norm(), 1e-9);
}

TEST(StaticObjects, StandOnTheGroundThatIsDrawn) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/example/world.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const StaticObjects things(*world.value());
  std::size_t count = 0;
  for (const auto& [key, tile] : things.tiles()) {
    for (const Thing& thing : tile.things) {
      const Vector3d& foot = thing.stand.foot_W;
      if (!world.value()->At(foot.x(), foot.y()).inside) continue;
      EXPECT_EQ(foot.z(), world.value()->At(foot.x(), foot.y(), foot.z()).z_m);
      ++count;
    }
  }
  EXPECT_GT(count, 15u);
}

TEST(StaticObjects, GetFewerTrianglesWithEachLevel) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/example/world.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const StaticObjects things(*world.value());
  std::size_t before = Triangles(things, 0);
  for (int level = 1; level < 4; ++level) {
    const std::size_t now = Triangles(things, level);
    EXPECT_LT(now, before) << level;
    before = now;
  }
  EXPECT_GT(before, 0u);  // a house is seen from afar
  for (const Mesh& mesh : DrawAll(things, 2)) EXPECT_NE(mesh.material, Material::kSign);
}

}  // namespace
}  // namespace rodeira::scene
