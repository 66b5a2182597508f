// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "common/view/scene/camera/pick.hpp"
#include "tests/common/view/scene/worlds.hpp"

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
  for (double s = 0.0; s < N222Road().length_m(); s += 37.0) {
    const road::RoadFrame frame = N222Road().Evaluate(s);
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

AgentPose LorryBehind(const CarPose& car, double gap_m, double left_m) {
  AgentPose lorry;
  lorry.length_m = 9.0;
  lorry.width_m = 2.5;
  lorry.height_m = 3.6;
  const double behind_m = (car.length_m - car.front_m) + gap_m + 0.5 * lorry.length_m;
  lorry.p_WB_W = car.p_WB_W + car.q_WB * Eigen::Vector3d(-behind_m, left_m, 0.0);
  lorry.q_WB = car.q_WB;
  return lorry;
}

// However near a lorry comes from behind, and from whichever side: the eye is not in it, sees its own car, and does not
// leap.
TEST(Camera, ALorryCloseBehindIsNotWhereTheEyeIs) {
  const auto world = PlaneWithRoad();
  SceneSnapshot moment;
  moment.cars.emplace_back();
  CarPose& car = moment.cars[0];
  car.p_WB_W = {60.0, 0.0, world->At(60.0, 0.0).z_m};
  car.q_WB = Attitude(0.4, 0.0, 0.0);
  moment.agents.emplace_back();
  const auto eye = [&](double gap_m, double left_m) {
    moment.agents[0] = LorryBehind(car, gap_m, left_m);
    return MakeCamera(CameraKind::kChase, moment, 0, {}, *world)->eye_W;
  };
  const Eigen::Vector3d alone = ChaseCamera(car, *world).eye_W,
                        roof = car.p_WB_W + Eigen::Vector3d(0.0, 0.0, 0.8 * car.height_m);
  Eigen::Vector3d before = eye(0.5, 0.0);
  for (double gap_m = 0.5; gap_m < 12.0; gap_m += 0.05) {
    const Eigen::Vector3d at = eye(gap_m, 0.0),
                          in_lorry = moment.agents[0].q_WB.conjugate() * (at - moment.agents[0].p_WB_W);
    EXPECT_GT(in_lorry.x(), 0.5 * moment.agents[0].length_m + 0.2) << "before its front, " << gap_m;
    EXPECT_EQ(BodyOn(moment, {at, (roof - at).normalized()}), std::optional<std::size_t>(0)) << gap_m;
    EXPECT_LT((at - before).norm(), 0.08) << gap_m;
    before = at;
    const Camera camera = *MakeCamera(CameraKind::kChase, moment, 0, {}, *world);
    const auto seen = camera.Project(roof, 1280, 720);
    ASSERT_TRUE(seen) << gap_m;
    EXPECT_TRUE(seen->y() > 0.0 && seen->y() < 720.0) << gap_m << ": " << seen->transpose();
  }
  EXPECT_EQ(eye(6.0, 0.0), alone);
  EXPECT_EQ(eye(1.0, 3.5), alone) << "in the lane beside";
  before = eye(1.0, 0.0);
  for (double left_m = 0.0; left_m < 5.0; left_m += 0.02) {
    const Eigen::Vector3d at = eye(1.0, left_m);
    EXPECT_LT((at - before).norm(), 0.15) << left_m;
    before = at;
  }
  moment.agents[0].p_WB_W = car.p_WB_W + car.q_WB * Eigen::Vector3d(-6.0, 0.0, 6.0);
  EXPECT_EQ(MakeCamera(CameraKind::kChase, moment, 0, {}, *world)->eye_W, alone) << "on a bridge above";
  moment.agents[0] = LorryBehind(car, -20.0, 0.0);
  EXPECT_EQ(MakeCamera(CameraKind::kChase, moment, 0, {}, *world)->eye_W, alone) << "it drives ahead";
  moment.agents[0] = LorryBehind(car, 1.5, 0.0);
  moment.agents[0].height_m = 1.5;
  EXPECT_EQ(MakeCamera(CameraKind::kChase, moment, 0, {}, *world)->eye_W, alone)
      << "over an ordinary car it looks away";
  EXPECT_FALSE(MakeCamera(CameraKind::kChase, moment, 2, {}, *world));
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

// In every vehicle of the project, and in lorries: below the roof, and where heads are.
TEST(Camera, TheDriversEyeIsUnderTheRoof) {
  CarPose car;
  for (const auto& [height_m, eye_m] :
       {std::pair(1.15, 0.94), std::pair(1.42, 1.20), std::pair(2.0, 1.20), std::pair(3.4, 2.2)}) {
    car.height_m = height_m;
    EXPECT_NEAR(DriversEye_B(car).z(), eye_m, 1e-9) << height_m;
    EXPECT_LT(DriversEye_B(car).z(), height_m - 0.2);
    EXPECT_NEAR(DriversEye_B(car).x(), height_m < 3.0 ? 0.10 : Body(car).front_m - 1.3, 1e-9) << height_m;
  }
}

TEST(Camera, KindsGoRoundAndHaveNames) {
  CameraKind kind = CameraKind::kChase;
  for (const std::string_view name : CameraNames()) {
    EXPECT_EQ(CameraOf(name), kind) << name;
    kind = NextCamera(kind);
  }
  EXPECT_EQ(kind, CameraKind::kChase);
  EXPECT_FALSE(CameraOf("chaise"));
}

CarPose CarAt(double x_m, double y_m, double z_m, double heading_rad) {
  CarPose car;
  car.p_WB_W = {x_m, y_m, z_m};
  car.q_WB = Attitude(heading_rad, 0.0, 0.0);
  return car;
}

TEST(Camera, OnTheBonnetTheCarIsBehindTheEye) {
  const CarPose car = CarAt(100.0, 50.0, 7.0, 0.5);
  const Eigen::Vector3d eye_B = car.q_WB.conjugate() * (BonnetCamera(car).eye_W - car.p_WB_W);
  EXPECT_GT(eye_B.x(), 0.5);
  EXPECT_LT(eye_B.x(), car.front_m);
  EXPECT_NEAR(eye_B.y(), 0.0, 1e-12);
}

// Parallel rays: a metre is as many pixels wherever it lies, up is north, right is east.
TEST(Camera, TheMapIsToScale) {
  const CarPose car = CarAt(100.0, 50.0, 7.0, 2.5);
  Aim aim;
  aim.map_height_m = 60.0;
  const Camera map = TopCamera(car, aim);
  for (const double above_m : {-3.0, 0.0, 12.0}) {
    const auto at = map.Project(car.p_WB_W + Eigen::Vector3d(10.0, 5.0, above_m), 800, 600);
    ASSERT_TRUE(at);
    EXPECT_NEAR(at->x(), 400.0 + 100.0, 1e-9);
    EXPECT_NEAR(at->y(), 300.0 - 50.0, 1e-9);
  }
}

TEST(Camera, AFreeEyeTurnsAboutTheCarAndStaysOverTheGround) {
  const auto world = PlaneWithRoad();
  const CarPose car = CarAt(60.0, 0.0, world->At(60.0, 0.0).z_m, 0.4);
  Aim aim;
  aim.azimuth_rad = 0.0;
  aim.elevation_rad = 0.5;
  aim.distance_m = 10.0;
  const auto eye_B = [&] {
    return Eigen::Vector3d(car.q_WB.conjugate() * (OrbitCamera(car, aim, *world).eye_W - car.p_WB_W));
  };
  EXPECT_LT((eye_B() - Eigen::Vector3d(-10.0 * std::cos(0.5), 0.0, 0.5 * car.height_m + 10.0 * std::sin(0.5))).norm(),
            1e-9)
      << "behind";
  aim.Turn(0.5 * 3.14159265358979323846, 0.0);
  EXPECT_LT((eye_B() - Eigen::Vector3d(0.0, -10.0 * std::cos(0.5), 0.5 * car.height_m + 10.0 * std::sin(0.5))).norm(),
            1e-9)
      << "over its right side";
  aim.Turn(0.0, -3.0);
  const Camera low = OrbitCamera(car, aim, *world);
  EXPECT_GE(low.eye_W.z(), world->At(low.eye_W.x(), low.eye_W.y()).z_m + 0.89);
  const auto middle = low.Project(car.p_WB_W + Eigen::Vector3d(0.0, 0.0, 0.5 * car.height_m), 800, 600);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(middle->x(), 400.0, 1e-6);
  EXPECT_NEAR(middle->y(), 300.0, 1e-6);
  for (int i = 0; i < 100; ++i) aim.Zoom(1.5);
  EXPECT_EQ(aim.distance_m, 400.0);
  for (int i = 0; i < 100; ++i) aim.Zoom(0.5);
  EXPECT_EQ(aim.distance_m, 2.5);
}

// Along all of N222 a car in its lane is in the middle of the picture, seen from beside the road, never from within 1 m
// of it; the eye stands still for as long as the car is on its part of the road.
TEST(Camera, BesideTheRoadPostsTakeTurns) {
  const auto world = N222();
  const Version1Road& road = N222Road();
  std::vector<Eigen::Vector3d> posts;
  for (double s = 2.0; s < road.length_m(); s += 5.0) {
    const road::RoadFrame frame = road.Evaluate(s);
    CarPose car;
    car.p_WB_W = road.Position(s, -1.6);
    car.q_WB = Attitude(frame.heading_rad, 0.0, 0.0);
    const Camera camera = TracksideCamera(car, *world);
    if (posts.empty() || camera.eye_W != posts.back()) posts.push_back(camera.eye_W);
    const auto place = world->network()->Locate(camera.eye_W.x(), camera.eye_W.y(), camera.eye_W.z());
    ASSERT_TRUE(place);
    EXPECT_GT(std::fabs(place->t_m), 4.0) << s;
    EXPECT_NEAR(camera.eye_W.z(), world->At(camera.eye_W.x(), camera.eye_W.y()).z_m + 1.9, 1e-9) << s;
    const auto at = camera.Project(car.p_WB_W + Eigen::Vector3d(0.0, 0.0, 0.5 * car.height_m), 1280, 720);
    ASSERT_TRUE(at) << s;
    EXPECT_NEAR(at->x(), 640.0, 1e-6) << s;
    EXPECT_NEAR(at->y(), 360.0, 1e-6) << s;
  }
  EXPECT_NEAR(static_cast<double>(posts.size()), road.length_m() / 120.0, 1.0);
}

TEST(Camera, FollowsTheTrafficToo) {
  SceneSnapshot moment;
  moment.cars.push_back(CarAt(0.0, 0.0, 0.0, 0.0));
  AgentPose van;
  van.p_WB_W = {30.0, 4.0, 1.0};
  van.length_m = 5.2;
  moment.agents.push_back(van);
  ASSERT_TRUE(BodyAt(moment, 1));
  EXPECT_EQ(BodyAt(moment, 0)->p_WB_W, moment.cars[0].p_WB_W);
  EXPECT_EQ(BodyAt(moment, 1)->p_WB_W, van.p_WB_W);
  EXPECT_EQ(BodyAt(moment, 1)->front_m, 2.6);
  EXPECT_FALSE(BodyAt(moment, 2));
}

// Straight ahead and as high over as under the eye, a screen shows what a pinhole camera of that angle does.
TEST(Camera, AScreenBeforeTheEyeIsAPinholesPicture) {
  const CarPose car = CarAt(100.0, 50.0, 7.0, 0.5);
  const Camera screen = ScreenCamera(car, {0.8, 0.6, 0.5, 0.0, 0.3, 0.0});
  Camera pinhole = screen;
  pinhole.window.reset();
  pinhole.vertical_view_rad = 2.0 * std::atan(0.3 / 0.5);
  for (const auto& ahead : {Eigen::Vector3d(12.0, 3.0, 1.0), Eigen::Vector3d(5.0, -2.0, 0.0)}) {
    const Eigen::Vector3d p = car.p_WB_W + car.q_WB * ahead;
    EXPECT_LT((*screen.Project(p, 800, 600) - *pinhole.Project(p, 800, 600)).norm(), 1e-9);
  }
}

// Lay a ruler from the eye through a point of the screen: what lies behind is drawn there, wherever the screen stands.
TEST(Camera, WhatIsSeenThroughAScreenLiesOnTheRayThroughIt) {
  const CarPose car = CarAt(-20.0, 5.0, 1.0, 1.2);
  const Eigen::Vector3d eye_B = car.q_WB.conjugate() * (DriverCamera(car).eye_W - car.p_WB_W);
  for (const ScreenPlane& plane :
       {ScreenPlane{1.2, 0.7, 0.9, 0.0, 0.2, 0.1}, ScreenPlane{0.6, 0.34, 0.7, 0.8, 0.17, -0.2},
        ScreenPlane{2.0, 1.5, 1.4, -1.3, 1.0, 0.0}}) {
    const Camera camera = ScreenCamera(car, plane);
    const Eigen::AngleAxisd turn(plane.angle_rad, Eigen::Vector3d::UnitZ());
    for (const double u : {0.0, 0.3, 1.0}) {    // from the screen's left edge
      for (const double v : {0.0, 0.6, 1.0}) {  // from its upper edge
        const Eigen::Vector3d on_screen =
            turn * Eigen::Vector3d(plane.distance_m, -(plane.aside_m + (u - 0.5) * plane.width_m),
                                   (1.0 - v) * plane.height_m - plane.eye_height_m);
        const auto at = camera.Project(car.p_WB_W + car.q_WB * (eye_B + 37.0 * on_screen), 1600, 900);
        ASSERT_TRUE(at);
        EXPECT_NEAR(at->x(), 1600.0 * u, 1e-6);
        EXPECT_NEAR(at->y(), 900.0 * v, 1e-6);
      }
    }
  }
}

// Three screens with edges that touch: what is cut by the seam leaves one where it enters the other.
TEST(Camera, ThreeScreensHaveNoSeam) {
  const CarPose car = CarAt(0.0, 0.0, 0.0, 0.3);
  const double width = 1.2, distance = 0.9, angle = 2.0 * std::atan(0.5 * width / distance);
  const Camera left = ScreenCamera(car, {width, 0.7, distance, angle, 0.3, 0.0}),
               middle = ScreenCamera(car, {width, 0.7, distance, 0.0, 0.3, 0.0});
  for (const double away_m : {3.0, 20.0, 400.0}) {
    for (const double up_m : {-0.5, 0.0, 2.0}) {
      const Eigen::Vector3d ray_B(distance, 0.5 * width, 0.0);
      const Eigen::Vector3d p =
          middle.eye_W + car.q_WB * Eigen::Vector3d(away_m * ray_B + Eigen::Vector3d(0.0, 0.0, up_m));
      EXPECT_NEAR(middle.Project(p, 1920, 1080)->x(), 0.0, 1e-6);
      EXPECT_NEAR(left.Project(p, 1920, 1080)->x(), 1920.0, 1e-6);
      EXPECT_NEAR(left.Project(p, 1920, 1080)->y(), middle.Project(p, 1920, 1080)->y(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace rodeira::scene
