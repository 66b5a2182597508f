// SPDX-License-Identifier: Apache-2.0
#include "common/world/lanes/floating_car.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/core/base/append_format.hpp"
#include "common/core/base/constants.hpp"
#include "common/core/base/xml_text.hpp"

namespace rodeira::lanes {

std::string SumoLaneOf(const Graph& graph, std::uint32_t track) {
  const auto road = graph[track].lane.road;
  int index = 0;
  for (auto right = graph[track].right; right && graph[*right].lane.road == road; right = graph[*right].right) ++index;
  return fmt::format("{}_{}", base::XmlText(graph.network().roads()[road].id()), index);
}

void AppendTimestepBegin(double time_s, std::string& text) {
  base::AppendFormat(text, "    <timestep time=\"{:.2f}\">\n", time_s);
}

void AppendFloatingCar(const FloatingCar& car, std::string& text) {
  const double clockwise_deg = std::remainder(90.0 - base::kDegreesPerRadian * car.heading_rad, 360.0);
  const double angle_deg = clockwise_deg < 0.0 ? clockwise_deg + 360.0 : clockwise_deg;
  base::AppendFormat(text, "        <{} id=\"{}\" x=\"{:.2f}\" y=\"{:.2f}\" angle=\"{:.2f}\" ",
                     car.kind.empty() ? "person" : "vehicle", base::XmlText(car.id), car.front_x_m, car.front_y_m,
                     angle_deg);
  if (!car.kind.empty()) base::AppendFormat(text, "type=\"{}\" ", car.kind);
  base::AppendFormat(text, "speed=\"{:.2f}\" ", car.speed_mps);
  if (!car.lane.empty()) base::AppendFormat(text, "pos=\"{:.2f}\" lane=\"{}\" ", car.lane_front_m, car.lane);
  base::AppendFormat(text, "slope=\"{:.2f}\"/>\n", base::kDegreesPerRadian * car.pitch_up_rad);
}

}  // namespace rodeira::lanes
