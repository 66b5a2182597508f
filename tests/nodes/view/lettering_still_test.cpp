// SPDX-License-Identifier: Apache-2.0
// What is written on a sign, read pixel by pixel: from left to right by oncoming traffic, reversed in its mirrors once
// they have passed.
#include <gtest/gtest.h>

#include <cmath>

#include "common/view/scene/camera/mirror.hpp"
#include "common/view/scene/road_furniture/sign_face.hpp"
#include "tests/common/view/scene/ground_worlds.hpp"
#include "tests/nodes/view/pictures.hpp"

namespace rodeira::nodes {
namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr double kSign_s_m = 60.0, kSign_t_m = 1.0, kWide_m = 2.2, kHigh_m = 1.1;
constexpr double kLow_m = 0.5;  // the roof's lower side hides in the inside mirror what is higher than 1.7 m there

// A road to the east with the sign of a town on its left, for traffic from the east.
class Lettering : public ::testing::Test {
 protected:
  void SetUp() override {
    RODEIRA_NEEDS_PICTURES();
    world_ = scene::OpenDriveWorld(fmt::format(
        "<road id=\"1\" length=\"200\" junction=\"-1\"><planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" "
        "length=\"200\"><line/></geometry></planView>"
        "<lanes><laneSection s=\"0\"><center><lane id=\"0\"/></center><right><lane id=\"-1\" type=\"driving\"><width "
        "sOffset=\"0\" a=\"4\" b=\"0\" c=\"0\" d=\"0\"/></lane></right></laneSection></lanes>"
        "<signals><signal id=\"a\" s=\"{}\" t=\"{}\" zOffset=\"{}\" orientation=\"-\" dynamic=\"no\" type=\"310\" "
        "subtype=\"-1\" country=\"DE\" text=\"LE\" width=\"{}\" height=\"{}\"/></signals></road>",
        kSign_s_m, kSign_t_m, kLow_m, kWide_m, kHigh_m));
    ASSERT_NE(world_, nullptr);
    const network::Signal& signal = world_->network()->roads()[0].spec().signals.at(0);
    face_ = scene::DrawFace(scene::FaceOf(signal, false));
  }
  Image Seen(double at_s_m, double heading_rad, bool mirrors) {
    picture_.mirrors.fill(mirrors);
    picture_.camera = scene::CameraKind::kDriver;
    picture_.show_instruments = false;
    picture_.moment.cars = {CarAt({at_s_m, -1.75, 0.0}, heading_rad)};
    auto image = RenderStill(*world_, picture_, kWidth, kHeight);
    EXPECT_TRUE(image.ok()) << image.error().Text();
    return image.value();
  }
  // A place of the sign's face; u from its left edge to its right one as it is written, v upward.
  static Eigen::Vector3d OnSign(double u, double v) {
    return {kSign_s_m + 0.042, kSign_t_m + (u - 0.5) * kWide_m,
            kLow_m + v * kHigh_m};  // traffic from the east has the south on the left
  }
  static double Brightness(scene::Colour c) { return 0.3 * c.red + 0.6 * c.green + 0.1 * c.blue; }
  // What is written about a place, over as much as a pixel of a mirror shows.
  double Written(double u, double v) const {
    double sum = 0.0;
    int count = 0;
    for (int x = static_cast<int>((u - 0.006) * face_.width_px); x <= static_cast<int>((u + 0.006) * face_.width_px);
         ++x) {
      for (int y = static_cast<int>((v - 0.012) * face_.height_px);
           y <= static_cast<int>((v + 0.012) * face_.height_px); ++y)
        sum += Brightness(face_.At(x, y)), ++count;
    }
    return sum / count;
  }
  // How well what is seen goes with what is written (1: perfectly), where `place` gives a point of the face its pixel.
  template <class Place>
  double Likeness(const Image& image, bool reversed, Place place) const {
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
    for (double u = 0.06; u < 0.95; u += 0.01) {
      for (double v = 0.1; v < 0.91; v += 0.02) {
        const Eigen::Vector2d at = place(OnSign(u, v));
        const Probe probe = ProbeAt(image, at.x(), at.y(), 0);
        const double written = Written(reversed ? 1.0 - u : u, v),
                     seen = 0.3 * probe.red + 0.6 * probe.green + 0.1 * probe.blue;
        n += 1.0, x += written, y += seen, xx += written * written, yy += seen * seen, xy += written * seen;
      }
    }
    return (n * xy - x * y) / std::sqrt((n * xx - x * x) * (n * yy - y * y));
  }

  std::shared_ptr<const road::World> world_;
  scene::Raster face_;
  Picture picture_;
};

TEST_F(Lettering, ReadsFromLeftToRightForOncomingTraffic) {
  const Image image = Seen(kSign_s_m + 12.0, 3.14159265358979, false);
  const scene::Camera camera = scene::DriverCamera(picture_.moment.cars[0]);
  const auto place = [&](const Eigen::Vector3d& p_W) { return *camera.Project(p_W, kWidth, kHeight); };
  EXPECT_GT(camera.Project(OnSign(1.0, 0.5), kWidth, kHeight)->x(),
            camera.Project(OnSign(0.0, 0.5), kWidth, kHeight)->x() + 60.0);
  EXPECT_GT(Likeness(image, false, place), 0.8);
  EXPECT_LT(Likeness(image, true, place), 0.5);
}

TEST_F(Lettering, IsReversedInEachMirrorThatShowsIt) {
  const Image image = Seen(kSign_s_m + 12.0, 0.0, true);  // it lies behind, on the left
  for (const scene::Mirror mirror : {scene::Mirror::kLeft, scene::Mirror::kInside}) {
    const scene::MirrorPlace box = scene::PlaceOf(mirror, static_cast<double>(kWidth) / kHeight);
    const scene::Camera camera = scene::MirrorCamera(picture_.moment.cars[0], mirror);
    // By what a mirror is: what lies to the left of the car is seen on the left. Its camera looks backward and has that
    // on the right.
    const auto place = [&](const Eigen::Vector3d& p_W) -> Eigen::Vector2d {
      const Eigen::Vector2d share = *camera.Project(p_W, 10'000, 10'000) / 10'000.0;
      return {(box.right - share.x() * (box.right - box.left)) * kWidth,
              (1.0 - box.high + share.y() * (box.high - box.low)) * kHeight};
    };
    // The reader's left end of the word lies on the right.
    EXPECT_GT(place(OnSign(0.0, 0.5)).x(), place(OnSign(1.0, 0.5)).x() + 50.0) << scene::NameOf(mirror);
    for (const double u : {0.0, 1.0}) {
      for (const double v : {0.0, 1.0}) {
        const Eigen::Vector2d at = place(OnSign(u, v));
        ASSERT_TRUE(at.x() > box.left * kWidth && at.x() < box.right * kWidth && at.y() > (1.0 - box.high) * kHeight &&
                    at.y() < (1.0 - box.low) * kHeight)
            << scene::NameOf(mirror) << " does not show all of it: " << at.transpose();
      }
    }
    EXPECT_GT(Likeness(image, false, place), 0.75) << scene::NameOf(mirror);
    // Letters that were not reversed would stand the other way round at the same place.
    EXPECT_LT(Likeness(image, true, place), 0.5) << scene::NameOf(mirror);
  }
}

}  // namespace
}  // namespace rodeira::nodes
