// SPDX-License-Identifier: Apache-2.0
// World files of version 1, which are converted when they are read, against the formulas of version 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/world/road/road_network.hpp"
#include "tests/common/world/road/sample_world.hpp"
#include "tests/n222.hpp"
#include "tests/version1_road.hpp"

namespace rodeira::road {
namespace {

struct Case {
  std::string name;
  std::string text;
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

Case OfFile(const std::string& name) {
  return {name.substr(0, name.find('.')), config::File::Load(SourceDir() + "/tests/data/" + name).value().text()};
}

// Without marks, shoulders or a verge on one side: the lanes' own edges are the outline.
Case Bare() {
  return {"bare",
          "rodeira: world/1\nname: bare\nground: {kind: plane, z_m: 3, slope_x: 0.1, slope_y: -0.2, surface: soil}\n"
          "roads:\n  - id: r\n    start: {x_m: 4, y_m: -7, heading_deg: 200}\n"
          "    axis:\n      - clothoid: {length_m: 30, radius_end_m: -40}\n      - arc: {length_m: 60, radius_m: -40}\n"
          "    vertical: [{s_m: 10, z_m: 4}, {s_m: 50, z_m: 8, parabola_m: 30}, {s_m: 70, z_m: 5}]\n"
          "    section:\n      lanes: [{id: -1, width_m: 3.1, speed_limit_kmh: 50}]\n      surface: concrete\n"
          "      crossfall: {kind: left, fall: 0.04}\n      verge: {width_m: 0}\n      blend_m: 5\n"};
}

// The sample on a plane.
Case OnPlane() {
  std::string text = kSample;
  const auto from = text.find("terrain:"), to = text.find("start: {road");
  return {"on_plane", text.replace(from, to - from, "ground: {kind: plane, z_m: 95, surface: gravel}\n")};
}

class Version1 : public testing::TestWithParam<Case> {
 protected:
  Version1() : world_(MustParse(GetParam().text)), road_(Version1Road::Parse(GetParam().text)) {}

  // On the road and over its blend, beyond both ends, and anywhere.
  Eigen::Vector2d AnyPoint(std::uint64_t i) const {
    const auto draw = [&](std::uint64_t part, double low, double high) {
      return base::RandomUniform({i, part, 77}, low, high);
    };
    const double far = road_.section().reach_m() + 2.0;
    if (i % 8 < 5) return road_.Position(draw(0, 0.0, road_.length_m()), draw(1, -far, far)).head<2>();
    if (i % 8 < 7) {
      const Eigen::Vector2d end = road_.Evaluate(i % 8 == 5 ? 0.0 : road_.length_m()).p_W.head<2>();
      return end + Eigen::Vector2d(draw(0, -far, far), draw(1, -far, far));
    }
    const Extents e = world_->extents();
    const auto held = [](double value) { return std::clamp(value, -3000.0, 3000.0); };  // planes have no end
    return {draw(0, held(e.west_m) - 30.0, held(e.east_m) + 30.0),
            draw(1, held(e.south_m) - 30.0, held(e.north_m) + 30.0)};
  }

  FrictionTable Friction() const {
    FrictionTable table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = world_->Friction(static_cast<ground::Surface>(i));
    return table;
  }

  // Paint ends, strips meet and triangles of the terrain have sides: within a micrometre of those either side answers.
  bool IsPlain(const Eigen::Vector2d& p, const SurfacePoint& expected) const {
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d q = p + 1e-6 * Eigen::Vector2d(k == 0 ? 1 : k == 1 ? -1 : 0, k == 2 ? 1 : k == 3 ? -1 : 0);
      const SurfacePoint there = road_.GroundAt(q.x(), q.y(), world_->TerrainAt(q.x(), q.y()), Friction());
      if (there.inside != expected.inside || there.surface != expected.surface ||
          std::hypot(there.slope_x - expected.slope_x, there.slope_y - expected.slope_y) > 1e-3)
        return false;
    }
    return true;
  }

