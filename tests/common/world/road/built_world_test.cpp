// SPDX-License-Identifier: Apache-2.0
// Worlds of version 2: roads, junctions and terrain as one ground.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <limits>

#include "common/core/base/files.hpp"
#include "common/core/base/random.hpp"
#include "common/world/road/built_ground.hpp"
#include "common/world/road/road_chains.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

using testing::HasSubstr;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr const char* kHilly = R"(rodeira: world/2
name: hilly
terrain:
  surface: soil
  generate: {seed: 5, columns: 121, rows: 101, spacing_m: 8, west_m: -120, south_m: -260, below_m: 0.4, flat_m: 6,
    full_m: 40,
    relief: [{wavelength_m: 110, amplitude_m: 14}, {wavelength_m: 40, amplitude_m: 3}]}
roads:
  - id: main
    start: {x_m: 0, y_m: 0, heading_deg: 10}
    axis:
      - line: {length_m: 240}
      - clothoid: {a_m: 90, radius_end_m: -160}
      - arc: {length_m: 240, radius_m: -160}
    vertical: [{s_m: 0, z_m: 30}, {s_m: 260, z_m: 38, parabola_m: 140}, {s_m: 530, z_m: 31}]
    section: {template: rural}
  - id: cross
    place: {road: main, s_m: 140, turn_deg: 100, own_s_m: 110}
    axis: [line: {length_m: 230}]
    section: {template: rural}
  - id: over
    place: {road: main, s_m: 330, turn_deg: 80, own_s_m: 150}
    axis: [line: {length_m: 300}]
    vertical: [{s_m: 0, z_m: 36}, {s_m: 150, z_m: 46, parabola_m: 120}, {s_m: 300, z_m: 36}]
    section: {template: rural}
    bridges: [{from_s_m: 130, to_s_m: 170}]
junctions:
  - {id: j, roads: [{road: main, s_m: 140}, {road: cross, s_m: 110}]}
)";

std::shared_ptr<const World> Hilly() {
  static const auto world = MustParse(kHilly);
  return world;
}

// Whether a bridge lies over the point: beside it one falls off.
bool OnBridge(const World& world, const Eigen::Vector2d& p) {
  std::vector<network::Surfacing> surfaces;
  world.network()->Surfaces(p.x(), p.y(), surfaces);
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const network::Surfacing& surfacing) {
    return IsExempt(world.network()->roads()[surfacing.place.lane.road].spec(), surfacing.place.s_m);
  });
}

struct Step {
  double height_m = 0.0;
  Eigen::Vector2d at_W = Eigen::Vector2d::Zero();
};

// The greatest step between two points: what lies between them is halved as long as more than half a millimetre of
// their difference of height may be a step and no slope or kink, down to a micrometre.
void FindSteps(const World& world, const Eigen::Vector2d& p, const SurfacePoint& at_p, const Eigen::Vector2d& q,
               const SurfacePoint& at_q, Step& greatest) {
  const Eigen::Vector2d way = q - p;
  const double rise_m = at_q.z_m - at_p.z_m;
  const double before_m = at_p.slope_x * way.x() + at_p.slope_y * way.y(),
               behind_m = at_q.slope_x * way.x() + at_q.slope_y * way.y();
  if (std::fabs(rise_m - 0.5 * (before_m + behind_m)) + 0.5 * std::fabs(before_m - behind_m) < 5e-4) return;
  if (way.norm() < 1e-6) {
    if (std::fabs(rise_m) > greatest.height_m) greatest = {std::fabs(rise_m), p};
    return;
  }
  const Eigen::Vector2d middle = p + 0.5 * way;
  const SurfacePoint at = world.At(middle.x(), middle.y(), at_p.z_m);
  FindSteps(world, p, at_p, middle, at, greatest);
  FindSteps(world, middle, at, q, world.At(q.x(), q.y(), at.z_m), greatest);
}

// Whether a lane there stands over its road's surface: at its kerb there is a step.
bool OnKerb(const World& world, const Eigen::Vector2d& p) {
  const auto place = world.network()->Locate(p.x(), p.y());
  const network::Lane* lane = place ? world.network()->Find(place->lane) : nullptr;
  return lane != nullptr && !lane->heights.empty();
}

