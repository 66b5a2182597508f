// SPDX-License-Identifier: Apache-2.0
// Worlds that are OpenDRIVE files: SUELO on them, their start, their plan.
#include "common/world/road/network_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <fstream>

#include "common/core/base/random.hpp"
#include "common/world/road/network_ground.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_plot.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/common/world/opendrive/sample.hpp"

namespace rodeira::road {
namespace {

using opendrive::Document;
using opendrive::RoadText;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

class NetworkWorld : public testing::Test {
 protected:
  NetworkWorld() { std::filesystem::create_directories(folder_); }
  ~NetworkWorld() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path Put(const std::string& text) const {
    std::ofstream(folder_ / "town.XODR", std::ios::binary | std::ios::trunc) << text;
    return folder_ / "town.XODR";
  }
  std::shared_ptr<const World> MustLoad(const std::string& text) const {
    auto world = World::Load(Put(text));
    EXPECT_TRUE(world.ok()) << world.error().Text();
    return world.ok() ? world.value() : nullptr;
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("rodeira-network-world-" + std::to_string(::getpid()));
};

// A road that climbs by 1 in 10 and leans by 0.05, and one 6 m above it that crosses.
std::string TwoLevels() {
  RoadText below, above;
  below.elevation = R"(<elevation s="0" a="0" b="0.1" c="0" d="0"/>)";
  below.lateral = R"(<superelevation s="0" a="0.05" b="0" c="0" d="0"/>)";
  below.right =
      R"(<lane id="-1" type="driving"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          <material sOffset="60" surface="ice" friction="0.15"/></lane>
                   <lane id="-2" type="sidewalk"><width sOffset="0" a="2" b="0" c="0" d="0"/></lane>)";
  above.id = "2";
  above.geometry = R"(<geometry s="0" x="50" y="-50" hdg="1.5707963267948966" length="100"><line/></geometry>)";
  above.elevation = R"(<elevation s="0" a="11" b="0" c="0" d="0"/>)";
  return Document(below.Text() + above.Text());
}

TEST_F(NetworkWorld, SueloIsThePlaneOfALeaningRoad) {
  const auto world = MustLoad(TwoLevels());
  auto ground = world->MakeGround();
  // The plane through the axis (1, 0, 0.1) with a section that leans by 0.05 about it.
  const double c = 1.0 / std::sqrt(1.01);
  const Eigen::Vector3d along(c, 0.0, 0.1 * c), up(-0.1 * c, 0.0, c);
  const Eigen::Vector3d normal = std::cos(0.05) * up - std::sin(0.05) * Eigen::Vector3d::UnitY();
  for (std::uint64_t i = 0; i < 500; ++i) {
    const double x = base::RandomUniform({i, 1}, 1.0, 40.0), y = base::RandomUniform({i, 2}, -5.4, 3.4);
    const ground::GroundPoint at = ground->At(x, y);
    ASSERT_TRUE(at.inside);
    EXPECT_NEAR(at.z_m, -(normal.x() * x + normal.y() * y) / normal.z(), 1e-10);
    EXPECT_NEAR((at.normal_W - normal).norm(), 0.0, 1e-10);
    EXPECT_EQ(at.surface, y < -3.5 ? ground::Surface::kConcrete : ground::Surface::kAsphalt);
  }
  EXPECT_EQ(ground->At(70.0, -1.0).friction, 0.15);
  EXPECT_EQ(ground->At(70.0, 1.0).friction, 1.0);
}

TEST_F(NetworkWorld, TheHintChoosesTheLevelAndNothingElse) {
  const auto world = MustLoad(TwoLevels());
  auto ground = world->MakeGround();
  const auto low = ground->At(50.0, 0.0, 5.2), top = ground->At(50.0, 0.0);
  EXPECT_NEAR(low.z_m, 5.0, 1e-12);
  EXPECT_NEAR(top.z_m, 11.0, 1e-12);
  EXPECT_EQ(ground->At(50.0, 0.0, 10.6).z_m, top.z_m);
  EXPECT_EQ(ground->At(50.0, 0.0, 10.4).z_m, low.z_m);
  EXPECT_EQ(ground->At(50.0, 0.0, -30.0).z_m, low.z_m);  // all are above: the lowest
  for (const double hint : {4.9, 5.0, 6.0, 8.0}) {
    const auto at = ground->At(50.0, 0.3, hint);
    EXPECT_EQ(at.z_m, ground->At(50.0, 0.3, 5.1).z_m);
    EXPECT_EQ(at.normal_W, ground->At(50.0, 0.3, 5.1).normal_W);
  }
}

TEST_F(NetworkWorld, TheVergeGoesOnFromTheRoadsEdge) {
  RoadText road;
  road.geometry = R"(<geometry s="0" x="0" y="0" hdg="0" length="100"><arc curvature="0.01"/></geometry>)";
  road.elevation = R"(<elevation s="0" a="3" b="0.05" c="0" d="0"/>)";
  const auto world = MustLoad(Document(road.Text()));
  auto ground = world->MakeGround();
  for (std::uint64_t i = 0; i < 300; ++i) {  // a circle of 100 m about (0, 100)
    const double angle = base::RandomUniform({i, 1}, 0.08, 0.92),
                 t = (i % 2 == 0 ? 1.0 : -1.0) * base::RandomUniform({i, 2}, 3.51, 40.0);
    const double x = (100.0 - t) * std::sin(angle), y = 100.0 - (100.0 - t) * std::cos(angle);
    const auto at = ground->At(x, y);
    EXPECT_NEAR(at.z_m, 3.0 + 5.0 * angle, 1e-9);
    const double slope = 5.0 / (100.0 - t);  // metres up a radian over metres along a radian
    EXPECT_NEAR(
        (at.normal_W - Eigen::Vector3d(-slope * std::cos(angle), -slope * std::sin(angle), 1.0).normalized()).norm(),
        0.0, 1e-9);
    EXPECT_EQ(at.surface, ground::Surface::kGrass);
  }
  // Near the road's ends the tightest bound on one side lies past the end: g² d / 2, 0.05² 40 / 2 = 5 cm and a little
  // more within the bend, is the most that is missing.
  for (std::uint64_t i = 0; i < 300; ++i) {
    const double angle = base::RandomUniform({i, 3}, 0.0, 0.08) + (i % 2 == 0 ? 0.0 : 0.92),
                 t = (i % 4 < 2 ? 1.0 : -1.0) * base::RandomUniform({i, 4}, 3.51, 40.0);
    EXPECT_NEAR(ground->At((100.0 - t) * std::sin(angle), 100.0 - (100.0 - t) * std::cos(angle)).z_m, 3.0 + 5.0 * angle,
                0.06);
  }
  EXPECT_FALSE(ground->At(0.0, -3.6 - kVerge_m).inside);
  EXPECT_TRUE(ground->At(0.0, -3.4 - kVerge_m).inside);
  EXPECT_FALSE(ground->At(kNan, 0.0).inside);
}

// Patches on roads, over their edges, in junctions, under and on bridges, with hints at, above and below the road: to
// the bit their points.
void ExpectPatchesAreTheirPoints(const World& world, std::uint64_t patches) {
  const auto ground = world.MakeGround(), fresh = world.MakeGround();
  const network::Network& network = *world.network();
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  for (std::uint64_t i = 0; i < patches; ++i) {
    const network::Road& road = network.roads()[base::RandomBits({i, 1}) % network.roads().size()];
    const double s = base::RandomUniform({i, 2}, 0.0, road.length_m());
    const Eigen::Vector3d p = road.Surface(s, base::RandomUniform({i, 3}, -5.0, 5.0)).p_W;
    const double hint = i % 3 == 0 ? kNan : i % 3 == 1 ? p.z() : p.z() - 3.0;
    const ground::GroundPatch patch{p.x(), p.y(), base::RandomUniform({i, 4}, -3.0, 3.0), 0.2, 0.18, 9, 7, hint};
    std::vector<ground::GroundPoint> points(patch.size());
    ground->Patch(patch, points);
    for (int k = 0; k < 63; ++k) {
      const ground::GroundQuery query = ground::PatchPoint(patch, k / 7, k % 7);
      const ground::GroundPoint alone = fresh->At(query.x_m, query.y_m, query.z_hint_m),
                                &at = points[static_cast<std::size_t>(k)];
      ASSERT_TRUE(same(at.z_m, alone.z_m) && same(at.normal_W.x(), alone.normal_W.x()) &&
                  same(at.normal_W.y(), alone.normal_W.y()) && same(at.normal_W.z(), alone.normal_W.z()) &&
                  same(at.friction, alone.friction) && at.surface == alone.surface && at.inside == alone.inside)
          << "road " << road.id() << " s " << s << " patch " << i << " point " << k;
    }
  }
}

TEST_F(NetworkWorld, APatchIsItsPointsBitByBit) {
  ExpectPatchesAreTheirPoints(*MustLoad(TwoLevels()), 300);
  // What is asked together agrees with no hint above the road, and says nothing where the hint lies below it.
  const auto flat = MustLoad(Document(RoadText().Text()));
  const LaneGrounds grounds(*flat->network(), kUsualFriction);
  std::vector<ground::GroundQuery> queries(20, {40.0, 1.5, 0.2});
  std::vector<ground::GroundPoint> points(queries.size());
  EXPECT_TRUE(NetworkGroundTogether(*flat->network(), grounds, kUsualFriction, nullptr, nullptr, queries, points));
  queries[7].z_hint_m = -0.6;
  EXPECT_FALSE(NetworkGroundTogether(*flat->network(), grounds, kUsualFriction, nullptr, nullptr, queries, points));
}

TEST_F(NetworkWorld, APatchIsItsPointsOnRealFiles) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto world = World::Load(file);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    ExpectPatchesAreTheirPoints(*world.value(), 200);
    if (HasFatalFailure()) FAIL() << file;
  }
}

