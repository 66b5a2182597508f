// OpenDRIVE worlds as a person sees them, asked of single pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/common/scene/ground_worlds.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::view {
namespace {

constexpr int kWidth = 960, kHeight = 540;

Eigen::Vector3d At(const network::Road& road, double s_m, double t_m) { return road.Surface(s_m, t_m).p_W; }

TEST(NetworkStill, LanesMarksKerbAndLand) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = scene::OpenDriveWorld(scene::BendUnderBridge());
  ASSERT_NE(world, nullptr);
  const network::Road& road = world->network()->roads()[0];
  const double s = 20.0;
  Picture picture;
  picture.show_instruments = false;
  picture.moment.cars.push_back(CarAt(At(road, s, -1.75), road.axis().Evaluate(s).heading_rad, -std::atan(0.05)));
  const auto image = RenderStill(*world, picture, kWidth, kHeight);
  ASSERT_TRUE(image.ok()) << image.error().Text();
  const scene::Camera camera = scene::ChaseCamera(picture.moment.cars[0], *world);
  const auto probe = [&](double s_m, double t_m) { return ProbeAt(image.value(), camera, At(road, s_m, t_m)); };
  EXPECT_TRUE(probe(32.0, 1.5).IsAsphalt()) << probe(32.0, 1.5);
  EXPECT_TRUE(probe(40.0, -2.6).IsAsphalt()) << probe(40.0, -2.6);
  // The solid line at the kerb: half of it lies below, on the road, and half on the pavement; at 3.5 there is the kerb's side.
  EXPECT_TRUE(ProbeAt(image.value(), camera, At(road, 24.0, 3.46), 0).IsWhite()) << probe(24.0, 3.46);
  EXPECT_TRUE(ProbeAt(image.value(), camera, At(road, 26.0, 0.13), 0).IsYellow()) << probe(26.0, 0.13);  // left of the centre's two
  const Eigen::Vector3d walk = At(road, 30.0, 4.5);
  EXPECT_GT(ProbeAt(image.value(), camera, walk).red, probe(32.0, 1.5).red + 25.0);  // the pavement is lighter
  const Eigen::Vector3d edge = At(road, 40.0, -4.6), beside = edge + 9.0 * (edge - At(road, 40.0, -3.6)).normalized();
  EXPECT_TRUE(ProbeAt(image.value(), camera, {beside.x(), beside.y(), world->At(beside.x(), beside.y()).z_m}).IsGrown());
  EXPECT_TRUE(ProbeAt(image.value(), 480, 40).IsSky());
}

TEST(NetworkStill, ASignIsReadByThoseWhomItIsForAndGreyFromBehind) {
  RODEIRA_NEEDS_PICTURES();
  const std::string width = "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>";
  const auto world = scene::OpenDriveWorld(fmt::format(
      "<road id=\"1\" length=\"100\" junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"100\"><line/></geometry></planView>"
      "<lanes><laneSection s=\"0\"><left><lane id=\"1\" type=\"driving\">{}</lane></left><center><lane id=\"0\"/></center>"
      "<right><lane id=\"-1\" type=\"driving\">{}</lane></right></laneSection></lanes><signals>"
      "<signal id=\"a\" s=\"22\" t=\"-4\" zOffset=\"1\" orientation=\"+\" dynamic=\"no\" type=\"205\" subtype=\"-1\" country=\"DE\" width=\"1.8\" height=\"1.6\"/>"
      "<signal id=\"b\" s=\"22\" t=\"4\" zOffset=\"1\" orientation=\"-\" dynamic=\"no\" type=\"205\" subtype=\"-1\" country=\"DE\" width=\"1.8\" height=\"1.6\"/>"
      "</signals></road>\n", width, width));
  ASSERT_NE(world, nullptr);
  Picture picture;
  picture.show_instruments = false;
  picture.moment.cars.push_back(CarAt({10.0, -1.75, 0.0}, 0.0));
  const auto image = RenderStill(*world, picture, kWidth, kHeight);
  ASSERT_TRUE(image.ok()) << image.error().Text();
  const scene::Camera camera = scene::ChaseCamera(picture.moment.cars[0], *world);
  const auto probe = [&](double x, double y, double z) { return ProbeAt(image.value(), camera, {x, y, z}); };
  const Probe middle = probe(21.96, -4.0, 2.15), rim = probe(21.96, -4.0, 2.53), back = probe(22.0, 4.2, 2.3);
  EXPECT_TRUE(middle.IsWhite()) << middle;  // give way: white in a red rim, its point below
  EXPECT_TRUE(rim.IsRed()) << rim;
  EXPECT_LT(std::max({back.red, back.green, back.blue}) - std::min({back.red, back.green, back.blue}), 30.0) << back;
  EXPECT_GT(back.red, 60.0) << back;
  EXPECT_LT(back.red, 200.0) << back;
}

}  // namespace
}  // namespace rodeira::view
