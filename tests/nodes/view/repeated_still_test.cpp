// SPDX-License-Identifier: Apache-2.0
// Trees, posts and whatever is repeated: as one model at many places they are seen as they are seen merged, shadows and
// mirrors included.
#include <gtest/gtest.h>

#include <cstdlib>

#include "nodes/view/materials/plain_geometry.hpp"
#include "tests/long_form.hpp"
#include "tests/nodes/view/pictures.hpp"
#include "tests/tree.hpp"

namespace rodeira::nodes {
namespace {

const int kWidth = BriefOrLong(640, 960), kHeight = BriefOrLong(360, 540);

class RepeatedStill : public ::testing::Test {
 protected:
  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    const auto surface = Surface::Open(SurfaceKind::kOffscreen, 64, 64, "test");
    if (!CanRepeat()) GTEST_SKIP() << "this OpenGL draws every model once";
  }
  struct Seen {
    Image image;
    PictureCost cost;
  };
  static Seen See(const road::World& world, const Picture& picture, bool repeats, Quality quality) {
    auto surface = Surface::Open(SurfaceKind::kOffscreen, kWidth, kHeight, "test", false, 0, quality);
    EXPECT_TRUE(surface.ok());
    auto renderer = RendererOf(*surface.value(), world, {}, repeats);
    EXPECT_TRUE(renderer.ok());
    renderer.value()->DrawWhole(picture);
    return {renderer.value()->Read(), renderer.value()->CostOfLast()};
  }
  // How many pixels of a thousand differ by more than the last bit of a colour's arithmetic.
  static double Differ(const Image& a, const Image& b) {
    int pixels = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        int most = 0;
        for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a.At(x, y)[c] - b.At(x, y)[c]));
        pixels += most > 1;
      }
    }
    return 1000.0 * pixels / (kWidth * kHeight);
  }
  static Picture From(const road::World& world, scene::CameraKind camera) {
    Picture picture;
    picture.camera = camera;
    picture.show_instruments = false;
    const road::StartPose& start = world.start();
    picture.moment.cars.push_back(CarAt({start.x_m, start.y_m, world.At(start.x_m, start.y_m).z_m}, start.heading_rad));
    return picture;
  }
};

// A place is found in single precision by the graphics card and in double by us: an edge may fall on the other side of
// a pixel's middle.
constexpr double kEdges = 0.5;

TEST_F(RepeatedStill, AsIfMerged) {
  const auto compare = [](const char* name, scene::CameraKind camera) {
    const auto world = road::World::Load(SourceDir() + "/configs/worlds/" + name);
    ASSERT_TRUE(world.ok()) << world.error().Text();
    const Picture picture = From(*world.value(), camera);
    const Seen merged = See(*world.value(), picture, false, Quality::kMedium),
               repeated = See(*world.value(), picture, true, Quality::kMedium);
    EXPECT_LT(Differ(merged.image, repeated.image), kEdges) << name;
    EXPECT_LT(repeated.cost.triangles, merged.cost.triangles) << name;
  };
  compare("n222.yaml", scene::CameraKind::kDriver);  // with mirrors
  compare("example/world.yaml", scene::CameraKind::kChase);
}

TEST_F(RepeatedStill, TheSamePictureAgain) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml").value();
  const Picture picture = From(*world, scene::CameraKind::kChase);
  EXPECT_EQ(See(*world, picture, true, Quality::kHigh).image.rgb, See(*world, picture, true, Quality::kHigh).image.rgb);
}

// At low quality models are merged: fewer calls of drawing.
TEST_F(RepeatedStill, NotAtLowQuality) {
  const auto world = road::World::Load(SourceDir() + "/configs/worlds/n222.yaml").value();
  const Picture picture = From(*world, scene::CameraKind::kChase);
  const Seen asked = See(*world, picture, true, Quality::kLow), merged = See(*world, picture, false, Quality::kLow);
  EXPECT_EQ(asked.image.rgb, merged.image.rgb);
  EXPECT_EQ(asked.cost.triangles, merged.cost.triangles);
}

}  // namespace
}  // namespace rodeira::nodes
