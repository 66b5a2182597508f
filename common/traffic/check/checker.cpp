// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/check/checker.hpp"

#include <algorithm>

namespace rodeira::traffic {
namespace {

const AgentPose& PoseOf(const std::vector<AgentPose>& poses, std::uint32_t id) {
  return *std::lower_bound(poses.begin(), poses.end(), id,
                           [](const AgentPose& pose, std::uint32_t wanted) { return pose.id < wanted; });
}

}  // namespace

Checker::Checker(const TrafficModel& model)
    : bodies_(model.vehicles()),
      trips_(model.vehicles(), -1),
      road_(model.graph(), model.vehicles()),
      reds_(model.graph(), model.vehicles()) {}

void Checker::FindBodies(const TrafficModel& model) {
  for (const AgentPose& pose : model.poses()) {
    if (trips_[pose.id] == static_cast<std::int64_t>(pose.trip)) continue;
    const AgentTraits& traits = model.traits(pose.id);
    bodies_[pose.id] = BodySize::Of(traits.length_m, traits.width_m, traits.wheelbase_m);
    trips_[pose.id] = pose.trip;
  }
}

void Checker::Contacts(const TrafficModel& model, double time_s, Incidents& incidents) {
  const std::vector<BoxCheck::Pair>& now = boxes_.Find(model.poses(), bodies_);
  for (const BoxCheck::Pair& pair : now) {
    if (std::binary_search(touching_.begin(), touching_.end(), pair)) continue;
    ++counts_.collisions;
    const AgentPose &a = PoseOf(model.poses(), pair.first), &b = PoseOf(model.poses(), pair.second);
    incidents.Tell(time_s, a, "touches car {} on road '{}', lane {}, {:.2f} m/s", b.id, incidents.RoadOf(b), b.lane,
                   b.speed_mps);
  }
  touching_ = now;
}

void Checker::Observe(const TrafficModel& model, double time_s, Incidents& incidents) {
  FindBodies(model);
  Contacts(model, time_s, incidents);
  const bool lights = reds_.any_lights();
  if (lights) reds_.Begin(model.colours());
  for (const AgentPose& pose : model.poses()) {
    const RoadCheck::Finding found = road_.Find(pose, bodies_[pose.id]);
    if (found.beside_m) {
      ++counts_.off_lane;
      incidents.Tell(time_s, pose, "off its lane ({} m)", *found.beside_m);
    }
    for (const Eigen::Vector3d& wheel_W : found.wheels_W) {
      ++counts_.wheels_off;
      incidents.Tell(time_s, pose, "has a wheel off the road, at ({:.2f}, {:.2f})", wheel_W.x(), wheel_W.y());
    }
    if (!lights) continue;
    const Agent& agent = model.agent(pose.id);
    if (agent.is_crashed || agent.path.empty()) continue;
    if (!reds_.Passes(pose.id, pose.trip, agent.path, agent.o_m + 0.5 * bodies_[pose.id].length_m)) continue;
    ++counts_.reds;
    incidents.Tell(time_s, pose, "passes a red light");
  }
}

}  // namespace rodeira::traffic
