// SPDX-License-Identifier: Apache-2.0
// Marks lie on the road's own heights and are drawn over it by a polygon offset: from picture to picture none of them
// may vanish.
#include <gtest/gtest.h>

#include "tests/long_form.hpp"
#include "tests/n222.hpp"
#include "tests/nodes/view/driver_still.hpp"

namespace rodeira::nodes {
namespace {

class FlickerStill : public DriverStill {
 protected:
  FlickerStill() : DriverStill("n222.yaml", 1280, 720) {}
  void SetUp() override {
    DriverStill::SetUp();
    if (renderer_ == nullptr) return;
    // Everything is built before the first picture: ground that is made while the eye moves costs more pictures.
    renderer_ = std::make_unique<Renderer>(*surface_, *world_, scene::BuildWorldScene(*world_));
  }
  // Whether the ground stands in the way.
  bool IsHidden(const Eigen::Vector3d& eye_W, const Eigen::Vector3d& p_W) const {
    for (double share = 0.1; share < 0.95; share += 0.05) {
      const Eigen::Vector3d at = eye_W + share * (p_W - eye_W);
      if (world_->At(at.x(), at.y()).z_m > at.z() - 0.02) return true;
    }
    return false;
  }
};

// The right edge line, 10 to 45 m ahead (there it is a pixel and a half wide), in pictures 7 cm apart (30 m/s at 430
// pictures a second: far finer than any display): in each it is lighter than the asphalt beside it, wherever the ground
// does not hide it.
TEST_F(FlickerStill, AnEdgeLineIsThereInEveryPicture) {
  const Version1Road& road = N222Road();
  int asked = 0, worst_s = 0;
  double least = 1e9;
  for (const double begin_m : BriefOrLong<std::vector<double>>({27.0}, {27.0, 1677.0, 3277.0})) {  // between posts
    for (int k = 0; k < BriefOrLong(6, 12); ++k) {
      Car() = CarOn(road, begin_m + 0.07 * k, -1.45);
      const scene::Camera camera = scene::DriverCamera(Car());
      const Image image = Drawn();
      for (double ahead_m = 10.0; ahead_m <= 45.0; ahead_m += 2.5) {
        if (IsHidden(camera.eye_W, road.Position(begin_m + ahead_m, -2.96))) continue;
        const auto light = [&](double t_m) {
          const auto at = camera.Project(road.Position(begin_m + ahead_m, t_m), image.width_px, image.height_px);
          if (!at || at->x() < 2.0 || at->x() > image.width_px - 2.0 || at->y() > 0.70 * image.height_px) return -1.0;
          double lightest = 0.0;  // the line may lie on the border of two pixels
          for (const double aside_px : {-1.0, 0.0, 1.0})
            lightest = std::max(lightest, ProbeAt(image, at->x() + aside_px, at->y(), 0).green);
          return lightest;
        };
        const double line = light(-2.96), road_beside = light(-2.2);
        if (line < 0.0 || road_beside < 0.0) continue;
        ++asked;
        if (line - road_beside < least) least = line - road_beside, worst_s = static_cast<int>(begin_m + ahead_m);
      }
    }
  }
  EXPECT_GT(asked, BriefOrLong(75, 300));
  EXPECT_GT(least, 25.0) << "at station " << worst_s;
}

}  // namespace
}  // namespace rodeira::nodes
