// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/floating_cars.hpp"
#include "common/traffic/results/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/append_format.hpp"
#include "common/core/base/constants.hpp"
#include "common/traffic/results/xml_text.hpp"

namespace rodeira::traffic {
namespace {

// Of a lane of its road, from the right edge of its direction.
int IndexOf(const lanes::Graph& graph, std::uint32_t track) {
  int index = 0;
  for (auto right = graph[track].right; right && graph[*right].lane.road == graph[track].lane.road;
       right = graph[*right].right)
    ++index;
  return index;
}

}  // namespace

std::string SumoLaneOf(const lanes::Graph& graph, std::uint32_t track) {
  const auto road = static_cast<std::size_t>(graph[track].lane.road);
  return fmt::format("{}_{}", XmlText(graph.network().roads()[road].id()), IndexOf(graph, track));
}

std::string FloatingCarsBegin() { return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fcd-export>\n"; }
std::string FloatingCarsEnd() { return "</fcd-export>\n"; }

std::string FloatingCarsAt(double time_s, const TrafficModel& model) {
  std::string text = fmt::format("    <timestep time=\"{:.2f}\">\n", time_s);
  const lanes::Graph& graph = model.graph();
  for (const AgentPose& pose : model.poses()) {
    const Agent& agent = model.agent(pose.id);
    std::size_t i = agent.path.size() - 1;
    while (i > 0 && agent.path[i].begin_m > agent.o_m) --i;
    const Eigen::Vector3d ahead = pose.q_WB * Eigen::Vector3d::UnitX();
    const double half = 0.5 * model.traits(pose.id).length_m;
    const Eigen::Vector3d front = pose.p_WB_W + half * ahead;
    const double angle = std::remainder(90.0 - base::kDegreesPerRadian * std::atan2(ahead.y(), ahead.x()), 360.0);
    base::AppendFormat(text,
                       "        <vehicle id=\"{}.{}\" x=\"{:.2f}\" y=\"{:.2f}\" angle=\"{:.2f}\" type=\"{}\" "
                       "speed=\"{:.2f}\" pos=\"{:.2f}\" lane=\"{}_{}\" slope=\"{:.2f}\"/>\n",
                       pose.id, pose.trip, front.x(), front.y(), angle < 0.0 ? angle + 360.0 : angle,
                       NameOf(model.traits(pose.id).kind), pose.speed_mps, agent.o_m + half - agent.path[i].zero_m,
                       XmlText(graph.network().roads()[static_cast<std::size_t>(pose.road)].id()),
                       IndexOf(graph, agent.path[i].track),
                       base::kDegreesPerRadian * std::asin(std::clamp(ahead.z(), -1.0, 1.0)));
  }
  return text + "    </timestep>\n";
}

}  // namespace rodeira::traffic
