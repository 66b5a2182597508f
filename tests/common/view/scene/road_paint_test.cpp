// SPDX-License-Identifier: Apache-2.0
// Crossings, stop lines and arrows painted on roads: against areas in closed form, the Vienna Convention's measures and
// symmetry.
#include "common/view/scene/road_markings/road_paint.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/view/scene/road_markings/stencils.hpp"
#include "common/view/scene/visual_world/ground_tile.hpp"
#include "common/world/network/network.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"

namespace rodeira::scene {
namespace {

using Eigen::Vector2d;

double AreaOf(const Polygon2& polygon) {
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += 0.5 * geometry::Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return area;
}

double AreaOf(const std::vector<Polygon2>& shape) {
  double area = 0.0;
  for (const Polygon2& polygon : shape) area += AreaOf(polygon);
  return area;
}

Polygon2 Box(double length, double width) {
  return {{-0.5 * length, -0.5 * width},
          {0.5 * length, -0.5 * width},
          {0.5 * length, 0.5 * width},
          {-0.5 * length, 0.5 * width}};
}

TEST(Stencils, AZebraHasTheConventionsStripesEvenlyOnBothSides) {
  static_assert(kStripeGap_m >= kStripe_m && kStripeGap_m <= 2.0 * kStripe_m && kStripe_m + kStripeGap_m >= 1.0 &&
                kStripe_m + kStripeGap_m <= 1.4);
  for (const double width : {0.4, 3.5, 7.0, 7.5, 10.49, 10.5}) {
    const auto stripes = ZebraShape(Box(4.0, width));
    const double count =
        std::max(1.0, std::floor(width + 0.5));  // stripes and gaps of half a metre: one stripe more than gaps
    ASSERT_EQ(stripes.size(), static_cast<std::size_t>(count)) << width;
    EXPECT_NEAR(AreaOf(stripes), 4.0 * std::min(width, 0.5 * count), 1e-12);
    EXPECT_NEAR(stripes.front()[0].y(), -stripes.back()[2].y(), 1e-12);
  }
}

TEST(Stencils, StripesEndAtASlantedOutline) {
  // A parallelogram of base 4 and height 7: stripes cover in it what their share of the height is.
  const auto stripes = ZebraShape({{-5.5, -3.5}, {-1.5, -3.5}, {5.5, 3.5}, {1.5, 3.5}});
  ASSERT_EQ(stripes.size(), 7u);
  for (const Polygon2& stripe : stripes) {
    EXPECT_NEAR(AreaOf(stripe), 4.0 * 0.5, 1e-12);
    for (const Vector2d& p : stripe) EXPECT_LE(std::fabs(p.x() - p.y()), 2.0 + 1e-12);
  }
}

TEST(Stencils, ArrowsFillTheirRectangleAndLeftIsRightInAMirror) {
  for (int bits = 1; bits < 8; ++bits) {
    const ArrowWays ways{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0};
    const auto shape = ArrowShape(ways, 5.0, 1.0),
               mirrored = ArrowShape({ways.right, ways.straight, ways.left}, 5.0, 1.0);
    double front = -9.0, back = 9.0, left = -9.0, right = 9.0;
    for (const Polygon2& polygon : shape) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()], &c = polygon[(i + 2) % polygon.size()];
        EXPECT_GT(geometry::Cross(b - a, c - b), 0.0) << bits;  // convex, counter-clockwise
        front = std::max(front, a.x()), back = std::min(back, a.x()), left = std::max(left, a.y()),
        right = std::min(right, a.y());
      }
    }
    EXPECT_NEAR(front, 2.5, 1e-12) << bits;
    EXPECT_NEAR(back, -2.5, 1e-12);
    const bool only_ahead = !ways.left && !ways.right;
    EXPECT_NEAR(left, ways.left || only_ahead ? 0.5 : ways.straight ? 0.225 : 0.075, 1e-12) << bits;
    EXPECT_NEAR(right, ways.right || only_ahead ? -0.5 : ways.straight ? -0.225 : -0.075, 1e-12) << bits;
    EXPECT_NEAR(AreaOf(shape), AreaOf(mirrored), 1e-12);
  }
  EXPECT_EQ(WaysOf("SgRMArrowStraightRight.flt"), (ArrowWays{false, true, true}));
  EXPECT_EQ(WaysOf("arrowLeftRight"), (ArrowWays{true, false, true}));
  EXPECT_FALSE(WaysOf("arrowMergeLeft").any());
  EXPECT_FALSE(WaysOf("Sg306Vorfahrtstrasse02").any());
}

