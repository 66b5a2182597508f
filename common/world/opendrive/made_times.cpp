// SPDX-License-Identifier: Apache-2.0
// Times for controllers that a file gives none.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "common/core/geometry/angle.hpp"
#include "common/world/network/placing.hpp"
#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

constexpr double kGreen_s = 20.0, kAmber_s = 3.0, kAllRed_s = 2.0, kRedAmber_s = 1.0;
constexpr double kSame_rad = 0.45, kHeadOn_rad = 2.5;  // as in lanes/approach.hpp
constexpr double kMaxUpstream_m = 60.0;                // as in lanes/approach.hpp

// Made times of the controllers of one network.
class Turns {
 public:
  Turns(network::NetworkSpec& spec, Findings& findings)
      : spec_(spec), findings_(findings), group_(spec.controllers.size()), junction_(spec.controllers.size(), nullptr) {
    std::iota(group_.begin(), group_.end(), 0u);
    FindLights();
    FindGroups();
  }

  // Controllers of one group take turns in the order of the junctions.
  void Take() {
    std::map<std::size_t, std::vector<std::size_t>> turns;
    for (const std::size_t i : order_) {
      if (spec_.controllers[i].times || headings_[i].empty()) continue;
      if (IsLeftDark(i)) continue;
      turns[GroupOf(i)].push_back(i);
    }
    constexpr double kTurn_s = kGreen_s + kAmber_s + kAllRed_s;
    for (const auto& [group, members] : turns) {
      const auto count = static_cast<double>(members.size());
      for (std::size_t k = 0; k < members.size(); ++k) {
        made_.emplace_back(members[k],
                           network::LightTimes{kTurn_s * count, kTurn_s * static_cast<double>(k),
                                               members.size() > 1 ? kGreen_s : kTurn_s, kAmber_s, kRedAmber_s});
      }
    }
    for (const auto& [controller, times] : made_) spec_.controllers[controller].times = times;
  }

 private:
  std::size_t GroupOf(std::size_t controller) const {
    while (group_[controller] != controller) controller = group_[controller];
    return controller;
  }
  void Join(std::size_t a, std::size_t b) {
    a = GroupOf(a), b = GroupOf(b);
    group_[std::max(a, b)] = std::min(a, b);
  }

  // In which directions the traffic goes that each controller's lights for vehicles are for.
  void FindLights() {
    headings_.resize(spec_.controllers.size());
    std::map<std::string, std::vector<std::size_t>, std::less<>> controllers;  // by signal
    for (std::size_t i = 0; i < spec_.controllers.size(); ++i) {
      for (const network::ControllerEntry& entry : spec_.controllers[i].controls)
        controllers[entry.signal_id].push_back(i);
    }
    std::set<std::string, std::less<>> for_vehicles;
    for (const network::Road& road : spec_.roads) {
      for (const network::Signal& signal : road.spec().signals) {
        if (signal.type != network::kPedestrianSignal) for_vehicles.insert(signal.id);
      }
    }
    for (const network::Road& road : spec_.roads) {
      const auto add = [&](const std::string& id, double s_m, const std::string& orientation,
                           const std::vector<network::LaneValidity>& validity) {
        const auto found = controllers.find(id);
        if (found == controllers.end() || !for_vehicles.contains(id)) return;
        for (const double heading : HeadingsAt(road, s_m, orientation, validity)) {
          for (const std::size_t i : found->second) headings_[i].push_back(heading);
        }
      };
      for (const network::Signal& signal : road.spec().signals)
        add(signal.id, signal.s_m, signal.orientation, signal.validity);
      for (const network::SignalReference& reference : road.spec().signal_references)
        add(reference.id, reference.s_m, reference.orientation, reference.validity);
    }
  }

