// SPDX-License-Identifier: Apache-2.0
// What hills and bridges keep from the sun. Oracle: a ray towards it over SUELO.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "common/view/scene/lighting/air.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"
#include "tests/n222.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 800, kHeight = 600;
constexpr double kValley_s_m = 5100.0;  // of N222: here hills hide the morning's sun from many places

double Brightness(const Probe& probe) { return (probe.red + probe.green + probe.blue) / 3.0; }

// A clear moment and the same at low quality, which has no shadows.
struct Pair {
  Image with, without;
  // How much of the light is left at a place.
  double LeftAt(const scene::Camera& camera, const Eigen::Vector3d& p_W) const {
    return Brightness(ProbeAt(with, camera, p_W, 1)) / Brightness(ProbeAt(without, camera, p_W, 1));
  }
};

Pair Drawn(const road::World& world, const Picture& picture) {
  return {RenderStill(world, picture, kWidth, kHeight, {}, Quality::kMedium).value(),
          RenderStill(world, picture, kWidth, kHeight, {}, Quality::kLow).value()};
}

// How far the ray from a place towards the sun passes over the ground at least, m; less than 0: something is before it.
double RoomUnderRay(const road::World& world, const Eigen::Vector3d& p_W, const Eigen::Vector3d& to_sun) {
  double room = 1e9;
  for (double way_m = 25.0; way_m < 1'500.0; way_m += 10.0) {
    const Eigen::Vector3d at = p_W + way_m * to_sun;
    const road::SurfacePoint ground = world.At(at.x(), at.y());
    if (!ground.inside) break;
    room = std::min(room, at.z() - ground.z_m);
  }
  return room;
}

// In a valley of N222 early in the morning: where its ray is cut off, the light of the sun is missing, and elsewhere it
// is not.
TEST(GroundShadow, HillsStandBeforeTheSun) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml").value();
  Picture picture;
  picture.show_instruments = false;
  picture.camera = scene::CameraKind::kTop;
  picture.aim.map_height_m = 900.0;
  picture.moment.weather.clouds = 0.0;
  picture.moment.weather.hour = 6.8;
  picture.moment.cars.push_back(CarOn(N222Road(), kValley_s_m, -1.45));
  const Pair pair = Drawn(*world, picture);
  const scene::Camera camera = scene::MakeCamera(picture.camera, picture.moment.cars[0], picture.aim, *world);
  const scene::Air air = scene::MakeAir(picture.moment.weather);
  const Eigen::Vector3d to_sun = air.sun_W.cast<double>();
  double left = 0.0, expected = 0.0, left_in_sun = 0.0;
  int shaded = 0, lit = 0;
  for (std::uint64_t i = 0; i < 900; ++i) {
    const double x = picture.moment.cars[0].p_WB_W.x() + base::RandomUniform({i, 0}, -550.0, 550.0),
                 y = picture.moment.cars[0].p_WB_W.y() + base::RandomUniform({i, 1}, -420.0, 420.0);
    const road::SurfacePoint ground = world->At(x, y);
    if (!ground.inside) continue;
    const Eigen::Vector3d normal = Eigen::Vector3d(-ground.slope_x, -ground.slope_y, 1.0).normalized();
    const double sun = normal.dot(to_sun);
    if (sun < 0.12) continue;  // it hardly reaches the place anyway
    const double room_m = RoomUnderRay(*world, {x, y, ground.z_m}, to_sun);
    if (std::fabs(room_m) < 5.0) continue;  // near a shadow's edge
    const double left_here = pair.LeftAt(camera, {x, y, ground.z_m});
    if (room_m > 0.0) {
      ++lit, left_in_sun += left_here;
      continue;
    }
    const double sky = static_cast<double>(air.base_light.mean()) +
                       (0.5 + 0.5 * normal.z()) * static_cast<double>(air.sky_light.mean());
    const double of_light = sky / (sky + sun * static_cast<double>(air.sun_light.mean()));
    // The haze before it stays as bright as it was: of what is seen so much is the ground's own.
    const Eigen::Vector3d p_W(x, y, ground.z_m);
    const double clear = std::exp(-std::pow((p_W - camera.eye_W).norm() * 1.6e-4, 1.3)),
                 haze = 255.0 * air.horizon.cast<double>().dot(Eigen::Vector3d(0.93, 0.96, 1.0)) / 3.0;
    const double own = 1.0 - (1.0 - clear) * haze / Brightness(ProbeAt(pair.without, camera, p_W, 1));
    ++shaded, left += left_here, expected += 1.0 - own * (1.0 - of_light);
  }
  ASSERT_GT(shaded, 30);
  ASSERT_GT(lit, 200);
  left /= shaded, expected /= shaded, left_in_sun /= lit;
  EXPECT_NEAR(left_in_sun, 1.0, 0.03) << "of " << lit << " places";
  EXPECT_LT(expected, 0.93);
  EXPECT_NEAR(left / left_in_sun, expected, 0.03) << "of " << shaded << " places";
}