// The same along a straight walk, each height asked near the one before. Kerbs, and ends of bridges, where one falls
// off, are passed over. Adds to `walked_m` how far the walk lies on the ground.
Step GreatestStep(const World& world, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double every_m,
                  double hint_m, double& walked_m) {
  Step greatest;
  const int pieces = static_cast<int>(std::ceil((to - from).norm() / every_m));
  Eigen::Vector2d p = from;
  SurfacePoint at_p = world.At(p.x(), p.y(), hint_m);
  for (int k = 1; k <= pieces && at_p.inside; ++k) {
    const Eigen::Vector2d q = from + (to - from) * k / pieces;
    const SurfacePoint at_q = world.At(q.x(), q.y(), at_p.z_m);
    if (!at_q.inside) break;
    Step step = greatest;
    FindSteps(world, p, at_p, q, at_q, step);
    if (step.height_m > greatest.height_m && !OnBridge(world, p) && !OnBridge(world, q) && !OnKerb(world, p) &&
        !OnKerb(world, q))
      greatest = step;
    walked_m += (q - p).norm();
    p = q;
    at_p = at_q;
  }
  return greatest;
}

// Along random straight lines over everything there is no step of a millimetre: not at verges, junctions, seams between
// roads, nor where slopes meet the terrain.
TEST(BuiltWorld, TheGroundHasNoSteps) {
  const World& world = *Hilly();
  Step greatest;
  double walked_m = 0.0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    const Eigen::Vector2d from(base::RandomUniform({i, 1}, -40.0, 520.0), base::RandomUniform({i, 2}, -160.0, 300.0));
    const double angle = base::RandomUniform({i, 3}, 0.0, 6.28);
    const Step step = GreatestStep(world, from, from + 60.0 * Eigen::Vector2d(std::cos(angle), std::sin(angle)), 0.02,
                                   i % 2 == 0 ? -1e9 : 1e9, walked_m);
    if (step.height_m > greatest.height_m) greatest = step;
  }
  EXPECT_GT(walked_m, 20'000.0) << "of 24 km";
  EXPECT_LE(greatest.height_m, 1e-3) << "at " << greatest.at_W.transpose();
}

// Just inside and outside of every edge of every road the heights agree.
TEST(BuiltWorld, RoadAndGroundMeetAtEveryEdge) {
  const World& world = *Hilly();
  const network::Network& network = *world.network();
  int edges = 0;
  for (const network::Road& road : network.roads()) {
    if (!road.spec().junction.empty()) continue;
    const network::LaneSection& section = road.spec().sections[0];
    for (double s = 0.05; s < road.length_m(); s += 0.731) {
      if (IsExempt(road.spec(), s)) continue;
      for (const int lane : {static_cast<int>(section.left.size()), -static_cast<int>(section.right.size())}) {
        const double t = section.Span(lane, road.CentreAt(s), s)->outer_t_m;
        const Eigen::Vector3d in = road.Surface(s, t - std::copysign(1e-7, t)).p_W;
        const geometry::PlanPoint axis = road.axis().Evaluate(s);
        const Eigen::Vector2d out = axis.p_W + (t + std::copysign(1e-7, t)) * axis.left_W();
        ++edges;
        EXPECT_NEAR(world.At(out.x(), out.y(), in.z()).z_m, in.z(), 1e-6) << road.id() << " " << s << " " << t;
      }
    }
  }
  EXPECT_GT(edges, 1000);
}

TEST(BuiltWorld, JunctionsConformToGroundAndRoads) {
  const World& world = *Hilly();
  const network::Junction& junction = world.network()->junctions()[0];
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : junction.outline_W)
    middle += corner / static_cast<double>(junction.outline_W.size());
  ASSERT_GE(junction.outline_W.size(), 3U);
  for (std::size_t i = 0; i < junction.outline_W.size(); ++i) {
    const Eigen::Vector2d a = junction.outline_W[i], b = junction.outline_W[(i + 1) % junction.outline_W.size()];
    const Eigen::Vector2d along = (b - a).normalized(), out(along.y(), -along.x());
    for (double q = 0.05; q < 1.0; q += 0.15) {
      const Eigen::Vector2d p = a + q * (b - a), inside = p - 1e-7 * out, outside = p + 1e-7 * out;
      const double z = world.At(inside.x(), inside.y()).z_m;
      EXPECT_NEAR(world.At(outside.x(), outside.y(), z).z_m, z, 1e-5) << i << " " << q;
    }
  }
}

