// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/kinds.hpp"

#include "idl/topics.hpp"

namespace rodeira::launch {

namespace topics = idl::topics;
using lockstep::PortKind;
using lockstep::Role;

namespace {

struct PortRow {
  std::string_view topic;
  PortKind kind;
  bool many;
  bool required;
};
struct KindRow {
  std::string_view name;
  Role role;
  double default_period_s;
  std::vector<std::string_view> outputs;
  std::vector<PortRow> inputs;
  std::string_view program;
  std::vector<std::string_view> side_topics;
  std::vector<std::string_view> requested_outputs = {};
};

NodeKind KindOf(const KindRow& row) {
  NodeKind kind;
  kind.name = row.name;
  kind.role = row.role;
  kind.default_period_s = row.default_period_s;
  kind.outputs.assign(row.outputs.begin(), row.outputs.end());
  kind.requested_outputs.assign(row.requested_outputs.begin(), row.requested_outputs.end());
  for (const PortRow& port : row.inputs)
    kind.inputs.push_back({std::string(port.topic), port.kind, port.many, port.required});
  kind.program = row.program;
  kind.side_topics.assign(row.side_topics.begin(), row.side_topics.end());
  return kind;
}

std::vector<NodeKind> MakeKinds() {
  const std::vector<KindRow> rows = {
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
       {topics::kGroundRequest, topics::kGroundReply, topics::kWorldInfo},
       {topics::kJointForces}},
      {"traffic",
       Role::kStepped,
       0.01,
       {topics::kTrafficState, topics::kSignalsState, topics::kTrafficDetails},
       {{topics::kVehicleState, PortKind::kState, true, false},
        {topics::kCollisions, PortKind::kEvent, true, false},
        {topics::kScenarioEvents, PortKind::kEvent, true, false},
        {topics::kTrafficRequests, PortKind::kEvent, true, false}},
       "rodeira-traffic",
       {},
       {topics::kTrafficAnswers}},
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
      {"measures",
       Role::kStepped,
       0.05,
       {topics::kMeasures},
       {{topics::kVehicleState, PortKind::kState, true, true}, {topics::kTrafficState, PortKind::kState, true, false}},
       "rodeira-measures",
       {}},
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
        {topics::kJointForces, PortKind::kEvent, true, false},
        {topics::kTrafficState, PortKind::kEvent, true, false},
        {topics::kSignalsState, PortKind::kEvent, true, false},
        {topics::kTrafficDetails, PortKind::kEvent, true, false},
        {topics::kTrafficRequests, PortKind::kEvent, true, false},
        {topics::kTrafficAnswers, PortKind::kEvent, true, false},
        {topics::kScenarioEvents, PortKind::kEvent, true, false},
        {topics::kWeatherState, PortKind::kEvent, true, false},
        {topics::kMeasures, PortKind::kEvent, true, false},
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
  std::vector<NodeKind> kinds;
  for (const KindRow& row : rows) kinds.push_back(KindOf(row));
  return kinds;
}

}  // namespace

const std::vector<NodeKind>& NodeKinds() {
  static const std::vector<NodeKind> kKinds = MakeKinds();
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
  for (const NodeKind& kind : NodeKinds()) names.push_back(kind.name);
  names.emplace_back(kExternalKind);
  return names;
}

}  // namespace rodeira::launch