  std::shared_ptr<const World> world_;
  Version1Road road_;
};

INSTANTIATE_TEST_SUITE_P(Files, Version1,
                         testing::Values(Case{"sample", kSample}, OnPlane(), Bare(), OfFile("n222_version1.yaml"),
                                         OfFile("straight.yaml")),
                         [](const auto& one) { return one.param.name; });

// Heights to a nanometre, slopes to 1e-9, surface and friction exactly; alone and in batches, whatever the hint.
TEST_P(Version1, AnswersAsItsFormulas) {
  const auto ground = world_->MakeGround();
  const FrictionTable friction = Friction();
  enum Part { kRoad, kMark, kBlend, kTerrain, kOutside };
  std::map<Part, int> seen;
  double worst_m = 0.0, worst_slope = 0.0;
  int edges = 0;
  constexpr std::uint64_t kPoints = 40'000;
  for (std::uint64_t i = 0; i < kPoints; ++i) {
    const Eigen::Vector2d p = AnyPoint(i);
    const SurfacePoint bare = world_->TerrainAt(p.x(), p.y());
    const SurfacePoint expected = road_.GroundAt(p.x(), p.y(), bare, friction);
    const SurfacePoint found = world_->At(p.x(), p.y(), base::RandomUniform({i, 5}, -500.0, 500.0));
    const double outside_m = road_.OutsideVerges(p.x(), p.y());
    const bool painted = expected.surface == ground::Surface::kRoadMark;
    ++seen[!expected.inside                             ? kOutside
           : painted                                    ? kMark
           : outside_m == 0.0                           ? kRoad
           : outside_m < road_.section().spec().blend_m ? kBlend
                                                        : kTerrain];
    if (found.inside && expected.inside) worst_m = std::max(worst_m, std::fabs(found.z_m - expected.z_m));
    if (!IsPlain(p, expected)) {
      ++edges;
      continue;
    }
    ASSERT_EQ(found.inside, expected.inside) << p.transpose();
    ASSERT_EQ(found.surface, expected.surface) << p.transpose();
    ASSERT_EQ(found.friction, expected.friction) << p.transpose();
    if (!expected.inside) continue;
    ASSERT_NEAR(found.z_m, expected.z_m, 1e-9) << p.transpose() << ", " << outside_m << " m outside of the verges";
    const double off = std::hypot(found.slope_x - expected.slope_x, found.slope_y - expected.slope_y);
    worst_slope = std::max(worst_slope, off);
    ASSERT_LT(off, 1e-9) << p.transpose() << ", " << outside_m << " m outside of the verges";
    const ground::GroundPoint said = ground->At(p.x(), p.y());
    ASSERT_EQ(said.z_m, found.z_m) << "with another hint, " << p.transpose();
  }
  EXPECT_LT(worst_m, 1e-9);
  EXPECT_LT(worst_slope, 1e-9);
  EXPECT_LT(edges, static_cast<int>(kPoints / 200));
  EXPECT_GT(seen[kRoad], 3'000);
  EXPECT_GT(seen[kBlend], 3'000);
  EXPECT_GT(seen[kTerrain], 1'000);
  if (!road_.marks().empty()) {
    EXPECT_GT(seen[kMark], 100);
  }
  if (world_->grid() != nullptr) {
    EXPECT_GT(seen[kOutside], 50);
  }
}

// The same over patches, as tyres ask.
TEST_P(Version1, APatchAnswersAsItsFormulas) {
  const FrictionTable friction = Friction();
  for (std::uint64_t i = 0; i < 300; ++i) {
    const Eigen::Vector2d middle = AnyPoint(i);
    const ground::GroundPatch patch{middle.x(), middle.y(), base::RandomUniform({i, 1}, -3.0, 3.0), 0.2, 0.18, 12,
                                    10,         0.0};
    std::vector<ground::GroundPoint> points(patch.size());
    world_->MakeGround()->Patch(patch, points);
    for (int row = 0; row < patch.along; ++row) {
      for (int column = 0; column < patch.across; ++column) {
        const ground::GroundQuery at = ground::PatchPoint(patch, row, column);
        const SurfacePoint expected = road_.GroundAt(at.x_m, at.y_m, world_->TerrainAt(at.x_m, at.y_m), friction);
        const ground::GroundPoint& found = points[static_cast<std::size_t>(row * patch.across + column)];
        if (!IsPlain({at.x_m, at.y_m}, expected)) continue;
        ASSERT_EQ(found.inside, expected.inside);
        ASSERT_EQ(found.surface, expected.surface);
        ASSERT_EQ(found.friction, expected.friction);
        if (expected.inside) {
          ASSERT_NEAR(found.z_m, expected.z_m, 1e-9);
        }
      }
    }
  }
}

// Where the terrain is not known the road is there, and nothing beside it.
TEST(Version1Ground, ARoadOverAVoidAnswersAlone) {
  WorldSpec spec;
  const Version1Road road = Version1Road::Parse(kSample);
  spec.network = AsNetwork("void", "", road.Alone(), spec.friction);
  spec.grid =
      std::make_shared<terrain::ElevationGrid>(terrain::ElevationGrid::Frame{2, 2, -1000.0, -1000.0, 1000.0, 1000.0},
                                               std::vector<float>(4, terrain::ElevationGrid::kVoid));
  const auto world = World::Make(spec);
  const Eigen::Vector3d on = road.Position(100.0, 1.0), beside = road.Position(100.0, 6.0);
  EXPECT_TRUE(world->At(on.x(), on.y()).inside);
  EXPECT_NEAR(world->At(on.x(), on.y()).z_m, on.z(), 1e-9);
  EXPECT_FALSE(world->At(beside.x(), beside.y()).inside);
}

// Nothing else of a version 1 file decides a bit: what is read again answers the same.
TEST_P(Version1, IsReadToTheSameBits) {
  const auto again = MustParse(GetParam().text);
  EXPECT_EQ(again->content_hash(), world_->content_hash());
  for (std::uint64_t i = 0; i < 2'000; ++i) {
    const Eigen::Vector2d p = AnyPoint(i);
    const SurfacePoint a = world_->At(p.x(), p.y()), b = again->At(p.x(), p.y());
    ASSERT_TRUE(a.z_m == b.z_m && a.slope_x == b.slope_x && a.slope_y == b.slope_y && a.surface == b.surface);
  }
}

}  // namespace
}  // namespace rodeira::road