// A level road to the east from (10, 20), a lane of 3.5 m on each side, without any marks of its own.
std::shared_ptr<const road::World> WorldWith(const std::string& more) {
  const std::string width = "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>";
  return OpenDriveWorld(
      fmt::format("<road id=\"1\" length=\"100\" junction=\"-1\"><planView><geometry s=\"0\" x=\"10\" y=\"20\" "
                  "hdg=\"0\" length=\"100\"><line/></geometry></planView>"
                  "<lanes><laneSection s=\"0\"><left><lane id=\"1\" type=\"driving\">{}</lane></left><center><lane "
                  "id=\"0\"/></center>"
                  "<right><lane id=\"-1\" type=\"driving\">{}</lane></right></laneSection></lanes>{}</road>\n",
                  width, width, more));
}

struct Painted {
  double area_m2 = 0.0;
  Vector2d low = Vector2d::Constant(1e9), high = Vector2d::Constant(-1e9), middle = Vector2d::Zero();
};

// All that is painted at a level of detail.
Painted PaintOf(const road::World& world, std::size_t level = 0) {
  const GroundPlan plan(world);
  Painted painted;
  for (const TileKey& key : plan.tiles()) {
    const Mesh marks = plan.Build(key).levels[level].marks;
    for (std::size_t i = 0; i < marks.triangle_count(); ++i) {
      std::array<Vector2d, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = marks.PositionW(marks.triangles[3 * i + k]).head<2>();
        painted.low = painted.low.cwiseMin(p[k]), painted.high = painted.high.cwiseMax(p[k]);
      }
      const double area = 0.5 * geometry::Cross(p[1] - p[0], p[2] - p[0]);
      EXPECT_GT(area, -1e-9);
      painted.area_m2 += area;
      painted.middle += area / 3.0 * (p[0] + p[1] + p[2]);
    }
  }
  if (painted.area_m2 > 0.0) painted.middle /= painted.area_m2;
  return painted;
}

void ExpectBox(const Painted& painted, double west, double south, double east, double north) {
  EXPECT_NEAR(painted.low.x(), west, 1e-3);
  EXPECT_NEAR(painted.low.y(), south, 1e-3);
  EXPECT_NEAR(painted.high.x(), east, 1e-3);
  EXPECT_NEAR(painted.high.y(), north, 1e-3);
}

TEST(RoadPaint, ACrosswalkIsAZebra) {
  const auto world = WorldWith(
      R"(<objects><object id="z" type="crosswalk" s="50" t="0" zOffset="0" length="4" width="7"/></objects>)");
  ASSERT_NE(world, nullptr);
  for (const std::size_t level : {0u, 2u}) {
    const Painted painted = PaintOf(*world, level);
    EXPECT_NEAR(painted.area_m2, 7.0 * 0.5 * 4.0, 1e-2);
    ExpectBox(painted, 58.0, 20.0 - 3.25, 62.0, 20.0 + 3.25);
  }
  EXPECT_TRUE(StaticObjects(*world).tiles().empty());
}

TEST(RoadPaint, AnOutlineTurnedAcrossTheRoadHasStripesAlongItNevertheless) {
  // The object looks to the left; its outline is 7 m along that and 3 m across, with a point in the hull's inside.
  const auto world =
      WorldWith(R"(<objects><object id="z" type="crosswalk" s="50" t="0" zOffset="0" hdg="1.5707963267948966"><outline>
    <cornerLocal u="-3.5" v="-1.5" z="0" height="0"/><cornerLocal u="3.5" v="-1.5" z="0" height="0"/>
      <cornerLocal u="1" v="0" z="0" height="0"/>
    <cornerLocal u="3.5" v="1.5" z="0" height="0"/><cornerLocal u="-3.5" v="1.5" z="0" height="0"/></outline></object>
    <object id="v" type="crosswalk" subtype="virtual" s="20" t="0" zOffset="0" length="4" width="7"/></objects>)");
  ASSERT_NE(world, nullptr);
  const Painted painted = PaintOf(*world);
  EXPECT_NEAR(painted.area_m2, 7.0 * 0.5 * 3.0, 1e-2);
  ExpectBox(painted, 58.5, 20.0 - 3.25, 61.5, 20.0 + 3.25);
}

