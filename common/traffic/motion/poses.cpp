// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/motion/poses.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "common/core/geometry/angle.hpp"
#include "common/traffic/state/vehicle_way.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kBrakeLights_mps2 = -0.6;  // slowing down harder than by lifting the foot
constexpr double kStopping_mps = 0.1;       // … or less at the end of a stop, and while it stands

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

driver::Footprint FootprintOf(const AgentPose& pose, const AgentTraits& traits) {
  const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
  return {pose.id,        pose.p_WB_W.x(), pose.p_WB_W.y(), std::atan2(forward.y(), forward.x()),
          pose.speed_mps, traits.length_m, traits.width_m};
}

Eigen::Quaterniond AttitudeOn(const lanes::Curve::Straight& straight) {
  return AttitudeAlong(straight.along_W, straight.along_W.head<2>(), straight.bank);
}

double GradeOf(const Eigen::Quaterniond& q_WB) {
  const Eigen::Vector3d ahead_W = q_WB * Eigen::Vector3d::UnitX();
  return ahead_W.z() / std::max(1e-3, std::hypot(ahead_W.x(), ahead_W.y()));
}

AgentPose Poses::PoseOf(std::uint32_t id) const {
  const Agent& agent = out_.agents[id];
  const AgentTraits& traits = in_.traits[id];
  const CurrentTrackCache& below = in_.below[id];
  AgentPose pose;
  pose.id = id;
  pose.trip = agent.trip;
  if (const lanes::Curve::Straight* straight = in_.tracks.StraightBelow(id);
      straight != nullptr && straight->bank_1pm == 0.0) {
    const Piece& piece = agent.path.front();
    pose.p_WB_W = straight->p_W + (agent.o_m - piece.zero_m) * straight->along_W;
    pose.q_WB = below.track == piece.track ? *below.turned : AttitudeOn(*straight);
  } else {
    const PathFrame at = in_.tracks.FrameOf(id, agent.o_m);
    const double half_base = HalfBase(in_.traits[id]);
    const Eigen::Vector3d front = in_.tracks.FrameOf(id, agent.o_m + half_base).p_W;
    const Eigen::Vector3d rear = in_.tracks.FrameOf(id, agent.o_m - half_base).p_W;
    pose.p_WB_W = 0.5 * (front + rear);
    pose.q_WB = AttitudeAlong(front - rear, at.ahead_W, at.bank);
    pose.steer_rad = std::atan(traits.wheelbase_m * at.curvature_1pm);
  }
  pose.speed_mps = agent.speed_mps;
  pose.acceleration_mps2 = agent.acceleration_mps2;
  pose.wheel_spin_rad = geometry::WrapAngle(agent.driven_m / traits.wheel_radius_m);
  pose.braking = agent.acceleration_mps2 < kBrakeLights_mps2 ||
                 (agent.speed_mps < kStopping_mps && agent.acceleration_mps2 <= 0.0 && agent.driving.brake > 0.0);
  if (in_.full) in_.full->Tell(id, pose);
  const std::uint32_t on = PieceAt(agent.path, agent.o_m).track;
  if (below.track == on) {
    pose.road = below.road, pose.lane = below.lane;
    return pose;
  }
  const lanes::Track& track = in_.map.graph[on];
  pose.road = static_cast<std::int32_t>(track.lane.road);
  pose.lane = track.lane.lane;
  return pose;
}

AgentPose Poses::PoseOfCrashed(std::uint32_t id) const {
  const Agent& agent = out_.agents[id];
  AgentPose pose;
  pose.id = id;
  pose.trip = agent.trip;
  pose.p_WB_W = {agent.crashed.p_W.x(), agent.crashed.p_W.y(), agent.crashed_z_m};
  pose.q_WB = Eigen::AngleAxisd(agent.crashed.heading_rad, Eigen::Vector3d::UnitZ());
  pose.speed_mps = agent.speed_mps;
  pose.acceleration_mps2 = agent.acceleration_mps2;
  pose.braking = true;
  return pose;
}

void Poses::FindPoses() {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < out_.agents.size(); ++id) {
    if (in_.is_moved[id] != 0 || out_.agents[id].on_road || out_.agents[id].is_crashed) ids.push_back(id);
  }
  out_.poses.resize(ids.size());
  const auto some = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (in_.is_moved[ids[i]] != 0) {  // nothing of the agent itself is read
        out_.poses[i] = in_.moved[ids[i]];
        continue;
      }
      out_.poses[i] = out_.agents[ids[i]].on_road ? PoseOf(ids[i]) : PoseOfCrashed(ids[i]);
      out_.agents[ids[i]].grade = GradeOf(out_.poses[i].q_WB);
    }
  };
  base::ParallelFor(in_.pool, ids.size(), some);
}

}  // namespace rodeira::traffic