// Slopes are the derivatives of the heights nearly everywhere.
TEST(BuiltWorld, SlopesAreTheDerivatives) {
  const World& world = *Hilly();
  const double h = 1e-5;
  int wrong = 0, asked = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    const double x = base::RandomUniform({i, 1}, -60.0, 560.0), y = base::RandomUniform({i, 2}, -170.0, 330.0);
    const SurfacePoint at = world.At(x, y);
    if (!at.inside) continue;
    ++asked;
    const auto z = [&](double dx, double dy) { return world.At(x + dx, y + dy, at.z_m).z_m; };
    const double dx = (z(h, 0) - z(-h, 0)) / (2.0 * h), dy = (z(0, h) - z(0, -h)) / (2.0 * h);
    if (std::fabs(dx - at.slope_x) + std::fabs(dy - at.slope_y) > 0.02) ++wrong;
  }
  EXPECT_GT(asked, 15'000);
  EXPECT_LT(wrong, asked / 100);  // on edges of triangles and of lanes, where slopes jump
}

// Cuts and fills keep their slopes, and where they would go beyond the terrain it is the terrain. Near the crossings
// one road's cut meets another's fill, and edges turn round corners: there it is asked only elsewhere that nothing is a
// step.
TEST(BuiltWorld, CutsAndFillsAreNoSteeperThanSaid) {
  const World& world = *Hilly();
  int shaped = 0, untouched = 0;
  const auto [road, s] = ChainsOf(*world.network())[0].At(*world.network(), 330.0);  // under the bridge
  const Eigen::Vector2d bridge = road->Surface(s, 0.0).p_W.head<2>();
  for (std::uint64_t i = 0; i < 400'000; ++i) {
    const double x = base::RandomUniform({i, 1}, -60.0, 560.0), y = base::RandomUniform({i, 2}, -170.0, 330.0);
    const auto place = world.network()->Locate(x, y);
    if (!place || place->distance_m <= 0.0 || place->distance_m > 45.0) continue;
    if ((Eigen::Vector2d(x, y) - bridge).norm() < 17.0)
      continue;  // under it and at its ends, where what two roads want does not agree
    const SurfacePoint at = world.At(x, y, -1e9), terrain = world.TerrainAt(x, y);
    if (!at.inside) continue;
    if (at.z_m == terrain.z_m) {
      ++untouched;
      continue;
    }
    ++shaped;
    const double slope = std::hypot(at.slope_x, at.slope_y);
    const double most = at.z_m < terrain.z_m ? std::hypot(1.0 / 1.5, 0.1) : std::hypot(0.5, 0.1);
    EXPECT_LE(slope, most) << x << " " << y;
  }
  EXPECT_GT(shaped, 1000);
  EXPECT_GT(untouched, 1000);
}

TEST(BuiltWorld, UnderABridgeThereIsARoadAndAboveItAnother) {
  const World& world = *Hilly();
  const RoadChain chain = ChainsOf(*world.network())[0];
  const auto [road, s] = chain.At(*world.network(), 330.0);
  const Eigen::Vector3d low = road->Surface(s, 0.0).p_W;
  const auto ground = world.MakeGround();
  const auto layers = ground->Layers(low.x(), low.y());
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_NEAR(layers[1].z_m, low.z(), 1e-9);
  EXPECT_NEAR(layers[0].z_m, 46.0 - (10.0 / 150.0 * 2.0) * 120.0 / 8.0, 0.01);  // the crest of a parabola
  EXPECT_EQ(ground->At(low.x(), low.y(), low.z()).z_m, layers[1].z_m);
  EXPECT_EQ(ground->At(low.x(), low.y(), layers[0].z_m).z_m, layers[0].z_m);
}

// On the road, at its edges, in the junction, under and on the bridge, beside; with hints and without, on a ground that
// was asked before.
TEST(BuiltWorld, APatchIsItsPointsBitByBit) {
  const World& world = *Hilly();
  const RoadChain chain = ChainsOf(*world.network())[0];
  const auto asked = world.MakeGround(), fresh = world.MakeGround();
  for (std::uint64_t i = 0; i < 60; ++i) {
    const double place = i % 3 == 0   ? base::RandomUniform({i, 0}, 125.0, 155.0)
                         : i % 3 == 1 ? base::RandomUniform({i, 0}, 322.0, 338.0)
                                      : base::RandomUniform({i, 0}, 1.0, 480.0);
    const auto [road, s] = chain.At(*world.network(), place);
    const Eigen::Vector3d p = road->Surface(s, base::RandomUniform({i, 1}, -9.0, 9.0)).p_W;
    const ground::GroundPatch patch{p.x(), p.y(), base::RandomUniform({i, 2}, -3.0, 3.0), i % 5 == 0 ? 6.0 : 0.2, 0.18,
                                    11,    9,     i % 2 == 0 ? kNone : p.z() + 0.1};
    std::vector<ground::GroundPoint> points(patch.size());
    asked->Patch(patch, points);
    for (std::size_t k = points.size(); k-- > 0;) {  // backward
      const ground::GroundQuery query =
          ground::PatchPoint(patch, static_cast<int>(k) / patch.across, static_cast<int>(k) % patch.across);
      const ground::GroundPoint alone = fresh->At(query.x_m, query.y_m, query.z_hint_m);
      ASSERT_EQ(points[k].inside, alone.inside);
      EXPECT_TRUE(points[k].z_m == alone.z_m && points[k].normal_W == alone.normal_W &&
                  points[k].friction == alone.friction && points[k].surface == alone.surface)
          << "patch " << i << " point " << k;
    }
  }
}

