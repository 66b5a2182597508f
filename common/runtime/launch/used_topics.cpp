// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/used_topics.hpp"

#include "idl/topics.hpp"

namespace rodeira::launch {

namespace topics = idl::topics;

idl::TopicSet UsedTopics(const Launch& launch, lockstep::NodeIndex node) {
  const lockstep::Roster& roster = launch.roster();
  const lockstep::RosterNode& spec = roster.node(node);
  idl::TopicSet used{std::string(topics::kGrant), std::string(topics::kReport)};
  if (spec.role == lockstep::Role::kStepped) {
    for (const std::string_view topic : {topics::kNack, topics::kRetransmissions, topics::kSampleBatches})
      used.emplace(topic);
  }
  for (const lockstep::SourceIndex output : spec.outputs) used.insert(roster.source(output).topic);
  if (spec.snapshots) used.insert(roster.source(*spec.snapshots).topic);
  for (const lockstep::Port& port : spec.inputs) {
    if (!port.sources.empty()) used.insert(port.topic);
  }
  for (const std::string& topic : launch.node(node).kind->side_topics) used.insert(topic);
  return used;
}

}  // namespace rodeira::launch
