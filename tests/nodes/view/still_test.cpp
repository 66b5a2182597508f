// SPDX-License-Identifier: Apache-2.0
// What a person sees, asked of single pixels: where a thing of the world projects to, there its colour is.
#include <gtest/gtest.h>

#include <cmath>

#include "common/core/base/random.hpp"
#include "tests/long_form.hpp"
#include "tests/n222.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 960, kHeight = 540;

std::shared_ptr<const road::World> Load(const char* name) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/" + name);
  EXPECT_TRUE(world.ok()) << world.error().Text();
  return world.value();
}

Image Still(const road::World& world, const Picture& picture) {
  auto image = RenderStill(world, picture, kWidth, kHeight);
  EXPECT_TRUE(image.ok()) << image.error().Text();
  return image.value();
}

// Several pictures of a world, with one surface and one renderer, as the node has them.
class Stills {
 public:
  explicit Stills(const road::World& world)
      : surface_(Surface::Open(SurfaceKind::kOffscreen, kWidth, kHeight, "test").value()),
        renderer_(RendererOf(*surface_, world, {}).value()) {}
  Image Of(const Picture& picture) {
    renderer_->DrawWhole(picture);
    return renderer_->Read();
  }

 private:
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Renderer> renderer_;
};

struct Tally {
  int asked = 0;
  int right = 0;
};

// Whether the car may hide a point that lies farther away: within the outline of the box around it, and a margin.
bool IsBehind(const scene::CarPose& car, const scene::Camera& camera, const Eigen::Vector3d& p_W) {
  Eigen::AlignedBox2d box;
  for (const double x : {car.front_m - car.length_m, car.front_m}) {
    for (const double y : {-0.6 * car.width_m, 0.6 * car.width_m}) {
      for (const double z : {0.0, 1.5}) {
        const Eigen::Vector3d corner = car.p_WB_W + car.q_WB * Eigen::Vector3d(x, y, z);
        box.extend(*camera.Project(corner, kWidth, kHeight));
      }
    }
  }
  const Eigen::Vector2d margin(4.0, 4.0);
  return Eigen::AlignedBox2d(box.min() - margin, box.max() + margin).contains(*camera.Project(p_W, kWidth, kHeight));
}

TEST(Still, OnAPlane) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = Load("plane.yaml");
  Picture picture;
  picture.show_instruments = false;
  picture.moment.cars.push_back(CarAt({12.0, 7.0, 0.0}, 0.6));
  const scene::CarPose& car = picture.moment.cars[0];
  const Image image = Still(*world, picture);
  ASSERT_EQ(image.width_px, kWidth);
  ASSERT_EQ(image.height_px, kHeight);
  const scene::Camera camera = scene::ChaseCamera(car, *world);
  for (int x = 20; x < kWidth; x += 60) EXPECT_TRUE(ProbeAt(image, x, 12).IsSky()) << x << " " << ProbeAt(image, x, 12);
  const auto ground = [&](double ahead, double aside) -> Eigen::Vector3d {
    return car.p_WB_W + car.q_WB * Eigen::Vector3d(ahead, aside, 0.0);
  };
  for (const double ahead : {15.0, 30.0, 60.0}) {
    EXPECT_TRUE(ProbeAt(image, camera, ground(ahead, 8.0)).IsAsphalt())
        << ahead << " " << ProbeAt(image, camera, ground(ahead, 8.0));
  }
  // Paint, glass, tyre: the middle of the tailgate, the rear window, the left rear wheel.
  EXPECT_TRUE(ProbeAt(image, camera, car.p_WB_W + car.q_WB * Eigen::Vector3d(-1.8, 0.0, 0.80)).IsRed());
  const Probe glass = ProbeAt(image, camera, car.p_WB_W + car.q_WB * Eigen::Vector3d(-1.5, 0.0, 1.12));
  EXPECT_LT(glass.red, 110.0) << glass;
  EXPECT_FALSE(glass.IsRed());
  // The squares of the plane: neighbours differ, so that motion is seen.
  double light = 0.0, dark = 255.0;
  for (int k = 0; k < 40; ++k) {
    const double green = ProbeAt(image, camera, ground(12.0 + 0.9 * k, -6.0), 2).green;
    light = std::max(light, green);
    dark = std::min(dark, green);
  }
  EXPECT_GT(light, dark + 8.0);
}

