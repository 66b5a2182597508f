// SPDX-License-Identifier: Apache-2.0
// Routes through networks, and a car that is driven along them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "common/core/base/random.hpp"
#include "common/driving/driver/autopilot.hpp"
#include "common/driving/driver/route_path.hpp"
#include "common/vehicle/dynamics/bicycle_model.hpp"
#include "common/world/road/world.hpp"
#include "tests/common/world/opendrive/sample.hpp"
#include "tests/tree.hpp"

namespace rodeira::driver {
namespace {

using opendrive::Document;
using opendrive::MustRead;
using opendrive::RoadText;

// A straight of 100 m, then an arc of 50 m radius to the left, of 60 m, with lanes numbered the other way.
std::string Bend() {
  RoadText straight, arc;
  straight.link = R"(<successor elementType="road" elementId="2" contactPoint="end"/>)";
  straight.elevation = R"(<elevation s="0" a="0" b="0.03" c="0" d="0"/>)";
  straight.right =
      R"(<lane id="-1" type="driving"><link><successor id="1"/></link><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          </lane>)";
  arc.id = "2";
  arc.length = 60;
  const double end = 60.0 / 50.0, x = 100.0 + 50.0 * std::sin(end), y = 50.0 * (1.0 - std::cos(end));
  arc.geometry =
      fmt::format(R"(<geometry s="0" x="{}" y="{}" hdg="{}" length="60"><arc curvature="-0.02"/></geometry>)", x, y,
                  end + std::acos(-1.0));
  arc.elevation = R"(<elevation s="0" a="3" b="0" c="0" d="0"/>)";
  arc.link = R"(<successor elementType="road" elementId="1" contactPoint="end"/>)";
  arc.left =
      R"(<lane id="1" type="driving"><link><successor id="-1"/></link><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          </lane>)";
  return Document(straight.Text() + arc.Text());
}

TEST(RoutePath, IsTheMiddleOfItsLanes) {
  const auto network = MustRead(Bend());
  const auto legs = StraightOn(*network, {0, 0, -1}, 1000.0);
  ASSERT_EQ(legs.size(), 2u);
  EXPECT_FALSE(legs[1].along);
  const RoutePath path(*network, legs);
  EXPECT_NEAR(path.length_m(), 100.0 + 60.0 * 51.75 / 50.0, 1e-6);  // the outer side of the bend
  EXPECT_NEAR((path.At(40.0).p_W - Eigen::Vector3d(40.0, -1.75, 1.2)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(path.At(40.0).grade, 0.03, 1e-9);
  const LaneFrame bend = path.At(100.0 + 0.5 * 51.75);
  EXPECT_NEAR(bend.heading_rad, 0.5, 1e-5);
  EXPECT_NEAR(bend.curvature_1pm, 1.0 / 51.75, 1e-6);
  EXPECT_NEAR((bend.p_W - Eigen::Vector3d(100.0 + 51.75 * std::sin(0.5), 50.0 - 51.75 * std::cos(0.5), 3.0)).norm(),
              0.0, 1e-4);
  for (const double d : {0.3, 55.0, 99.8, 120.0, 160.0}) {
    for (const double offset : {-1.0, 0.0, 0.6}) {
      const Eigen::Vector3d p = path.Position(d, offset);
      const auto place = path.Locate(p.x(), p.y(), p.z());
      ASSERT_TRUE(place.has_value());
      EXPECT_NEAR(place->d_m, d, 1e-4);
      EXPECT_NEAR(place->offset_m, offset, 1e-4);
    }
  }
  EXPECT_FALSE(path.Locate(-1.0, -1.75, 0.0).has_value());
}

// The oracle looks at every half metre of the way.
TEST(RoutePath, LocateFindsTheNearestPointOfTheWholeWay) {
  const auto network = MustRead(Bend());
  const RoutePath path(*network, StraightOn(*network, {0, 0, -1}, 1000.0));
  for (std::uint32_t i = 0; i < 400; ++i) {
    const Eigen::Vector2d p(base::RandomUniform({7, i, 0}, 1.0, 150.0), base::RandomUniform({7, i, 1}, -20.0, 40.0));
    double nearest = 1e300;
    for (double d = 0.0; d <= path.length_m(); d += 0.5)
      nearest = std::min(nearest, (path.Position(d, 0.0).head<2>() - p).norm());
    const auto place = path.Locate(p.x(), p.y());
    if (!place) continue;  // beside an end
    const double found = (path.Position(place->d_m, 0.0).head<2>() - p).norm();
    EXPECT_LE(found, nearest + 1e-3) << p.transpose();
    EXPECT_GE(found, nearest - 0.5) << p.transpose();
    EXPECT_NEAR(std::fabs(place->offset_m), found, 1e-3);
  }
}

// The car of the project drives `for_s` seconds along the route from the world's start. It stays in its lane.
void Drive(const std::shared_ptr<const road::World>& world, double for_s, const std::string& name,
           double most_aside_m) {
  const network::Network& network = *world->network();
  const road::StartPose& start = world->start();
  const auto at = network.Locate(start.x_m, start.y_m);
  ASSERT_TRUE(at.has_value());
  auto path = std::make_unique<RoutePath>(network, StraightOn(network, at->lane, 5000.0));
  const RoutePath& way = *path;
  auto ground = world->MakeGround();
  auto car = dynamics::LoadVehicle(std::filesystem::path(SourceDir()) / "configs/vehicles/default.yaml").value();
  ASSERT_TRUE(car->Initialise({.x_m = start.x_m, .y_m = start.y_m, .heading_rad = start.heading_rad}, *ground).ok());
  Autopilot autopilot(AutopilotSettings{}, std::move(path));
  dynamics::Controls controls;
  double aside = 0.0, farthest = 0.0;
  for (int k = 0; k < static_cast<int>(for_s * 1000.0); ++k) {
    const Eigen::Vector3d p = car->state().p_WB_W;
    if (k % 10 == 0) {
      const auto place = way.Locate(p.x(), p.y(), p.z());
      if (!place) break;
      aside = std::max(aside, std::fabs(place->offset_m));
      farthest = place->d_m;
      controls = autopilot.Step({car->state(), car->dimensions(), {}}, 0.01);
    }
    car->Step(controls, *ground, 0.001);
  }
  EXPECT_LT(aside, most_aside_m) << name;
  EXPECT_GT(farthest, std::min(0.9 * way.length_m() - 10.0, 100.0)) << name << " of " << way.length_m();
}

// The steepest the ground of a route is, as the tangent of its angle: the friction that it takes to stand there.
double Steepest(const road::World& world) {
  const network::Network& network = *world.network();
  const auto at = network.Locate(world.start().x_m, world.start().y_m);
  double steepest = 0.0;
  for (const RouteLeg& stretch : StraightOn(network, at->lane, 5000.0)) {
    const network::LaneSection& section = network.Section(stretch.lane);
    for (int i = 0; i <= 100; ++i) {
      const Eigen::Vector3d p = network.Centre(stretch.lane, section.s_m + (section.end_s_m - section.s_m) * i / 100.0);
      const road::SurfacePoint ground = world.At(p.x(), p.y(), p.z());
      steepest = std::max(steepest, std::hypot(ground.slope_x, ground.slope_y));
    }
  }
  return steepest;
}

// Two roads of 10 m that climb by 1 in 1 and lean by 45 degrees: the normal is along (-1, sqrt 2, 1), the ground 60
// degrees steep, and asphalt has a friction of 1.
TEST(RoutePath, NoCarStandsOnTheOneRealFileThatIsNotDriven) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  const auto file = std::ranges::find(files, "esmini_two_pitched_and_rolled_roads",
                                      [](const std::filesystem::path& path) { return path.stem(); });
  ASSERT_NE(file, files.end());
  const auto world = road::World::Load(*file).value();
  EXPECT_NEAR(Steepest(*world), std::sqrt(3.0), 1e-5);
  const road::StartPose& start = world->start();
  const road::SurfacePoint ground = world->At(start.x_m, start.y_m);
  EXPECT_NEAR(ground.slope_x, 1.0, 1e-5);
  EXPECT_NEAR(ground.slope_y, -std::sqrt(2.0), 1e-5);
  EXPECT_EQ(ground.friction, 1.0);
}

TEST(RoutePath, TheAutopilotDrivesEveryRealFile) {
  const auto files = opendrive::RealFiles();
  if (files.empty()) GTEST_SKIP() << "no real .xodr files beside the project";
  std::size_t driven = 0;
  for (const auto& file : files) {
    const auto world = road::World::Load(file).value();
    // Steeper than its friction holds: nothing that a car climbs.
    if (Steepest(*world) > 1.0) {
      EXPECT_EQ(file.stem(), "esmini_two_pitched_and_rolled_roads");
      continue;
    }
    ++driven;
    // On a bank of 0.5 rad the car hangs to one side.
    const bool banked = file.stem() == "esmini_straight_500_superelevation_elevation_curve";
    Drive(world, 60.0, file.filename(), banked ? 1.6 : 0.4);
  }
  EXPECT_EQ(driven + 1, files.size());
}

}  // namespace
}  // namespace rodeira::driver