  // Those of the drivable lanes that a light at a station is for.
  static std::vector<double> HeadingsAt(const network::Road& road, double s_m, const std::string& orientation,
                                        const std::vector<network::LaneValidity>& validity) {
    const double s = std::clamp(s_m, 0.0, road.length_m()), heading = road.axis().Evaluate(s).heading_rad;
    const network::LaneSection& section = road.spec().sections[road.SectionIndex(s)];
    bool along = false, against = false;
    for (const auto* side : {&section.left, &section.right}) {
      for (const network::Lane& lane : *side) {
        if (!network::IsDrivable(lane.type)) continue;
        along = along || (lane.direction >= 0 && network::HoldsFor(lane.id, true, orientation, validity));
        against = against || (lane.direction <= 0 && network::HoldsFor(lane.id, false, orientation, validity));
      }
    }
    std::vector<double> headings;
    if (along) headings.push_back(heading);
    if (against) headings.push_back(heading + geometry::kPi);
    return headings;
  }

  // Those of one junction are a group, and those of junctions that a road joins which is so short that a light before
  // the one holds in the other.
  void FindGroups() {
    std::map<std::string, std::vector<std::size_t>, std::less<>> of_junction;
    for (const network::Junction& junction : spec_.junctions) {
      for (const std::string& id : junction.controllers) {
        const auto found = std::find_if(spec_.controllers.begin(), spec_.controllers.end(),
                                        [&](const network::Controller& c) { return c.id == id; });
        if (found == spec_.controllers.end()) continue;
        const auto i = static_cast<std::size_t>(found - spec_.controllers.begin());
        if (junction_[i] == nullptr) junction_[i] = &junction, order_.push_back(i);
        std::vector<std::size_t>& members = of_junction[junction.id];
        if (!members.empty()) Join(members.front(), i);
        members.push_back(i);
      }
    }
    for (const network::Road& road : spec_.roads) {
      const auto &from = road.spec().predecessor, &to = road.spec().successor;
      if (!from || !to || !from->junction || !to->junction || road.length_m() > kMaxUpstream_m) continue;
      const auto a = of_junction.find(from->id), b = of_junction.find(to->id);
      if (a != of_junction.end() && b != of_junction.end()) Join(a->second.front(), b->second.front());
    }
  }

  bool Cross(std::size_t a, std::size_t b) const {
    for (const double one : headings_[a]) {
      for (const double other : headings_[b]) {
        const double turned = std::fabs(geometry::WrapAngle(one - other));
        if (turned > kSame_rad && turned < kHeadOn_rad) return true;
      }
    }
    return false;
  }

  // No turn of its own would keep its ways apart.
  bool IsLeftDark(std::size_t controller) {
    const char* why = nullptr;
    if (Cross(controller, controller)) why = "has lights for ways that come from different sides, and says no times";
    for (const std::size_t other : order_) {
      if (GroupOf(other) == GroupOf(controller) && spec_.controllers[other].times && Cross(controller, other))
        why = "says no times, and another one there does, and their ways cross";
    }
    if (why == nullptr) return false;
    findings_.warnings.push_back({"rodeira.times",
                                  fmt::format("controller {} of junction {} {}", spec_.controllers[controller].id,
                                              junction_[controller]->id, why),
                                  0,
                                  "",
                                  {},
                                  {},
                                  {RepairKind::kLightsDark, "its lights stay dark"}});
    return true;
  }

  network::NetworkSpec& spec_;
  Findings& findings_;
  std::vector<std::size_t> group_;                  // by controller: another one of its group, or itself
  std::vector<const network::Junction*> junction_;  // by controller: the first that names it; null: none
  std::vector<std::size_t> order_;                  // controllers of junctions, in the order of these
  std::vector<std::vector<double>> headings_;       // by controller
  std::vector<std::pair<std::size_t, network::LightTimes>> made_;
};

}  // namespace

void TakeTurns(network::NetworkSpec& spec, Findings& findings) { Turns(spec, findings).Take(); }

}  // namespace rodeira::opendrive
