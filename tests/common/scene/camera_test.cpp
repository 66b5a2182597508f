#include "common/scene/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/common/scene/worlds.hpp"

namespace rodeira::scene {
namespace {

TEST(Camera, ProjectsAsAPinholeDoes) {
  Camera camera;
  camera.eye_W = {10.0, 20.0, 5.0};
  camera.vertical_view_rad = 2.0 * std::atan(0.5);  // the upper edge is half as high as the distance
  const auto middle = camera.Project({15.0, 20.0, 5.0}, 800, 600);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x(), 400.0, 1e-9);
  EXPECT_NEAR(middle->y(), 300.0, 1e-9);
  const auto top = camera.Project({20.0, 20.0, 10.0}, 800, 600);  // 10 m ahead, 5 m up
  ASSERT_TRUE(top);
  EXPECT_NEAR(top->y(), 0.0, 1e-9);
  const auto left = camera.Project({20.0, 25.0, 5.0}, 800, 600);  // y is to the left of x
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->x(), 100.0, 1e-9);
  EXPECT_FALSE(camera.Project({9.0, 20.0, 5.0}, 800, 600));
}

TEST(Camera, ChasesFromBehindAndAboveTheGround) {
  const auto world = N222();
  for (double s = 0.0; s < world->roads()[0].length_m(); s += 37.0) {
    const road::RoadFrame frame = world->roads()[0].Evaluate(s);
    CarPose car;
    car.p_WB_W = frame.p_W;
    car.q_WB = Attitude(frame.heading_rad, -std::atan(frame.grade), 0.1);
    const Camera camera = ChaseCamera(car, *world);
    EXPECT_LT((camera.eye_W - car.p_WB_W).dot(car.q_WB * Eigen::Vector3d::UnitX()), -5.0);
    EXPECT_GE(camera.eye_W.z(), world->At(camera.eye_W.x(), camera.eye_W.y()).z_m + 0.89);
    EXPECT_NEAR(camera.forward_W.norm(), 1.0, 1e-12);
    EXPECT_NEAR(camera.forward_W.dot(camera.up_W), 0.0, 1e-12);
    EXPECT_NEAR(camera.forward_W.cross(camera.up_W).z(), 0.0, 1e-12) << "the horizon is level although the car rolls";
    const auto at = camera.Project(car.p_WB_W + Eigen::Vector3d(0.0, 0.0, 0.7), 1280, 720);
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->x(), 640.0, 1.0);
    EXPECT_GT(at->y(), 360.0);
    EXPECT_LT(at->y(), 720.0);
  }
}

TEST(Camera, TheDriverSitsOnTheLeftAndRollsWithTheCar) {
  CarPose car;
  car.q_WB = Attitude(0.5, 0.0, 0.2);
  car.p_WB_W = {100.0, 50.0, 7.0};
  const Camera camera = DriverCamera(car);
  const Eigen::Vector3d eye_B = car.q_WB.conjugate() * (camera.eye_W - car.p_WB_W);
  EXPECT_GT(eye_B.y(), 0.2);
  EXPECT_NEAR(eye_B.z(), 1.20, 1e-9);
  EXPECT_NEAR((car.q_WB.conjugate() * camera.up_W).y(), 0.0, 1e-12);
}

}  // namespace
}  // namespace rodeira::scene
