// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/camera/pick.hpp"

#include <gtest/gtest.h>

namespace rodeira::scene {
namespace {

constexpr int kWidth = 1280, kHeight = 720;

std::vector<Camera> Cameras(const CarPose& car) {
  ScreenPlane plane;
  plane.angle_rad = 0.3;
  return {DriverCamera(car), BonnetCamera(car), ScreenCamera(car, plane), TopCamera(car, {})};
}

TEST(Pick, TheRayOfAPlaceLeadsThroughWhatIsSeenThere) {
  CarPose car;
  car.p_WB_W = {30.0, -12.0, 4.0};
  car.q_WB = Attitude(0.8, 0.02, 0.01);
  int seen = 0;
  for (const Camera& camera : Cameras(car)) {
    for (const Eigen::Vector3d& p_B :
         {Eigen::Vector3d(12.0, 1.0, 0.5), Eigen::Vector3d(25.0, -3.0, 0.0), Eigen::Vector3d(8.0, 3.0, 1.5)}) {
      const Eigen::Vector3d p_W = car.p_WB_W + car.q_WB * p_B;
      const auto at = camera.Project(p_W, kWidth, kHeight);
      if (!at) continue;
      ++seen;
      const Ray ray = RayAt(camera, *at, kWidth, kHeight);
      const Eigen::Vector3d to = p_W - ray.from_W;
      EXPECT_NEAR((to - to.dot(ray.along_W) * ray.along_W).norm(), 0.0, 1e-9);
      EXPECT_GT(to.dot(ray.along_W), 0.0);
    }
  }
  EXPECT_GT(seen, 2);
}

TEST(Pick, TheFirstCarOnTheRayIsMeant) {
  SceneSnapshot moment;
  moment.cars.emplace_back();  // looks east
  for (const double ahead_m : {40.0, 20.0}) {
    AgentPose agent;
    agent.id = static_cast<std::uint64_t>(ahead_m);
    agent.p_WB_W = {ahead_m, 0.3, 0.0};
    moment.agents.push_back(agent);
  }
  const Camera camera = DriverCamera(moment.cars[0]);
  const auto at = [&](const Eigen::Vector3d& p_W) {
    return BodyOn(moment, RayAt(camera, *camera.Project(p_W, kWidth, kHeight), kWidth, kHeight));
  };
  EXPECT_EQ(BodyOn(moment, RayAt(camera, *camera.Project({20.0, 0.3, 0.7}, kWidth, kHeight), kWidth, kHeight), 0), 2u)
      << "without the car in which the eye is";
  SceneSnapshot traffic = moment;
  traffic.cars.clear();
  const auto among = [&](const Eigen::Vector3d& p_W) {
    return BodyOn(traffic, RayAt(camera, *camera.Project(p_W, kWidth, kHeight), kWidth, kHeight));
  };
  EXPECT_EQ(at({20.0, 0.3, 0.7}), 0u);
  EXPECT_EQ(among({20.0, 0.3, 0.7}), 1u) << "the nearer one, though it comes later";
  traffic.agents.pop_back();
  EXPECT_EQ(among({40.0, 0.3, 0.7}), 0u);
  EXPECT_EQ(among({40.0, 2.5, 0.7}), std::nullopt) << "beside it";
  EXPECT_EQ(among({40.0, 0.3, 2.5}), std::nullopt) << "above it";
}

}  // namespace
}  // namespace rodeira::scene
