// SPDX-License-Identifier: Apache-2.0
#include "common/editor/viewport.hpp"

#include <gtest/gtest.h>

namespace rodeira::editor {
namespace {

TEST(Viewport, NorthIsUpAndBackAgain) {
  Viewport view{{100.0, 50.0}, 0.5, 800.0, 600.0};
  EXPECT_EQ(view.width_m(), 400.0);
  EXPECT_EQ(view.ToPixels({100.0, 50.0}), Eigen::Vector2d(400.0, 300.0));
  EXPECT_EQ(view.ToPixels({100.0, 60.0}), Eigen::Vector2d(400.0, 280.0));
  EXPECT_EQ(view.ToWorld({0.0, 0.0}), Eigen::Vector2d(-100.0, 200.0));
}

TEST(Viewport, TheWheelZoomsAboutThePointer) {
  Viewport view{{3.0, -7.0}, 0.1, 1000.0, 700.0};
  const Eigen::Vector2d pointer(123.0, 456.0), held = view.ToWorld(pointer);
  for (int i = 0; i < 40; ++i) view.Zoom(i % 3 == 0 ? 0.8 : 1.25, pointer);
  EXPECT_LT((view.ToWorld(pointer) - held).norm(), 1e-9);
  EXPECT_NE(view.metres_per_px, 0.1);
  for (int i = 0; i < 400; ++i) view.Zoom(2.0, pointer);
  EXPECT_GT(view.metres_per_px, 0.0);
  EXPECT_TRUE(view.middle_W.allFinite());
}

TEST(Viewport, DraggingHoldsThePlane) {
  Viewport view{{0.0, 0.0}, 0.25, 400.0, 400.0};
  const Eigen::Vector2d held = view.ToWorld({100.0, 100.0});
  view.Drag({30.0, -50.0});
  EXPECT_LT((view.ToWorld({130.0, 50.0}) - held).norm(), 1e-12);
}

TEST(Viewport, EverythingIsShown) {
  Viewport view{{0.0, 0.0}, 1.0, 900.0, 300.0};
  view.Show({-100.0, 20.0}, {300.0, 420.0});
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(-100.0, 20.0), Eigen::Vector2d(300.0, 420.0)}) {
    const Eigen::Array2d px = view.ToPixels(corner);
    EXPECT_TRUE((px >= 0.0).all() && px.x() <= 900.0 && px.y() <= 300.0) << px;
  }
}

}  // namespace
}  // namespace rodeira::editor
