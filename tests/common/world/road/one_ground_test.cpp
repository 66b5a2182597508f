// SPDX-License-Identifier: Apache-2.0
// SUELO where roads of an OpenDRIVE file lie over one another: one ground, without steps, named by the lane that
// Network::Locate names.
#include "common/world/road/one_ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/core/base/random.hpp"
#include "common/world/road/network_ground.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/launch/rodeira/temporary_folder.hpp"

namespace rodeira::road {
namespace {

using Eigen::Vector2d;
using network::Network;
using network::Surfacing;

constexpr double kStep_m = 1e-3;

// Road 1 along x at z = 0, road 2 across it at x = 50 and higher; both have two lanes of 3.5 m, road 2 a shoulder of 2
// m on either side too. Nothing goes on.
std::shared_ptr<const World> Crossing(double above_m) {
  opendrive::RoadText level, across;
  across.id = "2";
  across.geometry = R"(<geometry s="0" x="50" y="-50" hdg="1.5707963267948966" length="100"><line/></geometry>)";
  across.elevation = fmt::format(R"(<elevation s="0" a="{}" b="0" c="0" d="0"/>)", above_m);
  across.left += R"(<lane id="2" type="shoulder"><width sOffset="0" a="2" b="0" c="0" d="0"/></lane>)";
  across.right += R"(<lane id="-2" type="shoulder"><width sOffset="0" a="2" b="0" c="0" d="0"/></lane>)";
  const cli::TemporaryFolder folder;
  return World::Load(folder.Write("crossing.xodr", opendrive::Document(level.Text() + across.Text()))).value();
}

// By the formula of one_ground.hpp, straight from the numbers above.
double CountOf(double aside_m, double along_m) {
  const double a = 3.5 - aside_m, b = 3.5 + aside_m, mean = a * b / (a + b);
  const auto end = [](double d) { return d * d / (d * d + 25.0); };
  return mean * mean * end(along_m) * end(100.0 - along_m);
}

TEST(Overlap, IsTheMeanOfBothByTheDistancesToTheirEdges) {
  const auto world = Crossing(0.2);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const double x = base::RandomUniform({i, 1}, 44.6, 55.4), y = base::RandomUniform({i, 2}, -3.4, 3.4);
    const SurfacePoint at = world->At(x, y);
    EXPECT_EQ(at.surface, ground::Surface::kAsphalt);
    if (std::fabs(x - 50.0) >= 3.5) {
      EXPECT_EQ(at.z_m, 0.0) << x << " " << y;  // a shoulder, though higher, does not stand over a lane
      continue;
    }
    const double low = CountOf(y, x), high = CountOf(x - 50.0, y + 50.0);
    EXPECT_NEAR(at.z_m, 0.2 * high / (low + high), 1e-12) << x << " " << y;
  }
  EXPECT_EQ(world->At(20.0, 1.0).z_m, 0.0);
  EXPECT_EQ(world->At(50.0, 20.0).z_m, 0.2);
}

TEST(Overlap, WhatAHintCanTellApartStaysTwoLevels) {
  const auto world = Crossing(0.7);
  EXPECT_EQ(world->At(51.0, 1.0).z_m, 0.7);
  EXPECT_EQ(world->At(51.0, 1.0, 0.3).z_m, 0.7);
  EXPECT_EQ(world->At(51.0, 1.0, 0.1).z_m, 0.0);
}

TEST(Overlap, AQuestionNamesWhatSueloAnswersFrom) {
  const auto world = Crossing(0.2);
  EXPECT_THAT(DescribePoint(*world, 54.5, 1.0, {}), testing::HasSubstr("road: 1\n"));
  EXPECT_THAT(DescribePoint(*world, 51.5, 3.0, {}), testing::HasSubstr("road: 2\n"));
  EXPECT_THAT(DescribePoint(*Crossing(0.7), 54.5, 1.0, {}),
              testing::HasSubstr("road: 2\n"));  // the shoulder, which is over the lane there
}

// Slopes are those of the heights, by differences. The hint only chooses.
void CheckSlopes(const World& world, const Vector2d& p, double z_m, int& over) {
  constexpr double kH_m = 1e-4;
  const SurfacePoint at = world.At(p.x(), p.y(), z_m);
  const auto z = [&](double dx, double dy) { return world.At(p.x() + dx, p.y() + dy, at.z_m).z_m; };
  const Vector2d slope((z(kH_m, 0) - z(-kH_m, 0)) / (2.0 * kH_m), (z(0, kH_m) - z(0, -kH_m)) / (2.0 * kH_m));
  const double bend =
      std::max(std::fabs(z(kH_m, 0) + z(-kH_m, 0) - 2.0 * at.z_m), std::fabs(z(0, kH_m) + z(0, -kH_m) - 2.0 * at.z_m)) /
      kH_m;
  if (bend > 1e-3) return;  // an edge or an end lies between
  ++over;
  EXPECT_NEAR((slope - Vector2d(at.slope_x, at.slope_y)).norm(), 0.0, 1e-4 + bend) << p.x() << " " << p.y();
}

TEST(Overlap, SlopesAreThoseOfTheHeights) {
  int over = 0;
  const auto world = Crossing(0.2);
  for (std::uint64_t i = 0; i < 300; ++i)
    CheckSlopes(*world, {base::RandomUniform({i, 1}, 46.6, 53.4), base::RandomUniform({i, 2}, -3.4, 3.4)}, 0.0, over);
  EXPECT_GT(over, 290);
}

// In the junctions of a real file, where its connecting roads lie over one another.
TEST(Overlap, SlopesOfARealFileAreThoseOfTheHeights) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  const auto file = std::ranges::find(files, "carla_Town04", [](const auto& path) { return path.stem().string(); });
  ASSERT_NE(file, files.end()) << "carla_Town04 is not among the real files";
  const auto town = World::Load(*file).value();
  const Network& network = *town->network();
  const auto lanes = network.Lanes();
  int over = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const network::LaneKey key = lanes[base::RandomBits({i, 3}) % lanes.size()];
    if (network.roads()[key.road].spec().junction.empty()) continue;
    const network::LaneSection& section = network.Section(key);
    const Eigen::Vector3d p = network.Centre(key, base::RandomUniform({i, 4}, section.s_m, section.end_s_m));
    CheckSlopes(*town, p.head<2>(), p.z(), over);
  }
  EXPECT_GT(over, 1000);
}