TEST(RoadPaint, ACrossingThatIsASignalStaysOnItsRoadsLanes) {
  const auto world = WorldWith(
      R"(<signals><signal id="z" s="0" t="0" zOffset="0" orientation="+" dynamic="no" type="1000003" subtype="-1"
          country="OpenDRIVE" value="4" height="0.01" width="10.4"/></signals>)");
  ASSERT_NE(world, nullptr);
  const Painted painted = PaintOf(*world);
  EXPECT_NEAR(painted.area_m2, 7.0 * 0.5 * 4.0, 1e-2);
  ExpectBox(painted, 10.0, 20.0 - 3.25, 14.0, 20.0 + 3.25);
}

TEST(RoadPaint, AParkingPlaceHasItsLines) {
  // 5 m to the north and 2.5 m across, its middle on the left lane: its left side lies to the west; a line round its
  // rear from corner to corner, 2.5 + 5 m, of which 0.5 m at the beginning and 1 m at the end stay bare, in strokes of
  // 1 m and gaps of 0.5 m.
  const auto world = WorldWith(
      R"(<objects><object id="p" type="parkingSpace" s="50" t="0" length="5" width="2.5" height="0"
          hdg="1.5707963267948966">
      <outline><cornerLocal id="0" u="-2.5" v="1.25" height="0"/><cornerLocal id="1" u="-2.5" v="-1.25" height="0"/>
        <cornerLocal id="2" u="2.5" v="-1.25" height="0"/></outline>
      <markings><marking side="left" width="0.2"/><marking width="0.1" lineLength="1" spaceLength="0.5"
        startOffset="0.5" stopOffset="1"><cornerReference id="0"/><cornerReference id="1"/>
      <cornerReference id="2"/></marking></markings></object></objects>)");
  ASSERT_NE(world, nullptr);
  const Painted painted = PaintOf(*world);
  // Strokes begin at 0.5, 2, 3.5, 5 and end a metre later, the last line ends at 6.5: 4 strokes of 1 m.
  EXPECT_NEAR(painted.area_m2, 5.0 * 0.2 + 4.0 * 1.0 * 0.1, 2e-3);
  // West: half the left line's width beyond it. East: half the other's. From the left line's ends, but south half the
  // width of what lies along the rear.
  ExpectBox(painted, 60.0 - 1.25 - 0.1, 20.0 - 2.5 - 0.05, 60.0 + 1.25 + 0.05, 20.0 + 2.5);
  EXPECT_TRUE(StaticObjects(*world).tiles().empty());
}

// A driver who parks sees where: lines of 0.12 m within the edges, of the rectangle or of a slanted outline; a height
// that a file gives it makes no body of it.
TEST(RoadPaint, AParkingPlaceWithoutMarksHasLinesAlongItsEdges) {
  const auto world = WorldWith(
      R"(<objects><object id="p" type="parkingSpace" s="50" t="0" length="5" width="2.5" height="4">
          <material roadMarkColor="yellow"/></object></objects>)");
  ASSERT_NE(world, nullptr);
  const Painted painted = PaintOf(*world);
  EXPECT_NEAR(painted.area_m2, 5.0 * 2.5 - 4.76 * 2.26, 2e-3);
  ExpectBox(painted, 57.5, 18.75, 62.5, 21.25);
  EXPECT_TRUE(StaticObjects(*world).tiles().empty());
  // A rhomboid of base 2.5 and height 5, slanted by 45 degrees: its inner one has the same shape, 0.12 m within each
  // side.
  const auto slanted = WorldWith(
      R"(<objects><object id="p" type="parkingSpace" s="50" t="0"><outlines><outline id="0" closed="true">
          <cornerLocal u="-2.5" v="-2.5" z="0" height="4"/><cornerLocal u="0" v="-2.5" z="0" height="4"/>
      <cornerLocal u="5" v="2.5" z="0" height="4"/><cornerLocal u="2.5" v="2.5" z="0" height="4"/></outline></outlines>
        </object></objects>)");
  const double base = 2.5 - 2.0 * 0.12 * std::sqrt(2.0), height = 5.0 - 0.24;
  EXPECT_NEAR(PaintOf(*slanted).area_m2, 2.5 * 5.0 - base * height, 2e-3);
  EXPECT_TRUE(StaticObjects(*slanted).tiles().empty());
}

