// SPDX-License-Identifier: Apache-2.0
// A statistic over the ground, asked of single pixels: the shader's colours are those of the scale, 70 parts in 100
// over what is seen without it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/n222.hpp"
#include "tests/nodes/view/driver_still.hpp"

namespace rodeira::nodes {
namespace {

class HeatStill : public DriverStill {
 protected:
  HeatStill() : DriverStill("n222.yaml", 640, 480) {}
  void SetUp() override {
    DriverStill::SetUp();
    if (IsSkipped()) return;
    picture_.camera = scene::CameraKind::kTop;
    picture_.aim.map_height_m = 60.0;
    Car() = CarOn(N222Road(), 200.0, -1.45);
  }
  // Squares about the car, 16 by 16, each with its share of the scale; heights are those of the ground, and `above_m`.
  template <class Share>
  void Lay(Share share, double above_m = 0.0) {
    auto heat = std::make_shared<HeatPicture>();
    scene::HeatRaster& raster = heat->raster;
    raster.west_m = kSquare_m * std::floor(Car().p_WB_W.x() / kSquare_m - 8.0);
    raster.south_m = kSquare_m * std::floor(Car().p_WB_W.y() / kSquare_m - 8.0);
    raster.columns = raster.rows = 16;
    raster.lowest_m = Car().p_WB_W.z() - 50.0;
    raster.range_m = 100.0;
    for (std::size_t row = 0; row < raster.rows; ++row) {
      for (std::size_t column = 0; column < raster.columns; ++column) {
        const Eigen::Vector3d middle = Middle(raster, column, row);
        const auto height = static_cast<std::uint16_t>(
            std::lround(65535.0 * (middle.z() + above_m - raster.lowest_m) / raster.range_m));
        raster.texels.insert(raster.texels.end(),
                             {static_cast<std::uint16_t>(std::lround(65535.0 * share(column, row))), height, 0, 0});
      }
    }
    picture_.heat = heat;
  }
  Eigen::Vector3d Middle(const scene::HeatRaster& raster, std::size_t column, std::size_t row) const {
    const double x = raster.west_m + kSquare_m * (static_cast<double>(column) + 0.5),
                 y = raster.south_m + kSquare_m * (static_cast<double>(row) + 0.5);
    return {x, y, world_->At(x, y).z_m};
  }
  // Whether its eight neighbours look as this pixel does: at the edge of a line or a car how much of a pixel belongs to
  // which may differ between two shaders of one graphics card.
  static bool OfOneKind(const Image& image, int column_px, int row_px) {
    const std::uint8_t* here = image.At(column_px, row_px);
    for (int y = row_px - 1; y <= row_px + 1; ++y) {
      for (int x = column_px - 1; x <= column_px + 1; ++x) {
        for (int k = 0; k < 3; ++k) {
          if (std::abs(image.At(x, y)[k] - here[k]) > 12) return false;
        }
      }
    }
    return true;
  }
  // Pixel by pixel at the squares' middles: 0.3 of what was seen and 0.7 of the scale's colour.
  template <class Share>
  void ExpectBlended(const Image& before, const Image& heat, Share share, double kept) const {
    const scene::Camera camera = renderer_->CameraOf(picture_);
    int asked = 0;
    for (std::size_t row = 4; row < 10; ++row) {  // below the legend
      for (std::size_t column = 4; column < 12; ++column) {
        const auto at = camera.Project(Middle(picture_.heat->raster, column, row), before.width_px, before.height_px);
        if (!OfOneKind(before, static_cast<int>(at->x()), static_cast<int>(at->y()))) continue;
        const std::uint8_t *was = before.At(static_cast<int>(at->x()), static_cast<int>(at->y())),
                           *is = heat.At(static_cast<int>(at->x()), static_cast<int>(at->y()));
        const scene::Colour colour = scene::HeatColour(share(column, row));
        const double parts[3] = {static_cast<double>(colour.red), static_cast<double>(colour.green),
                                 static_cast<double>(colour.blue)};
        for (int k = 0; k < 3; ++k)
          EXPECT_NEAR(is[k], kept * was[k] + (1.0 - kept) * parts[k], 2.0) << column << ", " << row << ", part " << k;
        ++asked;
      }
    }
    EXPECT_GT(asked, 30);
  }
  static constexpr double kSquare_m = scene::HeatMap::kSquare_m;
};

TEST_F(HeatStill, SeventyPartsInAHundredAreTheScalesColourWhateverGroundItIs) {
  const auto share = [](std::size_t column, std::size_t) {
    return static_cast<double>(column) / 15.0;
  };  // red in the west, green in the east
  const Image before = Drawn();
  Lay(share);
  ExpectBlended(before, Drawn(), share, 1.0 - scene::kHeatShare);
  picture_.heat = nullptr;
  EXPECT_EQ(Drawn().rgb, before.rgb);
}

// From the middle of a square to the next one the colour passes evenly; at low quality, at night and in fog as well.
TEST_F(HeatStill, BetweenTwoSquaresIsTheMiddleOfTheirColours) {
  const auto share = [](std::size_t column, std::size_t) { return column < 8 ? 0.2 : 0.6; };
  picture_.moment.weather.hour = 23.0;
  const Image before = Drawn();
  Lay(share);
  const Image heat = Drawn();
  const scene::Camera camera = renderer_->CameraOf(picture_);
  const Eigen::Vector3d edge = Middle(picture_.heat->raster, 8, 6) - Eigen::Vector3d(0.5 * kSquare_m, 0.0, 0.0);
  const Probe was = ProbeAt(before, camera, edge), is = ProbeAt(heat, camera, edge);
  const scene::Colour between = scene::HeatColour(0.4);
  EXPECT_NEAR(is.red, 0.3 * was.red + 0.7 * between.red, 4.0);
  EXPECT_NEAR(is.green, 0.3 * was.green + 0.7 * between.green, 4.0);
}

// What belongs to a bridge six metres above does not colour the road below.
TEST_F(HeatStill, OfAnotherSurfaceNothingIsSeen) {
  const Image before = Drawn();
  Lay([](std::size_t, std::size_t) { return 0.0; }, 6.0);
  EXPECT_EQ(Drawn().rgb.size(), before.rgb.size());
  ExpectBlended(
      before, Drawn(), [](std::size_t, std::size_t) { return 0.0; }, 1.0);
}

}  // namespace
}  // namespace rodeira::nodes
