// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/results/signal_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/core/base/append_format.hpp"
#include "common/core/base/csv_cell.hpp"
#include "common/traffic/results/names.hpp"
#include "common/world/lanes/lights.hpp"

namespace rodeira::traffic {

SignalTable::SignalTable(const lanes::Graph& graph) {
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const lanes::Track& lane = graph[track];
    for (const lanes::LightPlace& light : lanes::LightsOf(graph, track)) {
      const lanes::CurvePoint at = lane.curve.At(light.d_m);
      heads_.push_back(
          {light.controller, std::nullopt, base::CsvCell(light.signal),
           fmt::format("{},{},{:.3f},{:.3f},{:.5f},{:.3f}", base::CsvCell(graph.network().roads()[lane.lane.road].id()),
                       lane.lane.lane, at.p_W.x(), at.p_W.y(), std::atan2(at.ahead_W.y(), at.ahead_W.x()),
                       lane.curve.WidthAt(light.d_m))});
    }
  }
}

std::string SignalTable::At(double time_s, const TrafficModel& model) {
  std::string rows;
  for (Head& head : heads_) {
    const network::LightColour colour = model.colours()[head.controller];
    if (head.shown == colour) continue;
    head.shown = colour;
    base::AppendFormat(rows, "{:.2f},{},{},{}\n", time_s, head.head, NameOf(colour), head.place);
  }
  return rows;
}

}  // namespace rodeira::traffic
