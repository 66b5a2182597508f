// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/check/road_check.hpp"

#include <cmath>

namespace rodeira::traffic {
namespace {

constexpr double kOffLaneTolerance_m = 1e-3;
constexpr double kWidest_m = 4.0;  // from a lane's middle to its edge
constexpr double kHalfTyre_m = 0.1;

}  // namespace

RoadCheck::RoadCheck(const lanes::Graph& graph, std::size_t vehicles)
    : graph_(graph), corridors_(graph), gaps_(graph), known_(vehicles) {}

// On the lane of a corridor or of one around it; then `corridor` becomes that one.
bool RoadCheck::IsOnLane(const Eigen::Vector3d& p_W, std::uint32_t& corridor) {
  if (corridor != Corridors::kNone) {
    if (corridors_[corridor].Holds(p_W)) return true;
    for (const std::uint32_t other : corridors_.Around(corridor)) {
      if (!corridors_[other].Holds(p_W)) continue;
      corridor = other;
      return true;
    }
  }
  const std::uint32_t nearest = Nearest(p_W);
  if (nearest == Corridors::kNone || !corridors_[nearest].Holds(p_W)) return false;
  corridor = nearest;
  return true;
}

bool RoadCheck::IsInOne(const Eigen::Vector3d& p_W, std::uint32_t corridor) {
  if (corridor == Corridors::kNone) return false;
  for (const std::uint32_t other : corridors_.Around(corridor)) {
    if (corridors_[other].Holds(p_W)) return true;
  }
  return false;
}

// That of the lane on this level with the nearest middle.
std::uint32_t RoadCheck::Nearest(const Eigen::Vector3d& p_W) {
  double least_m = kWidest_m;
  std::uint32_t nearest = Corridors::kNone;
  for (const lanes::Graph::Beside& beside : graph_.TracksAt(p_W.head<2>(), kWidest_m)) {
    const double off = std::fabs(beside.foot.offset_m);
    if (off >= least_m) continue;
    if (std::fabs(graph_[beside.track].curve.At(beside.foot.d_m).p_W.z() - p_W.z()) > network::Network::kLevel_m)
      continue;
    least_m = off;
    nearest = corridors_.At(beside.track, beside.foot.d_m);
  }
  return nearest;
}

std::optional<double> RoadCheck::BesideLanes(const Eigen::Vector3d& p_W) {
  const auto place = graph_.network().Locate(p_W.x(), p_W.y(), p_W.z(), &hint_);
  const network::Lane* lane = place ? graph_.network().Find(place->lane) : nullptr;
  if (lane != nullptr && place->distance_m <= kOffLaneTolerance_m && network::IsDrivable(lane->type))
    return std::nullopt;
  if (gaps_.Holds(p_W)) return std::nullopt;
  return place ? place->distance_m : -1.0;
}

// On a drivable lane or a shoulder, or between linked lanes; where roads lie over one another, of any of them.
bool RoadCheck::IsForVehicles(const Eigen::Vector3d& p_W) {
  const auto place = graph_.network().Locate(p_W.x(), p_W.y(), p_W.z(), &hint_);
  const network::Lane* lane = place ? graph_.network().Find(place->lane) : nullptr;
  if (lane != nullptr && place->distance_m <= kOffLaneTolerance_m &&
      (network::IsDrivable(lane->type) || lane->type == network::LaneType::kShoulder))
    return true;
  for (const lanes::Graph::Beside& beside : graph_.TracksAt(p_W.head<2>(), kWidest_m)) {
    const lanes::Curve& curve = graph_[beside.track].curve;
    if (std::fabs(beside.foot.offset_m) <= 0.5 * curve.WidthAt(beside.foot.d_m) + kOffLaneTolerance_m &&
        std::fabs(curve.At(beside.foot.d_m).p_W.z() - p_W.z()) < network::Network::kLevel_m)
      return true;
  }
  return gaps_.Holds(p_W);
}

// Most vehicles are in one corridor as a whole. Of the others axle by axle and wheel by wheel; only what no corridor
// holds is looked for in the network.
RoadCheck::Finding RoadCheck::Find(const AgentPose& pose, const BodySize& body) {
  const double w = pose.q_WB.w(), x = pose.q_WB.x(), y = pose.q_WB.y(), z = pose.q_WB.z();
  const Eigen::Vector3d ahead_W(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
      left_W(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x));
  const double half_base = 0.5 * body.wheelbase_m, half_track = 0.5 * body.width_m - kHalfTyre_m;
  Known& known = known_[pose.id];
  if (known.middle != Corridors::kNone &&
      corridors_[known.middle].HoldsAll(pose.p_WB_W, ahead_W, left_W, half_base, half_track)) {
    known.rear = known.front = known.middle;
    return {};
  }
  if (known.middle != Corridors::kNone) {
    for (const std::uint32_t other : corridors_.Around(known.middle)) {
      if (!corridors_[other].HoldsAll(pose.p_WB_W, ahead_W, left_W, half_base, half_track)) continue;
      known.rear = known.middle = known.front = other;
      return {};
    }
  }
  Finding found;
  if (!IsOnLane(pose.p_WB_W, known.middle)) found.beside_m = BesideLanes(pose.p_WB_W);
  if (known.middle != Corridors::kNone &&
      corridors_[known.middle].HoldsAll(pose.p_WB_W, ahead_W, left_W, half_base, half_track)) {
    known.rear = known.front = known.middle;
    return found;
  }
  for (const double along : {-0.5, 0.5}) {
    std::uint32_t& axle = along < 0.0 ? known.rear : known.front;
    const Eigen::Vector3d axle_W = pose.p_WB_W + along * body.wheelbase_m * ahead_W;
    IsOnLane(axle_W, axle);
    if (axle != Corridors::kNone && corridors_[axle].HoldsAll(axle_W, ahead_W, left_W, 0.0, half_track)) continue;
    for (const double aside : {-1.0, 1.0}) {
      const Eigen::Vector3d wheel_W = axle_W + aside * half_track * left_W;
      if (!IsInOne(wheel_W, axle) && !IsForVehicles(wheel_W)) found.wheels_W.push_back(wheel_W);
    }
  }
  return found;
}

}  // namespace rodeira::traffic
