// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/floating_cars.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/traffic/results/names.hpp"
#include "common/world/lanes/floating_car.hpp"

namespace rodeira::traffic {

std::string FloatingCarsAt(double time_s, const TrafficModel& model) {
  std::string text;
  lanes::AppendTimestepBegin(time_s, text);
  const lanes::Graph& graph = model.graph();
  for (const AgentPose& pose : model.poses()) {
    const Agent& agent = model.agent(pose.id);
    std::size_t i = agent.path.size() - 1;
    while (i > 0 && agent.path[i].begin_m > agent.o_m) --i;
    const Eigen::Vector3d ahead = pose.q_WB * Eigen::Vector3d::UnitX();
    const double half = 0.5 * model.traits(pose.id).length_m;
    const Eigen::Vector3d front = pose.p_WB_W + half * ahead;
    lanes::AppendFloatingCar({.id = fmt::format("{}.{}", pose.id, pose.trip),
                              .kind = NameOf(model.traits(pose.id).kind),
                              .front_x_m = front.x(),
                              .front_y_m = front.y(),
                              .heading_rad = std::atan2(ahead.y(), ahead.x()),
                              .pitch_up_rad = std::asin(std::clamp(ahead.z(), -1.0, 1.0)),
                              .speed_mps = pose.speed_mps,
                              .lane = lanes::SumoLaneOf(graph, agent.path[i].track),
                              .lane_front_m = agent.o_m + half - agent.path[i].zero_m},
                             text);
  }
  text += lanes::kTimestepEnd;
  return text;
}

}  // namespace rodeira::traffic
