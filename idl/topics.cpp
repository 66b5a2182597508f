// SPDX-License-Identifier: Apache-2.0
#include "idl/topics.hpp"

#include <algorithm>

#include "common/core/base/assert.hpp"

namespace rodeira::idl {

const std::vector<TopicInfo>& Topics() {
  static const std::vector<TopicInfo> kTopics = {
      {topics::kControls, "rodeira::msg::Controls", "controls", true},
      {topics::kVehicleState, "rodeira::msg::VehicleState", "vehicle", true},
      {topics::kCollisions, "rodeira::msg::Collisions", "collisions", true},
      {topics::kJointForces, "rodeira::msg::JointForces", "joint_forces", true},
      {topics::kTrafficState, "rodeira::msg::TrafficState", "traffic", true},
      {topics::kTrafficDetails, "rodeira::msg::TrafficDetails", "traffic", true},
      {topics::kTrafficRequests, "rodeira::msg::TrafficRequests", "traffic_requests", true},
      {topics::kTrafficAnswers, "rodeira::msg::TrafficAnswers", "traffic_requests", true},
      {topics::kSignalsState, "rodeira::msg::SignalsState", "signals", true},
      {topics::kScenarioEvents, "rodeira::msg::ScenarioEvents", "scenario", true},
      {topics::kWeatherState, "rodeira::msg::WeatherState", "weather", true},
      {topics::kMeasures, "rodeira::msg::Measures", "measures", true},
      {topics::kSnapshot, "rodeira::msg::Snapshot", "snapshot", true},
      {topics::kPulse, "rodeira::msg::Pulse", "pulse", true},
      {topics::kSampleBatches, "rodeira::msg::SampleBatch", "sample_batch", false},
      {topics::kGrant, "rodeira::msg::Grant", "clock", false},
      {topics::kNack, "rodeira::msg::Nack", "clock", false},
      {topics::kRetransmissions, "rodeira::msg::SampleBatch", "sample_batch", false},
      {topics::kReport, "rodeira::msg::Report", "clock", false},
      {topics::kGroundRequest, "rodeira::msg::GroundRequest", "ground", false},
      {topics::kGroundReply, "rodeira::msg::GroundReply", "ground", false},
      {topics::kWorldInfo, "rodeira::msg::WorldInfo", "world", false},
      {topics::kWindowKeys, "rodeira::msg::WindowKeys", "operator_input", false},
      {topics::kOperatorRequests, "rodeira::msg::OperatorRequests", "operator_input", false},
      {topics::kRunLog, "rodeira::msg::RunLog", "run_log", false},
      {topics::kTrigger, "rodeira::msg::Trigger", "trigger", false},
      {topics::kWallTime, "rodeira::msg::WallTime", "run_log", false},
      {topics::kRemarks, "rodeira::msg::Remark", "run_log", false},
  };
  return kTopics;
}

const TopicInfo* FindTopic(std::string_view topic) {
  const auto& all = Topics();
  const auto found = std::find_if(all.begin(), all.end(), [&](const TopicInfo& info) {
    return info.topic == topic || (info.topic == topics::kSampleBatches && topic.starts_with(topics::kSampleBatches));
  });
  return found == all.end() ? nullptr : &*found;
}

const std::string& IdlTextOf(std::string_view subject) {
  const auto& all = IdlTexts();
  const auto found = std::find_if(all.begin(), all.end(), [&](const IdlText& text) { return text.subject == subject; });
  RODEIRA_ASSERT(found != all.end());
  return found->text;
}

}  // namespace rodeira::idl
