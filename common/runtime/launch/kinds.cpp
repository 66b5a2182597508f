// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/kinds.hpp"

#include "idl/topics.hpp"

namespace rodeira::launch {

namespace topics = idl::topics;
using lockstep::PortKind;
using lockstep::Role;

const std::vector<NodeKind>& NodeKinds() {
  static const std::vector<NodeKind> kKinds = {
      {"road",
       Role::kService,
       0.0,
       {},
       {},
       "rodeira-road",
       {topics::kGroundRequest, topics::kGroundReply, topics::kWorldInfo}},
      {"vehicle",
       Role::kStepped,
       0.001,
       {topics::kVehicleState, topics::kCollisions},
       {{topics::kControls, PortKind::kState, false, true},
        {topics::kTrafficState, PortKind::kState, true, false},
        {topics::kVehicleState, PortKind::kState, true, false},
        {topics::kWeatherState, PortKind::kState, false, false},
        {topics::kScenarioEvents, PortKind::kEvent, true, false}},
       "rodeira-vehicle",
       {topics::kGroundRequest, topics::kGroundReply, topics::kWorldInfo}},
      {"traffic",
       Role::kStepped,
       0.01,
       {topics::kTrafficState, topics::kSignalsState, topics::kTrafficDetails},
       {{topics::kVehicleState, PortKind::kState, true, false},
        {topics::kCollisions, PortKind::kEvent, true, false},
        {topics::kScenarioEvents, PortKind::kEvent, true, false}},
       "rodeira-traffic",
       {}},
      {"input",
       Role::kStepped,
       0.01,
       {topics::kControls},
       {{topics::kVehicleState, PortKind::kState, false, false},
        {topics::kTrafficState, PortKind::kState, true, false},
        {topics::kSignalsState, PortKind::kState, true, false}},
       "rodeira-input",
       {topics::kWindowKeys}},
      {"scenario",
       Role::kStepped,
       0.01,
       {topics::kScenarioEvents, topics::kWeatherState},
       {{topics::kVehicleState, PortKind::kState, false, false}},
       "rodeira-scenario",
       {topics::kOperatorRequests}},
      {"view",
       Role::kStepped,
       0.02,
       {},
       {{topics::kVehicleState, PortKind::kEvent, true, false},
        {topics::kTrafficState, PortKind::kEvent, true, false},
        {topics::kSignalsState, PortKind::kEvent, true, false},
        {topics::kTrafficDetails, PortKind::kEvent, true, false},
        {topics::kWeatherState, PortKind::kEvent, false, false},
        {topics::kScenarioEvents, PortKind::kEvent, true, false}},
       "rodeira-view",
       {topics::kWindowKeys, topics::kOperatorRequests}},
      {"recorder",
       Role::kStepped,
       0.05,
       {},
       {{topics::kControls, PortKind::kEvent, true, false},
        {topics::kVehicleState, PortKind::kEvent, true, false},
        {topics::kCollisions, PortKind::kEvent, true, false},
        {topics::kTrafficState, PortKind::kEvent, true, false},
        {topics::kSignalsState, PortKind::kEvent, true, false},
        {topics::kTrafficDetails, PortKind::kEvent, true, false},
        {topics::kScenarioEvents, PortKind::kEvent, true, false},
        {topics::kWeatherState, PortKind::kEvent, true, false},
        {topics::kPulse, PortKind::kEvent, true, false},
        {topics::kSnapshot, PortKind::kEvent, true, false}},
       "rodeira-recorder",
       {topics::kWorldInfo, topics::kRunLog}},
      {"empty",
       Role::kStepped,
       0.001,
       {topics::kPulse},
       {{topics::kPulse, PortKind::kState, true, false}},
       "rodeira-empty",
       {}},
  };
  return kKinds;
}

const NodeKind* FindKind(std::string_view name) {
  for (const NodeKind& kind : NodeKinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

std::vector<std::string> KindNames() {
  std::vector<std::string> names;
  for (const NodeKind& kind : NodeKinds()) names.emplace_back(kind.name);
  return names;
}

}  // namespace rodeira::launch