// A flat island of 6 x 3 m with a kerb of 0.2 m: grass within the kerb, and both together the whole of it, whichever
// way round its corners run.
TEST(RoadPaint, AFlatIslandHasItsFrameAndItsFilling) {
  for (const bool turned : {false, true}) {
    const std::string a = R"(<cornerRoad s="47" t="-1" dz="0" height="0" id="0"/>)",
                      b = R"(<cornerRoad s="53" t="-1" dz="0" height="0" id="1"/>)",
                      c = R"(<cornerRoad s="53" t="2" dz="0" height="0" id="2"/>)",
                      d = R"(<cornerRoad s="47" t="2" dz="0" height="0" id="3"/>)";
    const auto island = [&](const std::string& fill, const std::string& borders) {
      return WorldWith(
          "<objects><object id=\"i\" type=\"trafficIsland\" s=\"50\" t=\"0\"><outlines><outline id=\"0\" " + fill +
          ">" + (turned ? d + c + b + a : a + b + c + d) + "</outline></outlines>" + borders + "</object></objects>");
    };
    const std::string whole =
        R"(<borders><border outlineId="0" type="curb" width="0.2" useCompleteOutline="true"/></borders>)";
    const Painted both = PaintOf(*island("fillType=\"grass\"", whole)), frame = PaintOf(*island("", whole));
    EXPECT_NEAR(both.area_m2, 18.0, 2e-3) << turned;
    EXPECT_NEAR(frame.area_m2, 18.0 - 5.6 * 2.6, 2e-3) << turned;
    ExpectBox(both, 57.0, 19.0, 63.0, 22.0);
    // From corner 0 to 1 and 2: 6 m and 3 m of 0.2 m, mitred where they meet.
    const Painted part =
        PaintOf(*island("",
                        R"(<borders><border outlineId="0" type="concrete" width="0.2" useCompleteOutline="false">
            <cornerReference id="0"/><cornerReference id="1"/><cornerReference id="2"/></border></borders>)"));
    EXPECT_NEAR(part.area_m2, 9.0 * 0.2 - 0.04, 2e-3) << turned;
    ExpectBox(part, 57.0, 19.0, 63.0, 22.0);
  }
}

TEST(Stencils, AGiveWayLineHasWholeStrokesEvenlyOnBothSides) {
  static_assert(kGiveWayLine_m >= 0.2 && kGiveWayLine_m <= 0.6 && kStopLine_m >= 0.2 && kStopLine_m <= 0.6);
  for (const double width : {0.3, 2.5, 2.1, 3.5, 7.0}) {
    const double count = width < 0.5 ? 1.0 : std::floor((width + 0.3) / 0.8 + 1e-9);
    const auto strokes = GiveWayShape(1.0, 1.0 + width);
    ASSERT_EQ(strokes.size(), static_cast<std::size_t>(count)) << width;
    EXPECT_NEAR(AreaOf(strokes), 0.4 * std::min(width, 0.5) * count, 1e-12);
    EXPECT_NEAR(strokes.front()[0].y() - 1.0, 1.0 + width - strokes.back()[2].y(), 1e-12);
    EXPECT_GE(strokes.front()[0].y(), 1.0 - 1e-12);
    EXPECT_NEAR(AreaOf(StopLineShape(1.0, 1.0 + width)), 0.3 * width, 1e-12);
  }
  EXPECT_TRUE(GiveWayShape(1.0, 1.0).empty());
  EXPECT_TRUE(StopLineShape(1.0, 0.5).empty());
}

TEST(RoadPaint, AGiveWayLineIsStrokesAcrossItsLane) {
  const auto world = WorldWith(
      R"(<signals><signal id="l" s="40" t="0" zOffset="0" orientation="-" dynamic="no" type="341" subtype="-1"
          country="DE" width="3.5"/></signals>)");
  ASSERT_NE(world, nullptr);
  const Painted painted = PaintOf(*world);
  EXPECT_NEAR(painted.area_m2, 4.0 * 0.5 * 0.4, 1e-2);  // four strokes and three gaps are 2.9 m
  ExpectBox(painted, 50.0 - 0.2, 20.0 + 0.3, 50.0 + 0.2, 20.0 + 3.2);
}

TEST(RoadPaint, AStopLineLiesOnTheSideOfItsTraffic) {
  for (const auto& [t, south] : {std::pair(0.0, 20.0), std::pair(1.75, 20.0)}) {  // t at its left end, or in its middle
    const auto world = WorldWith(fmt::format(
        R"(<signals><signal id="l" s="40" t="{}" zOffset="0" orientation="-" dynamic="no" type="294" subtype="-1"
            country="DE" height="0.03" width="3.5"/></signals>)",
        t));
    ASSERT_NE(world, nullptr);
    const Painted painted = PaintOf(*world);
    EXPECT_NEAR(painted.area_m2, kStopLine_m * 3.5, 1e-2);
    ExpectBox(painted, 50.0 - 0.5 * kStopLine_m, south, 50.0 + 0.5 * kStopLine_m, south + 3.5);
  }
}