// Where along the way between two points the ground steps, by halves down to a micrometre: the slopes at both ends say
// what it may rise by.
struct Step {
  double height_m = 0.0;
  Vector2d from_W = Vector2d::Zero(), to_W = Vector2d::Zero();
};

void Seek(const World& world, const Vector2d& p, const SurfacePoint& a, const Vector2d& q, const SurfacePoint& b,
          Step& worst) {
  const Vector2d way = q - p;
  const double rise = b.z_m - a.z_m, begin = a.slope_x * way.x() + a.slope_y * way.y(),
               end = b.slope_x * way.x() + b.slope_y * way.y();
  if (std::fabs(rise - 0.5 * (begin + end)) + 0.5 * std::fabs(begin - end) < 0.5 * kStep_m) return;
  if (way.norm() < 1e-6) {
    if (std::fabs(rise) > worst.height_m) worst = {std::fabs(rise), p, q};
    return;
  }
  const Vector2d middle = p + 0.5 * way;
  const SurfacePoint at = world.At(middle.x(), middle.y(), a.z_m);
  Seek(world, p, a, middle, at, worst);
  Seek(world, middle, at, q, world.At(q.x(), q.y(), at.z_m), worst);
}

// Whether a road that lies on both sides of a step has one there itself: between records of its elevation, at a lane's
// <height>, or where its lanes reach beyond the middle of its bend and lie over one another.
bool IsTheFiles(const Network& network, const Step& step) {
  std::vector<Surfacing> before, behind;
  network.Surfaces(step.from_W.x(), step.from_W.y(), before);
  network.Surfaces(step.to_W.x(), step.to_W.y(), behind);
  for (const Surfacing& a : before) {
    for (const Surfacing& b : behind) {
      if (a.place.lane.road == b.place.lane.road && std::fabs(a.place.z_m - b.place.z_m) >= step.height_m - 1e-9)
        return true;
    }
  }
  return false;
}