TEST(Still, OnN222) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = Load("n222.yaml");
  const Version1Road& road = N222Road();
  // One surface and renderer for all, as the node has them.
  auto surface = Surface::Open(SurfaceKind::kOffscreen, kWidth, kHeight, "test");
  ASSERT_TRUE(surface.ok());
  const scene::WorldScene standing = scene::BuildWorldScene(*world);
  Renderer renderer(*surface.value(), *world, standing);
  Tally edges, middles, asphalt, green, sky;
  for (double s = 60.0; s < road.length_m() - 80.0; s += BriefOrLong(500.0, 115.0)) {
    Picture picture;
    picture.show_instruments = false;
    picture.moment.cars.push_back(CarOn(road, s, -1.45));
    renderer.Draw(picture);
    const Image image = renderer.Read();
    const scene::Camera camera = scene::ChaseCamera(picture.moment.cars[0], *world);
    const scene::CarPose& car = picture.moment.cars[0];
    const auto probe = [&](double t) { return ProbeAt(image, camera, road.Position(s + 7.0, t), 0); };
    const auto seen = [&](double t) { return !IsBehind(car, camera, road.Position(s + 7.0, t)); };
    const auto count = [&](Tally& tally, double t, bool right) {
      if (!seen(t)) return;
      ++tally.asked;
      tally.right += right;
    };
    count(asphalt, 2.0, probe(2.0).IsAsphalt());
    count(edges, -2.96, probe(-2.96).IsWhite());
    count(edges, 2.96, probe(2.96).IsWhite());
    count(green, -3.7, probe(-3.7).IsGrown());  // before posts and rails
    count(green, 3.7, probe(3.7).IsGrown());
    ++sky.asked;
    sky.right += ProbeAt(image, 0.5 * kWidth, 10).IsSky();
    EXPECT_TRUE(ProbeAt(image, camera,
                        picture.moment.cars[0].p_WB_W + picture.moment.cars[0].q_WB * Eigen::Vector3d(-1.8, 0.0, 0.80))
                    .IsRed())
        << s;
    // The middle line is hidden by the car, but not from its driver.
    picture.camera = scene::CameraKind::kDriver;
    renderer.Draw(picture);
    const Eigen::Vector3d middle = road.Position(s + 11.0, 0.0);
    const bool painted = world->At(middle.x(), middle.y()).surface == ground::Surface::kRoadMark;
    ++middles.asked;
    middles.right += painted == ProbeAt(renderer.Read(), scene::DriverCamera(car), middle, 0).IsWhite();
  }
  for (const Tally* tally : {&asphalt, &edges, &green, &middles, &sky}) EXPECT_GE(tally->asked, 10);
  EXPECT_EQ(asphalt.right, asphalt.asked);
  EXPECT_GE(edges.right, edges.asked - 3) << "in a sharp bend a line may be thinner than a pixel";
  EXPECT_EQ(green.right, green.asked);
  EXPECT_GE(middles.right, middles.asked * 9 / 10) << "the end of a dash may fall on the pixel";
  EXPECT_GE(sky.right, sky.asked - 2) << "a hill may stand before it";
}

// Screens around a seat: the picture goes on from one into the next, row by row.
TEST(Still, ThreeScreensAreOnePicture) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = Load("n222.yaml");
  Picture picture;
  picture.camera = scene::CameraKind::kDriver;
  picture.show_instruments = false;
  picture.moment.cars.push_back(CarOn(N222Road(), 40.0, -1.45));
  const double width = 0.708, distance = 0.7, angle = 2.0 * std::atan(0.5 * width / distance);
  Stills stills(*world);
  const auto seen = [&](double angle_rad) {
    picture.screen = scene::ScreenPlane{width, 0.398, distance, angle_rad, 0.22, 0.0};
    return stills.Of(picture);
  };
  const Image left = seen(angle), centre = seen(0.0), right = seen(-angle);
  // How far the rows of two columns differ, one of them drawn down by `shift`.
  const auto difference = [](const Image& a, int a_x, const Image& b, int b_x, int shift) {
    int sum = 0;
    for (int y = 10; y < kHeight - 10; ++y) {
      for (int c = 0; c < 3; ++c) sum += std::abs(a.At(a_x, y)[c] - b.At(b_x, y + shift)[c]);
    }
    return sum;
  };
  for (const auto& [a, b] : {std::pair(&left, &centre), std::pair(&centre, &right)}) {
    int best = -10;
    for (int shift = -10; shift <= 10; ++shift) {
      if (difference(*a, kWidth - 1, *b, 0, shift) < difference(*a, kWidth - 1, *b, 0, best)) best = shift;
    }
    EXPECT_LE(std::abs(best), 1);
    EXPECT_LT(difference(*a, kWidth - 1, *b, 0, 0), difference(*a, kWidth - 30, *b, 0, 0))
        << "what is 30 columns away is more unlike it";
  }
}

