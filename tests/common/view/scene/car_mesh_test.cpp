// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/vehicles/car_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <tuple>

#include "common/view/scene/vehicles/cabin_body.hpp"

namespace rodeira::scene {
namespace {

using Place = std::tuple<long, long, long>;
Place PlaceOf(const Eigen::Vector3f& p) {
  return {std::lround(p.x() * 1e5F), std::lround(p.y() * 1e5F), std::lround(p.z() * 1e5F)};
}

// Every edge is run through once each way: the surface is closed and all its faces look to the same side.
void ExpectClosed(const Mesh& mesh, const char* what) {
  std::map<std::pair<Place, Place>, int> edges;
  double volume = 0.0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Eigen::Vector3f* p[3];
    for (std::size_t k = 0; k < 3; ++k) p[k] = &mesh.positions[mesh.triangles[3 * t + k]];
    for (std::size_t k = 0; k < 3; ++k) ++edges[{PlaceOf(*p[k]), PlaceOf(*p[(k + 1) % 3])}];
    volume += p[0]->cast<double>().dot(p[1]->cast<double>().cross(p[2]->cast<double>())) / 6.0;
  }
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    ASSERT_TRUE(back != edges.end() && back->second == count) << what << " has a hole";
  }
  EXPECT_GT(volume, 0.0) << what << " is turned inside out";
}

CarPose SmallCar() {
  CarPose car;
  for (std::size_t i = 0; i < 4; ++i) car.wheels[i].hub_B = {i < 2 ? 1.23 : -1.23, i % 2 == 0 ? 0.71 : -0.71, 0.2915};
  return car;
}

TEST(CarMesh, EveryPartIsClosedAndLooksOutward) {
  AgentPose van;
  van.length_m = 5.2;
  van.height_m = 2.0;
  van.width_m = 1.95;
  for (const CarShape& shape : {CarShape::Of(SmallCar()), CarShape::Of(AgentPose{}), CarShape::Of(van)}) {
    for (const AgentKind kind : {AgentKind::kCar, AgentKind::kVan, AgentKind::kLorry, AgentKind::kBus}) {
      const CarMeshes car = BuildVehicle(kind, shape, Colour::Of(0x123456));
      for (const Mesh& mesh : car.body) ExpectClosed(mesh, "a part of the body");
      for (const Mesh& mesh : car.frame) ExpectClosed(mesh, "a post or a mirror");
      ExpectClosed(car.lamps, "the lamps");
      for (const Mesh& mesh : car.wheel) ExpectClosed(mesh, "a part of the wheel");
    }
  }
}

TEST(CarMesh, TheInsideIsClosedToo) {
  ExpectClosed(BuildCabinBody({}), "the cabin");
  ExpectClosed(BuildCabinBody({1.9, 1.9, 0.42, 1.20}), "the cabin of a van");
}

// Whichever picture comes first: how far the springs give there is no part of the car.
TEST(CarMesh, IsBuiltTheSameWhereverItsWheelsAre) {
  CarPose bumping = SmallCar();
  for (WheelPose& wheel : bumping.wheels) wheel.hub_B += Eigen::Vector3d(0.01, 0.02, 0.05);
  const CarShape rest = CarShape::Of(SmallCar()), other = CarShape::Of(bumping);
  EXPECT_EQ(rest.wheel_radius_m, other.wheel_radius_m);
  EXPECT_EQ(rest.tread_out_m, other.tread_out_m);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rest.hubs_B[i], other.hubs_B[i]);
    EXPECT_LT((rest.hubs_B[i] - SmallCar().wheels[i].hub_B).norm(), 1e-12);
  }
}

TEST(CarMesh, HasTheCarsMeasures) {
  const CarShape shape = CarShape::Of(SmallCar());
  const CarMeshes car = BuildCar(shape, Colour::Of(0x123456));
  Eigen::AlignedBox3f box;
  bool painted = false;
  for (const Mesh& mesh : car.body) {
    for (const Eigen::Vector3f& p : mesh.positions) box.extend(p);
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    for (const Eigen::Vector3f& n : mesh.normals) ASSERT_NEAR(n.norm(), 1.0F, 1e-5F);
    painted = painted || (mesh.material == Material::kCarPaint && mesh.colours[0] == Colour::Of(0x123456));
  }
  EXPECT_TRUE(painted);
  EXPECT_NEAR(box.max().y(), 0.5 * 1.65, 0.01) << "the wheel arches stand out a little";
  for (const Mesh& mesh : car.frame) {
    for (const Eigen::Vector3f& p : mesh.positions) box.extend(p);
  }
  EXPECT_NEAR(box.max().x(), 2.01, 0.03);
  EXPECT_NEAR(box.min().x(), 2.01 - 3.85, 0.03);
  EXPECT_NEAR(box.max().z(), 1.42, 0.01);
  EXPECT_GT(box.min().z(), -0.06) << "nothing far below the road";
  EXPECT_NEAR(box.max().y(), 0.5 * 1.65, 0.12) << "the mirrors stand out";
  EXPECT_FLOAT_EQ(box.max().y(), -box.min().y());
  Eigen::AlignedBox3f wheel;
  for (const Mesh& mesh : car.wheel) {
    for (const Eigen::Vector3f& p : mesh.positions) wheel.extend(p);
  }
  EXPECT_NEAR(wheel.min().z(), -0.2915, 1e-4) << "the tyre stands on the ground";
}

}  // namespace
}  // namespace rodeira::scene