TEST_F(NetworkWorld, StartsOnTheLongestLaneInItsDirection) {
  RoadText road;
  road.right = R"(<lane id="-1" type="sidewalk"><width sOffset="0" a="2" b="0" c="0" d="0"/></lane>)";
  const auto world = MustLoad(Document(road.Text()));
  EXPECT_NEAR(world->start().x_m, 90.0, 1e-12);  // the left lane runs against s
  EXPECT_NEAR(world->start().y_m, 1.75, 1e-12);
  EXPECT_NEAR(std::fabs(world->start().heading_rad), 3.14159265358979, 1e-12);
  EXPECT_EQ(world->start().road, -1);
}

// UTM zone 29: x = 500 000 m lies on its meridian, 9 degrees west. Turned by a right angle, what lies ahead in the file
// lies north of there.
TEST_F(NetworkWorld, AHeadersOffsetMovesItOnTheEarth) {
  std::string text = Document(RoadText().Text());
  text.replace(text.find("revMinor=\"8\"/>"), 14,
               "revMinor=\"8\"><geoReference>+proj=utm +zone=29 +datum=WGS84</geoReference><offset x=\"500000\" "
               "y=\"4553000\" z=\"0\" hdg=\"1.5707963267948966\"/></header>");
  const auto world = MustLoad(text);
  const std::string ahead = DescribePoint(*world, 100.0, 0.0), aside = DescribePoint(*world, 100.0, -3.0);
  EXPECT_THAT(ahead, HasSubstr("longitude_deg: -9.000000000\n"));
  const auto number = [](const std::string& said, const std::string& key) {
    return std::stod(said.substr(said.find(key) + key.size()));
  };
  // A degree of latitude has 111.05 km at 41 degrees (WGS 84), the map's scale is 0.9996.
  const double north = number(ahead, "latitude_deg: "),
               at_origin = number(DescribePoint(*world, 0.0, 0.0), "latitude_deg: ");
  EXPECT_NEAR((north - at_origin) * 111050.0 * 0.9996, 100.0, 0.1);
  EXPECT_GT(number(aside, "longitude_deg: "), -9.0);  // to the right: east
  const auto back = PlaceOnMap(*world, -9.0, north);
  ASSERT_TRUE(back.ok()) << back.error().Text();
  EXPECT_NEAR((back.value() - Eigen::Vector2d(100.0, 0.0)).norm(), 0.0, 1e-3);  // nine digits of a degree
}