// A straight road, and one square across it 7 m higher.
TEST(GroundShadow, OfABridgeOnTheRoadBelow) {
  RODEIRA_NEEDS_PICTURES();
  const auto straight = [](int id, double x_m, double y_m, double heading_rad, double z_m) {
    const std::string lane = R"(<width sOffset="0" a="3" b="0" c="0" d="0"/></lane>)";
    return fmt::format(
        R"(<road id="{}" length="200" junction="-1"><planView><geometry s="0" x="{}" y="{}" hdg="{}" length="200">
            <line/></geometry></planView>)"
        R"(<elevationProfile><elevation s="0" a="{}" b="0" c="0" d="0"/></elevationProfile>)"
        R"(<lanes><laneSection s="0"><left><lane id="1" type="driving">{}</left><center><lane id="0"/></center><right>
            <lane id="-1" type="driving">{}</right></laneSection></lanes></road>)",
        id, x_m, y_m, heading_rad, z_m, lane, lane);
  };
  const auto world =
      scene::OpenDriveWorld(straight(1, 0.0, 0.0, 0.0, 0.0) + straight(2, 100.0, -100.0, 1.5707963267948966, 7.0));
  ASSERT_NE(world, nullptr);
  Picture picture;
  picture.show_instruments = false;
  picture.moment.weather.clouds = 0.0;
  picture.moment.weather.hour = 10.5;
  const Eigen::Vector3d to_sun = scene::MakeAir(picture.moment.weather).sun_W.cast<double>();
  // Whether the ray towards the sun goes through the upper surface: the bridge, or the land beside it, which is as
  // high. Coming out from below its side is not going through it.
  const auto covered = [&](double x_m) {
    double before = 0.0;
    for (double way_m = 0.2; way_m < 40.0; way_m += 0.05) {
      const Eigen::Vector3d at = Eigen::Vector3d(x_m, 1.5, 0.0) + way_m * to_sun;
      const double over = at.z() - world->At(at.x(), at.y()).z_m;
      if (before * over < 0.0 && (over < 0.0 || over < 0.5)) return true;
      before = over;
    }
    return false;
  };
  const double eye_m = 78.0;
  picture.moment.cars.push_back(CarAt({eye_m, -1.5, 0.0}, 0.0));
  const Pair pair = Drawn(*world, picture);
  const scene::Camera camera = scene::ChaseCamera(picture.moment.cars[0], *world);
  int dark = 0, bright = 0;
  for (double x_m = eye_m + 4.0; x_m < 100.0;
       x_m += 0.5) {  // beyond it the land to the south of the bridge is drawn more coarsely than SUELO's
    const bool is = covered(x_m);
    if (covered(x_m - 1.2) != is || covered(x_m + 1.2) != is) continue;  // its edge
    (is ? dark : bright) += 1;
    const double left = pair.LeftAt(camera, {x_m, 1.5, 0.0});
    EXPECT_EQ(left < 0.8, is) << left << " of the light at x = " << x_m;
  }
  EXPECT_GT(dark, 6);
  EXPECT_GT(bright, 6);
}

}  // namespace
}  // namespace rodeira::nodes