TEST(RoadPaint, ArrowsPointToTheLeftOfTheirTraffic) {
  const auto world = WorldWith(
      R"(<signals><signal id="a" s="40" t="1.75" zOffset="0" orientation="-" dynamic="no" type="-1" subtype="-1"
          country="OpenDRIVE" name="SgRMArrowLeft.flt" height="0.03" width="0.75"/></signals>)");
  ASSERT_NE(world, nullptr);
  const Painted west = PaintOf(*world);  // against s: to the west, with the south on the left
  ExpectBox(west, 47.5, 21.75 - 0.375, 52.5, 21.75 + 0.075);
  EXPECT_NEAR(west.area_m2, AreaOf(ArrowShape({true, false, false}, 5.0, 0.75)), 5e-3);
  EXPECT_LT(west.middle.y(), 21.75);
  const auto object = WorldWith(
      R"(<objects><object id="a" type="roadMark" subtype="arrowLeft" s="40" t="-1.75" zOffset="0" length="5"
          width="0.75"/></objects>)");
  ASSERT_NE(object, nullptr);
  const Painted east = PaintOf(*object);
  ExpectBox(east, 47.5, 18.25 - 0.075, 52.5, 18.25 + 0.375);
  EXPECT_NEAR(west.middle.x() + east.middle.x(), 100.0, 2e-3);  // one is the other, turned by half a turn
}

// Every crossing, stop line and arrow of a real file lies on lanes that are driven on.
TEST(RoadPaint, OfARealFileLiesOnItsLanes) {
  const auto file = SharedXodr("esmini_multi_intersections");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "needs " << file;
  const auto world = road::World::Load(file);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  const network::Network& network = *world.value()->network();
  int things = 0;
  for (const network::Placed& placed : network::PlaceFurniture(network).things) {
    TilePaint paint;
    PaintThing(network, placed, paint);
    if (paint.empty()) continue;
    ++things;
    for (const auto& [key, pieces] : paint) {
      ASSERT_FALSE(pieces.empty());
      for (const PaintPiece& piece : pieces) {
        const Eigen::Vector3d middle = 0.25 * (piece.p_W[0] + piece.p_W[1] + piece.p_W[2] + piece.p_W[3]);
        const auto place = network.Locate(middle.x(), middle.y(), middle.z());
        ASSERT_TRUE(place.has_value());
        EXPECT_LT(place->distance_m, 0.01) << placed.signal->name;
        const network::Lane* lane = network.Find(place->lane);
        EXPECT_TRUE(lane != nullptr && network::IsDrivable(lane->type)) << placed.signal->name;
      }
    }
  }
  EXPECT_EQ(things, 17 + 17 + 4);  // crossings, stop lines, arrows: counted in the file's text
}

}  // namespace
}  // namespace rodeira::scene
