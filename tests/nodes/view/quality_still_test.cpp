// SPDX-License-Identifier: Apache-2.0
// What the qualities leave out, and what not; the sun's shadows. Asked of single pixels.
#include <gtest/gtest.h>

#include <cmath>

#include "common/view/scene/lighting/air.hpp"
#include "tests/n222.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 640, kHeight = 480;
constexpr double kShown_m = 24.0;  // of the map's height

std::shared_ptr<const road::World> World(const char* name) {
  return road::World::Load(SourceDir() + "/configs/worlds/" + name).value();
}

double Brightness(const Probe& probe) { return (probe.red + probe.green + probe.blue) / 3.0; }

// From above, at that hour of a clear day: the car in the middle, and six metres aside, where it is wanted, one that
// throws the shadow asked of.
Picture FromAbove(double hour, bool with) {
  Picture picture;
  picture.camera = scene::CameraKind::kTop;
  picture.aim.map_height_m = kShown_m;
  picture.show_instruments = false;
  picture.moment.weather.hour = hour;
  picture.moment.weather.clouds = 0.0;
  picture.moment.cars.push_back(CarAt({3.0, 11.0, 0.0}, 0.3));
  if (with) {
    picture.moment.cars.push_back(CarAt({3.0, 5.0, 0.0}, 0.3));
    picture.moment.cars.back().id = 1;
  }
  return picture;
}

// The plane from above at one quality: one surface and renderer for all of a test's pictures.
class SeenFromAbove {
 public:
  explicit SeenFromAbove(Quality quality)
      : world_(World("plane.yaml")),
        surface_(Surface::Open(SurfaceKind::kOffscreen, kWidth, kHeight, "test", false, 0, quality).value()),
        renderer_(std::make_unique<Renderer>(*surface_, *world_, scene::BuildWorldScene(*world_))) {}

  // How bright the ground is where the shadow of a point over the second car's middle falls, against the same place
  // without that car. From the hour alone: the sun stands asin(cos 42 cos H) high, and a shadow is as long as the
  // height over the tangent of that.
  double WithAgainstWithout(double hour, double height_m, double clouds = 0.0) {
    Picture with = FromAbove(hour, true), without = FromAbove(hour, false);
    with.moment.weather.clouds = without.moment.weather.clouds = clouds;
    const scene::Camera camera = scene::MakeCamera(with.camera, with.moment.cars[0], with.aim, *world_);
    const Eigen::Vector3d sun = scene::MakeAir(with.moment.weather).sun_W.cast<double>(),
                          away = -Eigen::Vector3d(sun.x(), sun.y(), 0.0).normalized();
    const Eigen::Vector3d place = with.moment.cars[1].p_WB_W + height_m / std::tan(scene::SunHeight_rad(hour)) * away;
    const auto shown = [&](const Picture& picture) {
      renderer_->Draw(picture);
      return Brightness(ProbeAt(renderer_->Read(), camera, place, 3));
    };
    return shown(with) / shown(without);
  }

 private:
  std::shared_ptr<const road::World> world_;
  std::unique_ptr<Surface> surface_;
  std::unique_ptr<Renderer> renderer_;
};

TEST(SunShadow, FallsAwayFromTheSunAsLongAsItIsLow) {
  RODEIRA_NEEDS_PICTURES();
  SeenFromAbove seen(Quality::kMedium);
  for (const double hour : {8.0, 16.0}) {
    EXPECT_LT(seen.WithAgainstWithout(hour, 1.2), 0.75) << hour;
    EXPECT_NEAR(seen.WithAgainstWithout(hour, 2.4), 1.0, 0.02) << "beyond the roof's shadow, at " << hour;
    EXPECT_NEAR(seen.WithAgainstWithout(hour, -1.2), 1.0, 0.02) << "on the sun's side, at " << hour;
  }
}

TEST(SunShadow, ThereIsNoneWithoutTheSunNorAtLowQuality) {
  RODEIRA_NEEDS_PICTURES();
  EXPECT_NEAR(SeenFromAbove(Quality::kLow).WithAgainstWithout(8.0, 1.2), 1.0, 0.02);
  EXPECT_NEAR(SeenFromAbove(Quality::kMedium).WithAgainstWithout(8.0, 1.2, 1.0), 1.0, 0.02);
}

// Nothing of the world is left away: each of the places that are asked has its colour, at any quality.
TEST(Quality, RoadLinesLandSkyAndCarAreThereAtEachOfThem) {
  RODEIRA_NEEDS_PICTURES();
  constexpr int kWide = 3 * kWidth / 2, kHigh = 3 * kHeight / 2;
  const auto world = World("n222.yaml");
  const Version1Road& road = N222Road();
  Picture picture;
  picture.show_instruments = false;
  picture.moment.cars.push_back(CarOn(road, 60.0, -1.45));
  const scene::Camera camera = scene::ChaseCamera(picture.moment.cars[0], *world);
  std::vector<Image> images;
  for (const Quality quality : {Quality::kLow, Quality::kMedium, Quality::kHigh}) {
    const auto image = RenderStill(*world, picture, kWide, kHigh, {}, quality);
    ASSERT_TRUE(image.ok());
    const auto probe = [&](double t_m) { return ProbeAt(image.value(), camera, road.Position(67.0, t_m), 0); };
    EXPECT_TRUE(probe(2.0).IsAsphalt()) << probe(2.0);
    EXPECT_TRUE(probe(2.96).IsWhite()) << probe(2.96);
    EXPECT_TRUE(probe(6.5).IsGrown()) << probe(6.5);
    EXPECT_TRUE(ProbeAt(image.value(), kWide / 2, 10).IsSky());
    EXPECT_TRUE(ProbeAt(image.value(), camera,
                        picture.moment.cars[0].p_WB_W + picture.moment.cars[0].q_WB * Eigen::Vector3d(-1.8, 0.0, 0.80))
                    .IsRed());
    images.push_back(image.value());
  }
  EXPECT_NE(images[0].rgb, images[1].rgb);
  EXPECT_NE(images[1].rgb, images[2].rgb);
}

TEST(Quality, AWindowOfTheProcessorIsLowAndFilesAreMedium) {
  RODEIRA_NEEDS_PICTURES();
  const auto own = Surface::Open(SurfaceKind::kOffscreen, 64, 64, "test");
  ASSERT_TRUE(own.ok());
  EXPECT_EQ(own.value()->quality(), Quality::kMedium);
  ASSERT_FALSE(QualityNames().empty());
  for (const std::string_view name : QualityNames())
    EXPECT_EQ(QualityNames()[static_cast<std::size_t>(*QualityOf(name))], name);
  EXPECT_FALSE(QualityOf("best"));
}

}  // namespace
}  // namespace rodeira::nodes