// What is asked together is to the bit what each point is told alone, on lines, arcs and clothoids, over lanes, crown,
// paint and seams; and most tyres' patches are asked together.
TEST(BuiltWorld, PointsTogetherArePointsAlone) {
  const auto world = MustParse(R"(rodeira: world/2
name: bends
ground: {kind: plane}
roads:
  - id: a
    start: {x_m: 3000000, y_m: -20, heading_deg: 20}
    axis: [line: {length_m: 120}, clothoid: {a_m: 90, radius_end_m: 90}, arc: {length_m: 200, radius_m: 90},
      clothoid: {a_m: 120, radius_start_m: 90, radius_end_m: -400}]
    vertical: [{s_m: 0, z_m: 30}, {s_m: 200, z_m: 38, parabola_m: 140}, {s_m: 400, z_m: 31}]
    section:
      lanes: [{id: -1, widths: [{s_m: 0, width_m: 3.5}, {s_m: 90, width_m: 3.5}, {s_m: 120, width_m: 4.5}]}, {id: 1,
        width_m: 3.5}, {id: 2, width_m: 2, material: gravel}]
      crossfall: {kind: crown, fall: 0.025}
    lines: [{ts: [{s_m: 0, t_m: 0.5}], kind: dashed, stroke_m: 3, gap_m: 5}]
)");
  ASSERT_NE(world, nullptr);
  const std::shared_ptr<const network::Network> network(world, world->network());
  const BuiltGround built(network, {}, kUsualFriction, SurfaceDetail(),
                          {nullptr, world->plane(), ground::Surface::kGrass, 0.5});
  const auto ground = world->MakeGround();
  const network::Road& road = network->roads()[0];
  const auto same = [](double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
  };
  int together = 0, painted = 0;
  constexpr int kPatches = 400;
  for (std::uint64_t i = 0; i < kPatches; ++i) {
    const double s = base::RandomUniform({i, 0}, 0.5, road.length_m() - 0.5);
    const Eigen::Vector3d p = road.Surface(s, base::RandomUniform({i, 1}, -4.0, 5.0)).p_W;
    const ground::GroundPatch patch{
        p.x(), p.y(), base::RandomUniform({i, 2}, -3.0, 3.0), 0.2, 0.18, 14, 14, i % 2 == 0 ? kNone : p.z()};
    std::vector<ground::GroundQuery> queries;
    for (int k = 0; k < 196; ++k) queries.push_back(ground::PatchPoint(patch, k / 14, k % 14));
    std::vector<ground::GroundPoint> points(queries.size());
    if (!built.QueryBatch(queries, points)) continue;
    ++together;
    for (std::size_t k = 0; k < queries.size(); ++k) {
      const ground::GroundPoint alone = ground->At(queries[k].x_m, queries[k].y_m, queries[k].z_hint_m);
      painted += alone.surface == ground::Surface::kRoadMark;
      ASSERT_TRUE(alone.inside && points[k].inside);
      ASSERT_TRUE(same(points[k].z_m, alone.z_m) && same(points[k].normal_W.x(), alone.normal_W.x()) &&
                  same(points[k].normal_W.y(), alone.normal_W.y()) &&
                  same(points[k].normal_W.z(), alone.normal_W.z()) && same(points[k].friction, alone.friction) &&
                  points[k].surface == alone.surface)
          << "patch " << i << " point " << k << " s " << s;
    }
  }
  EXPECT_GT(together, kPatches * 3 / 4);
  EXPECT_GT(painted, 100);
}

