// SPDX-License-Identifier: Apache-2.0
#include "common/analysis/measures/sample_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace rodeira::measures {
namespace {

void PutNear(const Near& near, std::size_t k, Neighbour& into) {
  if (near.vehicle == nullptr) return;
  into.id[k] = static_cast<double>(near.vehicle->id);
  into.gap_m[k] = near.gap_m;
  into.speed_mps[k] = near.vehicle->speed_mps;
  into.length_m[k] = near.vehicle->length_m;
}

}  // namespace

AlongBody AlongBodyOf(double qw, double qx, double qy, double qz, double vx_mps, double vy_mps, double vz_mps) {
  const double ax = 1.0 - 2.0 * (qy * qy + qz * qz), ay = 2.0 * (qx * qy + qw * qz), az = 2.0 * (qx * qz - qw * qy);
  return {std::atan2(ay, ax), vx_mps * ax + vy_mps * ay + vz_mps * az};
}

void PutSubject(const SubjectSample& sample, std::size_t k, Drive& drive) {
  drive.x_m[k] = sample.x_m;
  drive.y_m[k] = sample.y_m;
  drive.z_m[k] = sample.z_m;
  drive.heading_rad[k] = sample.heading_rad;
  drive.speed_mps[k] = sample.speed_mps;
  drive.yaw_radps[k] = sample.yaw_radps;
  drive.throttle[k] = sample.throttle;
  drive.brake[k] = sample.brake;
  drive.steering_wheel_deg[k] = sample.steering_wheel_deg;
  drive.indicator[k] = sample.indicator;
  drive.fuel_used_kg[k] = sample.fuel_used_kg;
}

void PutPlace(const LanePlace& place, std::size_t k, Drive& drive) {
  drive.road[k] = static_cast<double>(place.lane.road);
  drive.lane[k] = place.lane.lane;
  drive.s_m[k] = place.s_m;
  drive.t_m[k] = place.t_m;
  drive.junction[k] = place.junction ? 1.0 : 0.0;
  drive.speed_limit_mps[k] = place.speed_limit_mps.value_or(kMissing);
  if (place.junction) return;  // several lanes lie over one another there
  drive.lane_width_m[k] = place.width_m;
  drive.lane_position_m[k] = place.position_m;
  drive.heading_error_rad[k] = place.heading_error_rad;
  drive.lane_curvature_1pm[k] = place.curvature_1pm;
  const double sine = std::sin(place.heading_error_rad), cosine = std::cos(place.heading_error_rad);
  const double front = drive.front_m * sine, rear = (drive.front_m - drive.length_m) * sine;
  const double half = 0.5 * drive.width_m * std::abs(cosine);
  drive.left_line_m[k] = 0.5 * place.width_m - (place.position_m + std::max(front, rear) + half);
  drive.right_line_m[k] = 0.5 * place.width_m + (place.position_m + std::min(front, rear) - half);
}

void PutNeighbours(const lanes::Graph& graph, LeaderFinder& finder, std::uint32_t track, double along_m,
                   std::span<const OtherVehicle> others, std::span<const std::uint32_t> later,
                   std::span<const std::uint32_t> earlier, std::size_t k, Drive& drive) {
  // Only those that may be near are looked up.
  std::vector<OtherVehicle> close;
  for (const OtherVehicle& other : others) {
    if (std::hypot(other.x_m - drive.x_m[k], other.y_m - drive.y_m[k]) < kNeighbourReach_m) close.push_back(other);
  }
  finder.SetOthers(close);
  const double front = drive.front_m, rear = drive.length_m - drive.front_m;
  const NearBoth near = finder.Find(track, along_m, front, rear, later, earlier);
  PutNear(near.ahead, k, drive.leader);
  PutNear(near.behind, k, drive.follower);
  const auto beside = [&](const std::optional<std::uint32_t>& next_lane, Neighbour& ahead, Neighbour& behind) {
    if (!next_lane) return;
    const double along = graph.Across(track, along_m, *next_lane);
    const NearBoth both = finder.Find(*next_lane, along, front, rear, later, earlier);
    PutNear(both.ahead, k, ahead);
    PutNear(both.behind, k, behind);
  };
  beside(graph[track].left, drive.left_leader, drive.left_follower);
  beside(graph[track].right, drive.right_leader, drive.right_follower);
}

}  // namespace rodeira::measures