// A file with a geoReference that PROJ does not know still loads, as nothing that drives needs it.
TEST_F(NetworkWorld, AGeoReferenceThatIsNoneIsToldByTheCheck) {
  const auto with = [](const std::string& earth) {
    std::string text = Document(RoadText().Text());
    return text.replace(text.find("revMinor=\"8\"/>"), 14,
                        "revMinor=\"8\"><geoReference>" + earth + "</geoReference></header>");
  };
  const auto wrong = Put(with("+proj=nonsense +lat_0=4"));
  EXPECT_TRUE(World::Load(wrong).ok());
  EXPECT_THAT(CheckNetwork(wrong, false).warnings,
              testing::ElementsAre(
                  HasSubstr("geoReference: '+proj=nonsense +lat_0=4' is no coordinate system that PROJ knows")));
  EXPECT_THAT(CheckNetwork(Put(with("+proj=utm +zone=29 +datum=WGS84")), false).warnings, testing::IsEmpty());
}

TEST_F(NetworkWorld, IsDescribedCheckedAndDrawn) {
  const auto path = Put(TwoLevels());
  const auto world = World::Load(path).value();
  EXPECT_THAT(DescribeWorld(*world), HasSubstr("network: 2 roads, 200.000 m, 0 junctions"));
  EXPECT_THAT(DescribePoint(*world, 30.0, 1.0, 3.0), HasSubstr("road: 1\n"));
  EXPECT_THAT(DescribePoint(*world, 30.0, 1.0, 3.0), HasSubstr("lane: 1 (driving)\n"));
  const std::string svg = PlotWorld(*world);
  EXPECT_THAT(svg, testing::StartsWith("<svg"));
  EXPECT_THAT(svg, HasSubstr("2 roads, 0 junctions"));
  const NetworkCheck check = CheckNetwork(path, true);
  EXPECT_TRUE(check.errors.empty() && check.warnings.empty());
  EXPECT_THAT(check.table, HasSubstr("roads: 2, 200.000 m"));
  EXPECT_NE(world->content_hash(), MustLoad(TwoLevels() + " ")->content_hash());
  RoadText broken;
  broken.length = 70.0;  // its elements have 100 m, which count
  EXPECT_EQ(MustLoad(Document(broken.Text()))->network()->roads()[0].length_m(), 100.0);
  broken.geometry = R"(<geometry s="0" x="1e12" y="0" hdg="0" length="70"><line/></geometry>)";
  EXPECT_THAT(World::Load(Put(Document(broken.Text()))).error().Text(),
              HasSubstr("town.XODR:6: road.geometry.position: road 1, s 0"));
}