TEST(BuiltWorld, RoughnessStandsOnTheRoadAndFadesAtItsEnds) {
  const std::string text =
      "rodeira: world/2\nname: r\nground: {kind: plane, surface: asphalt}\nroads:\n  - id: a\n    axis: [line: "
      "{length_m: 400}]\n"
      "    section: {template: rural, crossfall: {kind: crown, fall: 0}, verge: {width_m: 0}}\n";
  const auto even = MustParse(text),
             uneven = MustParse(text + "    surfaces: [{iso_8608: C, seed: 3, from_s_m: 100, to_s_m: 300}]\n");
  EXPECT_NE(even->content_hash(), uneven->content_hash());
  const surface::Roughness oracle({256e-6, 3});
  for (double s = 101.5; s < 298.0; s += 7.3) {
    EXPECT_NEAR(uneven->At(s, 1.2).z_m - even->At(s, 1.2).z_m, oracle.At(s, 1.2).z_m, 1e-12);
    EXPECT_NEAR(uneven->At(s, 1.2).slope_x, oracle.At(s, 1.2).dz_ds, 1e-12);
    EXPECT_NEAR(uneven->At(s, 1.2).slope_y, oracle.At(s, 1.2).dz_dt, 1e-12);
  }
  EXPECT_EQ(uneven->At(99.0, 0.0).z_m, 0.0);
  EXPECT_LT(std::fabs(uneven->At(100.001, 0.0).z_m), 1e-6);
}

TEST(BuiltWorld, IncludedFilesAreReadAndTheirMistakesToldWithTheirPlaces) {
  const auto folder = std::filesystem::temp_directory_path() / ("rodeira-include-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, std::string_view text) {
    ASSERT_TRUE(base::WriteWhole(folder / name, text).ok());
  };
  write("w.yaml",
        "rodeira: world/2\nname: w\nground: {kind: plane}\ninclude: [roads.yaml]\ntemplates:\n  wide: {lanes: [{id: "
        "-1, width_m: 5}]}\n");
  write("roads.yaml",
        "rodeira: world/2\nroads:\n  - {id: a, axis: [line: {length_m: 50}], section: {template: wide}}\n");
  const auto world = World::Load(folder / "w.yaml");
  ASSERT_TRUE(world.ok()) << world.error().Text();
  EXPECT_EQ(world.value()->network()->roads()[0].id(), "a");
  write("roads.yaml",
        "rodeira: world/2\nroads:\n  - {id: a, axis: [line: {lenth_m: 50}], section: {template: wide}}\n");
  EXPECT_THAT(WorldProblems(folder / "w.yaml").front().Text(), HasSubstr("roads.yaml:3: unknown key"));
  std::filesystem::remove_all(folder);
}

class JunctionsOfTheProject : public testing::TestWithParam<const char*> {};

// Over every junction, its mouths and what lies around it, on random straight walks.
TEST_P(JunctionsOfTheProject, HaveNoSteps) {
  const auto loaded = World::Load(std::filesystem::path(SourceDir()) / "configs/worlds" / GetParam());
  ASSERT_TRUE(loaded.ok()) << loaded.error().Text();
  const World& world = *loaded.value();
  EXPECT_FALSE(world.network()->junctions().empty());
  double worst_m = 0.0;
  for (const network::Junction& junction : world.network()->junctions()) {
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner : junction.outline_W)
      middle += corner / static_cast<double>(junction.outline_W.size());
    double reach_m = 0.0;
    for (const Eigen::Vector2d& corner : junction.outline_W) reach_m = std::max(reach_m, (corner - middle).norm());
    ASSERT_GT(reach_m, 3.0);
    Step greatest;
    double walked_m = 0.0;
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto at_random = [&](std::uint64_t what) {
        const double angle = base::RandomUniform({i, what}, 0.0, 2.0 * M_PI),
                     far_m = (reach_m + 5.0) * std::sqrt(base::RandomUniform({i, what + 1}, 0.0, 1.0));
        return Eigen::Vector2d(middle + far_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
      };
      const Step step = GreatestStep(world, at_random(1), at_random(3), 0.02, kNone, walked_m);
      if (step.height_m > greatest.height_m) greatest = step;
    }
    EXPECT_GT(walked_m, 100.0 * reach_m) << junction.id << ": 200 walks of some " << reach_m << " m";
    EXPECT_LE(greatest.height_m, 1e-3) << junction.id << " at " << greatest.at_W.transpose();
    worst_m = std::max(worst_m, greatest.height_m);
  }
  std::printf("%s: %zu junctions, greatest step %.6f m\n", GetParam(), world.network()->junctions().size(), worst_m);
}

INSTANTIATE_TEST_SUITE_P(All, JunctionsOfTheProject, testing::Values("haste.yaml", "example/world.yaml", "lights.yaml"),
                         [](const auto& file) {
                           return std::string(file.param).substr(0, std::string(file.param).find_first_of("./"));
                         });

}  // namespace
}  // namespace rodeira::road
