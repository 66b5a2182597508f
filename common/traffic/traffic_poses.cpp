// Where agents are in the world; saving and restoring them.
#include <cmath>

#include "common/geometry/angle.hpp"
#include "common/traffic/traffic_model.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kBrakeLights_mps2 = -0.6;  // slowing down harder than by lifting the foot

}  // namespace

driver::Footprint FootprintOf(const AgentPose& pose, const AgentTraits& traits) {
  const Eigen::Vector3d forward = pose.q_WB * Eigen::Vector3d::UnitX();
  return {pose.id, pose.p_WB_W.x(), pose.p_WB_W.y(), std::atan2(forward.y(), forward.x()), pose.speed_mps, traits.length_m, traits.width_m};
}

// The axles' middles stand on the lane's middle, on the road's surface; the lean across is that of the surface.
AgentPose TrafficModel::PoseOf(std::uint32_t id) const {
  const Agent& agent = agents_[id];
  const AgentTraits& traits = traits_[id];
  const Lane& lane = lanes_[static_cast<std::size_t>(agent.lane)];
  const driver::LanePath& path = lane.path;
  const Eigen::Vector3d front = path.Position(agent.d_m + 0.5 * traits.wheelbase_m, 0.0);
  const Eigen::Vector3d rear = path.Position(agent.d_m - 0.5 * traits.wheelbase_m, 0.0);
  const Eigen::Vector3d across = path.Position(agent.d_m, 0.4 * traits.width_m) - path.Position(agent.d_m, -0.4 * traits.width_m);
  AgentPose pose;
  pose.id = id;
  pose.trip = agent.trip;
  pose.p_WB_W = 0.5 * (front + rear);
  Eigen::Matrix3d axes;
  axes.col(0) = (front - rear).normalized();
  axes.col(2) = axes.col(0).cross(across).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  pose.q_WB = Eigen::Quaterniond(axes).normalized();
  pose.speed_mps = agent.speed_mps;
  pose.acceleration_mps2 = agent.acceleration_mps2;
  pose.steer_rad = std::atan(traits.wheelbase_m * path.At(agent.d_m).curvature_1pm);
  pose.wheel_spin_rad = geometry::WrapAngle(agent.driven_m / traits.wheel_radius_m);
  pose.braking = agent.acceleration_mps2 < kBrakeLights_mps2;
  pose.road = lane.road;
  pose.lane = path.lane().id;
  return pose;
}

void TrafficModel::FindPoses() {
  poses_.clear();
  for (std::uint32_t id = 0; id < agents_.size(); ++id) {
    if (agents_[id].on_road) poses_.push_back(PoseOf(id));
  }
}

void TrafficModel::Save(base::StateWriter& writer) const {
  for (const Agent& agent : agents_) {
    writer.Put("lane", agent.lane);
    writer.Put("on_road", agent.on_road);
    writer.Put("d_m", agent.d_m);
    writer.Put("speed_mps", agent.speed_mps);
    writer.Put("acceleration_mps2", agent.acceleration_mps2);
    writer.Put("driven_m", agent.driven_m);
    writer.Put("trip", agent.trip);
    writer.Put("brake_mps2", agent.brake_mps2);
    writer.Put("cap_mps", agent.cap_mps);
  }
  for (const Lane& lane : lanes_) {
    writer.Put("order", lane.order);
    writer.Put("waiting", lane.waiting);
  }
}

void TrafficModel::Restore(base::StateReader& reader) {
  for (Agent& agent : agents_) {
    reader.Get("lane", agent.lane);
    reader.Get("on_road", agent.on_road);
    reader.Get("d_m", agent.d_m);
    reader.Get("speed_mps", agent.speed_mps);
    reader.Get("acceleration_mps2", agent.acceleration_mps2);
    reader.Get("driven_m", agent.driven_m);
    reader.Get("trip", agent.trip);
    reader.Get("brake_mps2", agent.brake_mps2);
    reader.Get("cap_mps", agent.cap_mps);
  }
  for (Lane& lane : lanes_) {
    reader.Get("order", lane.order);
    reader.Get("waiting", lane.waiting);
  }
  // A snapshot comes from outside: whatever it says, nothing is read beside the arrays.
  for (Agent& agent : agents_) {
    if (agent.lane < 0 || static_cast<std::size_t>(agent.lane) >= lanes_.size()) agent = Agent();
  }
  const auto unknown = [&](std::uint32_t id) { return id >= agents_.size(); };
  for (Lane& lane : lanes_) {
    std::erase_if(lane.order, unknown);
    std::erase_if(lane.waiting, unknown);
  }
  FindPoses();
}

}  // namespace rodeira::traffic
