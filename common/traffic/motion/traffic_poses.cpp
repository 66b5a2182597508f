// SPDX-License-Identifier: Apache-2.0
// Where agents are in the world.
#include <algorithm>
#include <cmath>

#include "common/core/geometry/angle.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kBrakeLights_mps2 = -0.6;  // slowing down harder than by lifting the foot
constexpr double kStopping_mps = 0.1;       // … or less at the end of a stop, and while it stands

}  // namespace

driver::Footprint FootprintOf(const AgentPose& pose, const AgentTraits& traits) {
  const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
  return {pose.id,        pose.p_WB_W.x(), pose.p_WB_W.y(), std::atan2(forward.y(), forward.x()),
          pose.speed_mps, traits.length_m, traits.width_m};
}

namespace {

// Looking the way from its rear axle to its front one, leaning as the surface does across.
Eigen::Quaterniond AttitudeAlong(const Eigen::Vector3d& along_W, const Eigen::Vector2d& ahead_W, double bank) {
  const Eigen::Vector3d across(-ahead_W.y(), ahead_W.x(), bank);
  Eigen::Matrix3d axes;
  axes.col(0) = along_W.normalized();
  axes.col(2) = axes.col(0).cross(across).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return Eigen::Quaterniond(axes).normalized();
}

}  // namespace

Eigen::Quaterniond AttitudeOn(const lanes::Curve::Straight& straight) {
  return AttitudeAlong(straight.along_W, straight.along_W.head<2>(), straight.bank);
}

double GradeOf(const Eigen::Quaterniond& q_WB) {
  const Eigen::Vector3d ahead_W = q_WB * Eigen::Vector3d::UnitX();
  return ahead_W.z() / std::max(1e-3, std::hypot(ahead_W.x(), ahead_W.y()));
}

// The straight on which all of it is, beside no line; null where there is none, or where its surface twists.
const lanes::Curve::Straight* TrafficModel::StraightBelow(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const Piece& piece = agent.path.front();
  if (agent.path.size() != 1 || piece.offset_m != 0.0 || piece.slope != 0.0 || piece.aside_m != 0.0) return nullptr;
  const auto& straight = below_[id].track == piece.track ? below_[id].straight : graph()[piece.track].curve.straight();
  return straight ? &*straight : nullptr;
}

// The axles' middles stand on the path, on the road's surface; the lean across is that of the surface.
AgentPose TrafficModel::PoseOf(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const AgentTraits& traits = traits_[id];
  const Below& below = below_[id];
  AgentPose pose;
  pose.id = id;
  pose.trip = agent.trip;
  if (const lanes::Curve::Straight* straight = StraightBelow(id); straight != nullptr && straight->bank_1pm == 0.0) {
    const Piece& piece = agent.path.front();
    pose.p_WB_W = straight->p_W + (agent.o_m - piece.zero_m) * straight->along_W;
    pose.q_WB = below.track == piece.track ? *below.turned : AttitudeOn(*straight);
  } else {
    const PathFrame at = FrameOf(id, agent.o_m);
    const double half_base = HalfBase(id);
    const Eigen::Vector3d front = FrameOf(id, agent.o_m + half_base).p_W;
    const Eigen::Vector3d rear = FrameOf(id, agent.o_m - half_base).p_W;
    pose.p_WB_W = 0.5 * (front + rear);
    pose.q_WB = AttitudeAlong(front - rear, at.ahead_W, at.bank);
    pose.steer_rad = std::atan(traits.wheelbase_m * at.curvature_1pm);
  }
  pose.speed_mps = agent.speed_mps;
  pose.acceleration_mps2 = agent.acceleration_mps2;
  pose.wheel_spin_rad = geometry::WrapAngle(agent.driven_m / traits.wheel_radius_m);
  pose.braking = agent.acceleration_mps2 < kBrakeLights_mps2 ||
                 (agent.speed_mps < kStopping_mps && agent.acceleration_mps2 <= 0.0 && agent.driving.brake > 0.0);
  if (full_) full_->Tell(id, pose);
  const std::uint32_t on = PieceAt(agent.path, agent.o_m).track;
  if (below.track == on) {
    pose.road = below.road, pose.lane = below.lane;
    return pose;
  }
  const lanes::Track& track = graph()[on];
  pose.road = static_cast<std::int32_t>(track.lane.road);
  pose.lane = track.lane.lane;
  return pose;
}

void TrafficModel::FindPoses() {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    if (is_moved_[id] != 0 || agents_[id].on_road || agents_[id].is_struck) ids.push_back(id);
  }
  poses_.resize(ids.size());
  const auto some = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_moved_[ids[i]] != 0) {  // nothing of the agent itself is read
        poses_[i] = moved_[ids[i]];
        continue;
      }
      poses_[i] = agents_[ids[i]].on_road ? PoseOf(ids[i]) : PoseOfStruck(ids[i]);
      agents_[ids[i]].grade = GradeOf(poses_[i].q_WB);
    }
  };
  base::ParallelFor(pool_.get(), ids.size(), some);
}

}  // namespace rodeira::traffic