TEST(Still, TheDriverSeesTheRoadAndNotTheCabin) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = Load("n222.yaml");
  const Version1Road& road = N222Road();
  Picture picture;
  picture.camera = scene::CameraKind::kDriver;
  picture.show_instruments = false;
  picture.moment.cars.push_back(CarOn(road, 40.0, -1.45));
  const Image image = Still(*world, picture);
  const scene::Camera camera = scene::DriverCamera(picture.moment.cars[0]);
  EXPECT_TRUE(ProbeAt(image, camera, road.Position(60.0, -1.45)).IsAsphalt());
  EXPECT_TRUE(ProbeAt(image, camera, road.Position(50.0, 2.96), 0).IsWhite())
      << ProbeAt(image, camera, road.Position(50.0, 2.96), 0);
  EXPECT_TRUE(ProbeAt(image, 0.5 * kWidth, 10).IsSky());
  EXPECT_TRUE(ProbeAt(image, 0.55 * kWidth, kHeight - 4).IsRed()) << "the bonnet";
}

TEST(Still, TrafficIsWhereItIs) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = Load("n222.yaml");
  const Version1Road& road = N222Road();
  Picture picture;
  picture.show_instruments = false;
  picture.moment.cars.push_back(CarOn(road, 30.0, -1.45));
  const scene::CarPose ahead = CarOn(road, 52.0, 1.45);
  scene::AgentPose agent;
  agent.colour = scene::Colour::Of(0x1040e0);
  agent.p_WB_W = ahead.p_WB_W;
  agent.q_WB = ahead.q_WB;
  Stills stills(*world);
  const Image without = stills.Of(picture);
  picture.moment.agents.push_back(agent);
  const Image with = stills.Of(picture);
  const scene::Camera camera = scene::ChaseCamera(picture.moment.cars[0], *world);
  const Eigen::Vector3d tailgate = agent.p_WB_W + agent.q_WB * Eigen::Vector3d(-2.0, 0.0, 0.82);
  EXPECT_FALSE(ProbeAt(without, camera, tailgate).IsBlue());
  EXPECT_TRUE(ProbeAt(with, camera, tailgate).IsBlue()) << ProbeAt(with, camera, tailgate);
  // Nothing else changed: beyond the agent's own surroundings the pictures are the same.
  const auto at = camera.Project(tailgate, kWidth, kHeight);
  std::size_t differ = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (std::hypot(x - at->x(), y - at->y()) < 90.0) continue;
      differ += std::memcmp(with.At(x, y), without.At(x, y), 3) != 0;
    }
  }
  EXPECT_EQ(differ, 0U);
}

TEST(Still, TheSameMomentGivesTheSamePicture) {
  RODEIRA_NEEDS_PICTURES();
  const auto world = Load("plane.yaml");
  Picture picture;
  picture.moment.time_ns = 12'340'000'000;
  picture.moment.cars.push_back(CarAt({1.0, 2.0, 0.0}, 0.3));
  const Image one = Still(*world, picture), again = Still(*world, picture);
  EXPECT_EQ(one.rgb, again.rgb);
  picture.moment.cars[0].p_WB_W.x() += 0.4;
  EXPECT_NE(Still(*world, picture).rgb, one.rgb);
  const Image shown = Still(*world, picture);
  picture.show_instruments = false;
  EXPECT_NE(Still(*world, picture).rgb, shown.rgb);
}

}  // namespace
}  // namespace rodeira::nodes
