// SPDX-License-Identifier: Apache-2.0
// Lights with an orientation that says the side that they face, as some map editors write it.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "common/world/network/placing.hpp"
#include "common/world/opendrive/checks.hpp"
#include "common/world/opendrive/read.hpp"

namespace rodeira::opendrive {
namespace {

const network::LaneSection& SectionAt(const network::RoadSpec& road, double s_m) {
  const auto behind = std::find_if(road.sections.begin(), road.sections.end(),
                                   [&](const network::LaneSection& section) { return section.s_m > s_m; });
  return behind == road.sections.begin() ? road.sections.front() : *(behind - 1);
}

// Whether the orientation fits none of the lanes that the validity names, and the other one fits one of them.
bool FacesItsLanes(const network::RoadSpec& road, double s_m, const std::string& orientation,
                   const std::vector<network::LaneValidity>& validity) {
  if ((orientation != "+" && orientation != "-") || validity.empty() || road.sections.empty()) return false;
  const network::LaneSection& section = SectionAt(road, s_m);
  const std::string turned = orientation == "+" ? "-" : "+";
  bool fits = false, turned_fits = false;
  for (const auto* side : {&section.left, &section.right}) {
    for (const network::Lane& lane : *side) {
      if (!network::IsDrivable(lane.type)) continue;
      for (const bool along : {false, true}) {
        if (along ? lane.direction < 0 : lane.direction > 0) continue;
        fits = fits || network::HoldsFor(lane.id, along, orientation, validity);
        turned_fits = turned_fits || network::HoldsFor(lane.id, along, turned, validity);
      }
    }
  }
  return turned_fits && !fits;
}

}  // namespace

void TurnLights(const std::vector<network::Controller>& controllers, std::vector<RoadReading>& readings,
                Findings& findings) {
  std::set<std::string, std::less<>> controlled;
  for (const network::Controller& controller : controllers) {
    for (const network::ControllerEntry& entry : controller.controls) controlled.insert(entry.signal_id);
  }
  std::size_t turned = 0;
  Finding first;
  for (RoadReading& road : readings) {
    const auto turn = [&](const std::string& id, double s_m, std::string& orientation,
                          const std::vector<network::LaneValidity>& validity) {
      if (!controlled.contains(id) || !FacesItsLanes(road.spec, s_m, orientation, validity)) return;
      if (turned++ == 0) {
        first = {"rodeira.orientation",
                 fmt::format("light {} has the orientation '{}', and the lanes that it names are driven the other way",
                             id, orientation),
                 road.lines.road,
                 road.spec.id,
                 {},
                 s_m,
                 {}};
      }
      orientation = orientation == "+" ? "-" : "+";
    };
    for (network::Signal& signal : road.spec.signals) turn(signal.id, signal.s_m, signal.orientation, signal.validity);
    for (network::SignalReference& reference : road.spec.signal_references)
      turn(reference.id, reference.s_m, reference.orientation, reference.validity);
  }
  if (turned == 0) return;
  first.repair.kind = RepairKind::kLightTurned;
  first.repair.done = turned == 1 ? "it holds for these lanes"
                                  : fmt::format("each of {} such lights holds for the lanes that it names", turned);
  findings.warnings.push_back(std::move(first));
}

}  // namespace rodeira::opendrive
