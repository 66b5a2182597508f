// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "common/editor/commands.hpp"

namespace rodeira::editor {
namespace {

template <class Value, class Gone>
std::vector<std::size_t> Places(const std::vector<traffic_map::Line<Value>>& lines, const Gone& gone) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (gone(lines[i].value)) places.push_back(i);
  }
  std::reverse(places.begin(), places.end());  // so that taking one out moves none of the next
  return places;
}

// What the companion says of lanes and curves that are gone.
void Forget(traffic_map::Heights& companion, const std::set<std::int32_t>& curves,
            const std::set<std::int32_t>& lanes) {
  std::erase_if(companion.curves, [&](const traffic_map::CurveHeights& one) { return curves.contains(one.curve); });
  std::erase_if(companion.signs, [&](const traffic_map::LaneSign& sign) { return lanes.contains(sign.lane); });
  std::erase_if(companion.flows, [&](const traffic_map::LaneFlow& flow) { return lanes.contains(flow.lane); });
  for (lights::LightPlan& plan : companion.lights) {
    for (lights::Phase& phase : plan.phases) {
      std::erase_if(phase.green, [&](const std::string& name) {
        std::int32_t lane = 0;
        const auto [end, problem] = std::from_chars(name.data(), name.data() + name.size(), lane);
        return problem == std::errc() && end == name.data() + name.size() && lanes.contains(lane);
      });
    }
  }
  std::erase_if(companion.lights, [](const lights::LightPlan& plan) { return plan.Names().empty(); });
}

std::string Told(const Selection& gone, std::size_t curves, std::size_t lanes, std::size_t connections) {
  if (curves + lanes + connections == 1) {
    if (curves == 1) return fmt::format("curve {} deleted", *gone.curves.begin());
    if (lanes == 1) return fmt::format("lane {} deleted", *gone.lanes.begin());
    return fmt::format("connection {} to {} deleted", gone.connections.begin()->first,
                       gone.connections.begin()->second);
  }
  return fmt::format("deleted: {} curves, {} lanes, {} connections", curves, lanes, connections);
}

}  // namespace

base::Result<Edit> Remove(Document& document, const Selection& selection) {
  Selection gone = selection;
  for (const auto& line : document.map.lanes) {
    if (gone.curves.contains(line.value.left.curve) || gone.curves.contains(line.value.right.curve))
      gone.lanes.insert(line.value.id);
  }
  const auto curves =
      Places(document.map.curves, [&](const traffic_map::Curve& curve) { return gone.curves.contains(curve.id); });
  const auto lanes =
      Places(document.map.lanes, [&](const traffic_map::Lane& lane) { return gone.lanes.contains(lane.id); });
  const auto connections = Places(document.map.connections, [&](const traffic_map::Connection& c) {
    return gone.lanes.contains(c.from) || gone.lanes.contains(c.to) || gone.connections.contains({c.from, c.to});
  });
  if (curves.empty() && lanes.empty() && connections.empty())
    return base::WrongInput("edit.nothing_chosen", "nothing is selected that can be deleted");
  Recorder recorder(document);
  for (const std::size_t i : connections) recorder.RemoveConnection(i);
  for (const std::size_t i : lanes) recorder.RemoveLane(i);
  for (const std::size_t i : curves) recorder.RemoveCurve(i);
  Forget(recorder.companion(), gone.curves, gone.lanes);
  return std::move(recorder).Finish(Told(gone, curves.size(), lanes.size(), connections.size()));
}

base::Result<Edit> Reset(Document& document) {
  Recorder recorder(document);
  while (!document.map.connections.empty()) recorder.RemoveConnection(document.map.connections.size() - 1);
  while (!document.map.lanes.empty()) recorder.RemoveLane(document.map.lanes.size() - 1);
  while (!document.map.curves.empty()) recorder.RemoveCurve(document.map.curves.size() - 1);
  recorder.companion() = {};
  return std::move(recorder).Finish("map reset");
}

}  // namespace rodeira::editor
