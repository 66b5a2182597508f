// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/export_ids.hpp"

#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace rodeira::road {
namespace {

std::string PlainId(std::string id) {
  constexpr std::string_view kRefused = "|\\'\";,:<>&*?!#";
  for (char& c : id) {
    const auto code = static_cast<unsigned char>(c);
    if (code <= ' ' || code == 127 || kRefused.find(c) != std::string_view::npos) c = '_';
  }
  return id;
}

// One id for one, whatever it belongs to: what differs goes on differing.
class Ids {
 public:
  void Add(const std::string& id) { all_.insert(id); }
  void Choose() {
    std::set<std::string> taken;
    for (const std::string& id : all_) {
      if (PlainId(id) == id) taken.insert(id);
    }
    for (const std::string& id : all_) {
      if (PlainId(id) == id) continue;
      std::string plain = PlainId(id);
      for (int n = 2; !taken.insert(plain).second; ++n) plain = fmt::format("{}_{}", PlainId(id), n);
      chosen_[id] = plain;
    }
  }
  bool none() const { return chosen_.empty(); }
  void Put(std::string& id) const {
    const auto found = chosen_.find(id);
    if (found != chosen_.end()) id = found->second;
  }

 private:
  std::set<std::string> all_;
  std::map<std::string, std::string> chosen_;
};

// Every id, where it is given and where it is named.
template <class Do>
void EachId(network::RoadSpec& spec, const Do& each) {
  each(spec.id), each(spec.junction);
  for (auto* link : {&spec.predecessor, &spec.successor}) {
    if (*link) each((*link)->id);
  }
  for (network::Signal& signal : spec.signals) {
    each(signal.id);
    for (std::string& id : signal.depends_on) each(id);
    if (auto* seen = std::get_if<network::SeenAtRoad>(&signal.seen)) each(seen->road);
  }
  for (network::SignalReference& other : spec.signal_references) each(other.id);
  for (network::Object& object : spec.objects) each(object.id);
  for (network::ObjectReference& other : spec.object_references) each(other.id);
  for (network::Structure& structure : spec.structures) each(structure.id);
  for (network::LaneSection& section : spec.sections) {
    for (auto* lanes : {&section.left, &section.right}) {
      for (network::Lane& lane : *lanes) {
        if (lane.left_beside) each(lane.left_beside->road);
        if (lane.right_beside) each(lane.right_beside->road);
      }
    }
  }
}

template <class Do>
void EachId(network::Junction& junction, const Do& each) {
  each(junction.id);
  for (network::JunctionConnection& connection : junction.connections)
    each(connection.id), each(connection.incoming_road), each(connection.connecting_road);
  for (network::JunctionPriority& priority : junction.priorities) each(priority.high), each(priority.low);
  for (std::string& id : junction.controllers) each(id);
}

template <class Do>
void EachId(network::Controller& controller, const Do& each) {
  each(controller.id);
  for (network::ControllerEntry& entry : controller.controls) each(entry.signal_id);
}

}  // namespace

ExportParts WithPlainIds(const network::Network& network) {
  ExportParts parts{{network.roads().begin(), network.roads().end()},
                    {network.controllers().begin(), network.controllers().end()},
                    {network.junctions().begin(), network.junctions().end()}};
  Ids ids;
  const auto add = [&](const std::string& id) { ids.Add(id); };
  std::vector<network::RoadSpec> specs;
  for (const network::Road& road : parts.roads) EachId(specs.emplace_back(road.spec()), add);
  for (network::Controller& controller : parts.controllers) EachId(controller, add);
  for (network::Junction& junction : parts.junctions) EachId(junction, add);
  ids.Choose();
  if (ids.none()) return parts;
  const auto put = [&](std::string& id) { ids.Put(id); };
  std::vector<network::Road> roads;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    EachId(specs[i], put);
    roads.emplace_back(std::move(specs[i]), parts.roads[i].axis());
  }
  parts.roads = std::move(roads);
  for (network::Controller& controller : parts.controllers) EachId(controller, put);
  for (network::Junction& junction : parts.junctions) EachId(junction, put);
  return parts;
}

}  // namespace rodeira::road