// Along every lane for driving of every real file, on its middle and where wheels are.
TEST(Overlap, NoLaneOfARealFileStepsButWhereARoadDoesItself) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto world = World::Load(file).value();
    const Network& network = *world->network();
    int walks = 0, its_own = 0;
    double length_m = 0.0, walked_m = 0.0;
    for (const network::LaneKey& key : network.Lanes()) {
      if (!network::IsDrivable(network.Find(key)->type)) continue;
      const network::Road& road = network.roads()[key.road];
      const network::LaneSection& section = network.Section(key);
      for (const double aside : {-0.75, 0.0, 0.75}) {
        ++walks;
        length_m += section.end_s_m - section.s_m;
        std::optional<std::pair<Vector2d, SurfacePoint>> last;
        for (double s = section.s_m; s < section.end_s_m; s += 0.02) {
          const Eigen::Vector3d lane = road.Surface(s, network.Span(key, s)->centre_t_m() + aside).p_W;
          const Vector2d p = lane.head<2>();
          const SurfacePoint at = world->At(p.x(), p.y(), last ? last->second.z_m : lane.z());
          Step step;
          if (last && at.inside) {
            Seek(*world, last->first, last->second, p, at, step);
            walked_m += 0.02;
          }
          if (step.height_m > kStep_m) {
            ++its_own;
            EXPECT_TRUE(IsTheFiles(network, step)) << file.filename() << ": " << step.height_m << " m at ("
                                                   << step.from_W.transpose() << "), road " << road.id() << ", s " << s;
          }
          last = at.inside ? std::optional(std::pair(p, at)) : std::nullopt;
        }
      }
    }
    // The stations are 0.02 m apart, of which the last may lie up to as much before the section's end.
    EXPECT_GT(length_m, 100.0) << file.filename();
    EXPECT_NEAR(walked_m, length_m, 0.04 * walks + 0.01 * length_m) << file.filename() << ": a lane leaves the ground";
    RecordProperty(file.stem().string(), fmt::format("{} walks, {} steps that a road has itself", walks, its_own));
  }
}

// On the lanes for driving nothing but what is driven on answers, and it is what Locate names.
TEST(Overlap, DrivingLanesAreNamedAsTheyAreLocated) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  for (const auto& file : files) {
    const auto world = World::Load(file).value();
    const Network& network = *world->network();
    long points = 0, others = 0;  // points of all lanes, and those where the two names differ
    for (const network::LaneKey& key : network.Lanes()) {
      const network::Road& road = network.roads()[key.road];
      const network::LaneSection& section = network.Section(key);
      if (network.Find(key)->type != network::LaneType::kDriving) continue;
      for (double s = section.s_m + 0.06; s < section.end_s_m - 0.06; s += 0.5) {
        for (const double aside : {-0.75, 0.0, 0.75}) {
          const network::LaneSpan span = *network.Span(key, s);
          if (span.width_m() < 2.0) continue;
          const Eigen::Vector3d p = road.Surface(s, span.centre_t_m() + aside).p_W;
          const SurfacePoint at = world->At(p.x(), p.y(), p.z());
          const auto named = NetworkPlace(network, *world->land(), p.x(), p.y(), p.z()),
                     located = network.Locate(p.x(), p.y(), at.z_m);
          ASSERT_TRUE(at.inside && named && located);
          ++points;
          others += named->lane != located->lane || named->s_m != located->s_m;
          EXPECT_TRUE(network::IsDrivable(network.Find(named->lane)->type))
              << file.filename() << " road " << road.id() << " s " << s;
          EXPECT_NE(at.surface, ground::Surface::kGrass) << file.filename() << " road " << road.id() << " s " << s;
        }
      }
    }
    EXPECT_GT(points, 100) << file.filename();
    EXPECT_EQ(others, 0) << file.filename() << ", of " << points;
  }
}

}  // namespace
}  // namespace rodeira::road
