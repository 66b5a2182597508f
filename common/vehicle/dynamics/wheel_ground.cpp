// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/dynamics/wheel_ground.hpp"

#include <span>

namespace rodeira::dynamics {

void WheelGround::Save(base::StateWriter& writer) const {
  writer.Put("plane_W", std::span<const double>(plane_W.data(), 3));
  writer.Put("normal_W", std::span<const double>(normal_W.data(), 3));
  writer.Put("friction", friction);
  writer.Put("surface", surface);
  writer.Put("inside", inside);
  if (!edge) return;
  writer.Put("edge_W", std::span<const double>(edge->point_W.data(), 3));
  writer.Put("edge_ahead_W", std::span<const double>(edge->ahead_W.data(), 3));
  writer.Put("edge_rises", edge->rises);
}

void WheelGround::Restore(base::StateReader& reader) {
  reader.Get("plane_W", std::span<double>(plane_W.data(), 3));
  reader.Get("normal_W", std::span<double>(normal_W.data(), 3));
  reader.Get("friction", friction);
  reader.Get("surface", surface);
  reader.Get("inside", inside);
  edge.reset();
  if (!reader.Has("edge_W")) return;
  edge.emplace();
  reader.Get("edge_W", std::span<double>(edge->point_W.data(), 3));
  reader.Get("edge_ahead_W", std::span<double>(edge->ahead_W.data(), 3));
  reader.Get("edge_rises", edge->rises);
}

void WheelGround::Update(const ground::GroundQuery& query, const ground::GroundPoint& point) {
  inside = point.inside;
  surface = point.surface;
  if (!inside) return;
  edge.reset();
  plane_W = {query.x_m, query.y_m, point.z_m};
  normal_W = point.normal_W;
  friction = point.friction;
}

void QueryGround(ground::Ground& ground, const std::array<Eigen::Vector3d, kWheels>& hubs_W,
                 const std::array<WheelGround*, kWheels>& wheels) {
  std::array<ground::GroundQuery, kWheels> queries;
  std::array<ground::GroundPoint, kWheels> points;
  for (std::size_t i = 0; i < kWheels; ++i) queries[i] = {hubs_W[i].x(), hubs_W[i].y(), hubs_W[i].z()};
  ground.Query(queries, points);
  for (std::size_t i = 0; i < kWheels; ++i) wheels[i]->Update(queries[i], points[i]);
}

Plane GroundPlane(const std::array<const WheelGround*, kWheels>& wheels) {
  const Eigen::Vector3d rising = wheels[kFrontLeft]->plane_W - wheels[kRearRight]->plane_W;
  const Eigen::Vector3d falling = wheels[kFrontRight]->plane_W - wheels[kRearLeft]->plane_W;
  Eigen::Vector3d normal = falling.cross(rising);
  if (normal.z() < 0.0) normal = -normal;  // the car lies on its roof
  Plane plane;
  if (normal.norm() > 1e-3 && normal.z() > 0.3 * normal.norm()) plane.normal_W = normal.normalized();
  for (const WheelGround* wheel : wheels) plane.point_W += 0.25 * wheel->plane_W;
  return plane;
}

}  // namespace rodeira::dynamics