// On every real file: where a lane is, SUELO is the lane's surface, whatever the batch.
TEST_F(NetworkWorld, SueloOnRealFiles) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto world = World::Load(file);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    const network::Network& network = *world.value()->network();
    auto ground = world.value()->MakeGround();
    const auto lanes = network.Lanes();
    std::vector<ground::GroundQuery> queries;
    for (std::uint64_t i = 0; i < 500; ++i) {
      const network::LaneKey key = lanes[base::RandomBits({i}) % lanes.size()];
      const network::LaneSection& section = network.Section(key);
      const Eigen::Vector3d p = network.Centre(key, base::RandomUniform({i, 1}, section.s_m, section.end_s_m));
      const ground::GroundPoint at = ground->At(p.x(), p.y(), p.z());
      EXPECT_TRUE(at.inside);
      // Where roads lie over one another they are one ground, and what is not drivable gives way; kerbs step.
      const double below_m = network::IsDrivable(network.Find(key)->type) ? 0.2 : 1.0;
      EXPECT_GE(at.z_m, p.z() - below_m) << file.filename() << " road " << network.roads()[key.road].id() << " lane "
                                         << key.lane;
      EXPECT_LE(at.z_m, p.z() + 0.5 + 1e-9);
      queries.push_back({p.x(), p.y(), p.z()});
    }
    std::vector<ground::GroundPoint> points(queries.size());
    ground->Query(queries, points);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const ground::GroundPoint alone = ground->At(queries[i].x_m, queries[i].y_m, queries[i].z_hint_m);
      EXPECT_TRUE(points[i].z_m == alone.z_m && points[i].normal_W == alone.normal_W &&
                  points[i].friction == alone.friction);
    }
  }
}

}  // namespace
}  // namespace rodeira::road
