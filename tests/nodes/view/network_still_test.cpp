// SPDX-License-Identifier: Apache-2.0
// OpenDRIVE worlds as a person sees them, asked of single pixels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/view/scene/road_furniture/light_heads.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
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
  // The solid line at the kerb: half of it lies below, on the road, and half on the pavement; at 3.5 there is the
  // kerb's side.
  EXPECT_TRUE(ProbeAt(image.value(), camera, At(road, 24.0, 3.46), 0).IsWhite()) << probe(24.0, 3.46);
  EXPECT_TRUE(ProbeAt(image.value(), camera, At(road, 26.0, 0.13), 0).IsYellow())
      << probe(26.0, 0.13);  // left of the centre's two
  const Eigen::Vector3d walk = At(road, 30.0, 4.5);
  EXPECT_GT(ProbeAt(image.value(), camera, walk).red, probe(32.0, 1.5).red + 25.0);  // the pavement is lighter
  const Eigen::Vector3d edge = At(road, 40.0, -4.6), beside = edge + 9.0 * (edge - At(road, 40.0, -3.6)).normalized();
  EXPECT_TRUE(
      ProbeAt(image.value(), camera, {beside.x(), beside.y(), world->At(beside.x(), beside.y()).z_m}).IsGrown());
  EXPECT_TRUE(ProbeAt(image.value(), 480, 40).IsSky());
}

TEST(NetworkStill, ASignIsReadFromItsFrontAndGreyFromBehind) {
  RODEIRA_NEEDS_PICTURES();
  const std::string width = "<width sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" d=\"0\"/>";
  const auto world = scene::OpenDriveWorld(
      fmt::format("<road id=\"1\" length=\"100\" junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
                  "length=\"100\"><line/></geometry></planView>"
                  "<lanes><laneSection s=\"0\"><left><lane id=\"1\" type=\"driving\">{}</lane></left><center><lane "
                  "id=\"0\"/></center>"
                  "<right><lane id=\"-1\" type=\"driving\">{}</lane></right></laneSection></lanes><signals>"
                  "<signal id=\"a\" s=\"22\" t=\"-4\" zOffset=\"1\" orientation=\"+\" dynamic=\"no\" type=\"205\" "
                  "subtype=\"-1\" country=\"DE\" width=\"1.8\" height=\"1.6\"/>"
                  "<signal id=\"b\" s=\"22\" t=\"4\" zOffset=\"1\" orientation=\"-\" dynamic=\"no\" type=\"205\" "
                  "subtype=\"-1\" country=\"DE\" width=\"1.8\" height=\"1.6\"/>"
                  "</signals></road>\n",
                  width, width));
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

// Above green, amber and red the same place is dark or shines, as the moment says; traffic from behind sees none of
// it.
TEST(NetworkStill, LightsShineAsTheMomentSays) {
  RODEIRA_NEEDS_PICTURES();
  using network::LightColour;
  const auto world = scene::OpenDriveWorld(
      "<road id=\"1\" length=\"100\" junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
      "length=\"100\"><line/></geometry></planView>"
      "<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\"><width "
      "sOffset=\"0\" a=\"3.5\" b=\"0\" c=\"0\" "
      "d=\"0\"/></lane></right></laneSection></lanes><signals>"
      "<signal id=\"a\" s=\"22\" t=\"-4\" zOffset=\"1\" orientation=\"+\" dynamic=\"yes\" type=\"1000001\" "
      "subtype=\"-1\" country=\"OpenDRIVE\" height=\"1.2\"/>"
      "</signals></road><controller id=\"1\" name=\"only\"><control signalId=\"a\" type=\"0\"/><userData "
      "code=\"rodeira:times\" value=\"60 0 20 3 1\"/></controller>\n");
  ASSERT_NE(world, nullptr);
  const auto heads = scene::LightHeads(*world);
  ASSERT_EQ(heads.size(), 1u);
  EXPECT_EQ(heads[0].controller, 0u);
  EXPECT_NEAR(heads[0].height_m, 1.2, 1e-9);
  Picture picture;
  picture.show_instruments = false;
  picture.moment.cars.push_back(CarAt({10.0, -1.75, 0.0}, 0.0));
  const scene::Camera camera = scene::ChaseCamera(picture.moment.cars[0], *world);
  const auto surface = Surface::Open(SurfaceKind::kOffscreen, kWidth, kHeight, "test");
  ASSERT_TRUE(surface.ok()) << surface.error().Text();
  const auto renderer = RendererOf(*surface.value(), *world, {});
  ASSERT_TRUE(renderer.ok()) << renderer.error().Text();
  // How bright the three are, from below.
  const auto seen = [&](std::optional<LightColour> colour) {
    picture.moment.lights.clear();
    if (colour) picture.moment.lights.push_back({0, *colour});
    renderer.value()->DrawWhole(picture);
    const Image image = renderer.value()->Read();
    std::array<Probe, 3> probes;
    for (std::size_t which = 0; which < 3; ++which) {
      const Eigen::Vector3d at =
          heads[0].stand.ToWorld({0.17 * 1.2, 0.0, 1.2 * (static_cast<double>(which) + 0.5) / 3.0});
      probes[which] = ProbeAt(image, camera, at);
    }
    return probes;
  };
  const auto bright = [](const Probe& p) { return std::max({p.red, p.green, p.blue}) > 200.0; };
  const auto are_lit = [&](const std::array<Probe, 3>& probes) {
    return std::array<bool, 3>{bright(probes[0]), bright(probes[1]), bright(probes[2])};
  };
  EXPECT_EQ(are_lit(seen(std::nullopt)), (std::array<bool, 3>{false, false, false}));
  const auto green = seen(LightColour::kGreen), amber = seen(LightColour::kAmber), red = seen(LightColour::kRed);
  EXPECT_EQ(are_lit(green), (std::array<bool, 3>{true, false, false}));
  EXPECT_EQ(are_lit(amber), (std::array<bool, 3>{false, true, false}));
  EXPECT_EQ(are_lit(red), (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(are_lit(seen(LightColour::kRedAmber)), (std::array<bool, 3>{false, true, true}));
  EXPECT_TRUE(red[2].IsRed()) << red[2];
  EXPECT_TRUE(amber[1].IsYellow()) << amber[1];
  EXPECT_GT(green[0].green, 1.5 * green[0].red) << green[0];
}

}  // namespace
}  // namespace rodeira::nodes
