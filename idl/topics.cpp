// SPDX-License-Identifier: Apache-2.0
#include "idl/topics.hpp"

#include <algorithm>

#include "common/core/base/assert.hpp"

namespace rodeira::idl {

const std::vector<TopicInfo>& Topics() {
  static const std::vector<TopicInfo> kTopics = {
      {topics::kControls, "rodeira::msg::Controls", "driving", true},
      {topics::kVehicleState, "rodeira::msg::VehicleState", "vehicle", true},
      {topics::kCollisions, "rodeira::msg::Collisions", "collision", true},
      {topics::kTrafficState, "rodeira::msg::TrafficState", "traffic", true},
      {topics::kTrafficDetails, "rodeira::msg::TrafficDetails", "traffic", true},
      {topics::kSignalsState, "rodeira::msg::SignalsState", "signals", true},
      {topics::kScenarioEvents, "rodeira::msg::ScenarioEvents", "scenario", true},
      {topics::kWeatherState, "rodeira::msg::WeatherState", "weather", true},
      {topics::kSnapshot, "rodeira::msg::Snapshot", "snapshot", true},
      {topics::kPulse, "rodeira::msg::Pulse", "pulse", true},
      {topics::kParcels, "rodeira::msg::Parcel", "parcel", false},
      {topics::kGrant, "rodeira::msg::Grant", "clock", false},
      {topics::kAsk, "rodeira::msg::Ask", "clock", false},
      {topics::kAnswers, "rodeira::msg::Parcel", "parcel", false},
      {topics::kReport, "rodeira::msg::Report", "clock", false},
      {topics::kGroundRequest, "rodeira::msg::GroundRequest", "ground", false},
      {topics::kGroundReply, "rodeira::msg::GroundReply", "ground", false},
      {topics::kWorldInfo, "rodeira::msg::WorldInfo", "world", false},
      {topics::kLiveKeys, "rodeira::msg::LiveKeys", "live", false},
      {topics::kLiveRequests, "rodeira::msg::LiveRequests", "live", false},
      {topics::kRunLog, "rodeira::msg::RunLog", "log", false},
      {topics::kTrigger, "rodeira::msg::Trigger", "trigger", false},
      {topics::kWall, "rodeira::msg::WallTime", "log", false},
      {topics::kRemarks, "rodeira::msg::Remark", "log", false},
  };
  return kTopics;
}

const TopicInfo* FindTopic(std::string_view topic) {
  const auto& all = Topics();
  const auto found = std::find_if(all.begin(), all.end(), [&](const TopicInfo& info) {
    return info.topic == topic || (info.topic == topics::kParcels && topic.starts_with(topics::kParcels));
  });
  return found == all.end() ? nullptr : &*found;
}

const std::string& IdlTextOf(std::string_view subject) {
  const auto& all = IdlTexts();
  const auto found = std::find_if(all.begin(), all.end(), [&](const IdlText& text) { return text.subject == subject; });
  RODEIRA_ASSERT(found != all.end());
  return found->text;
}

base::Digest ProtocolHash() {
  base::Digest digest = 1;  // grows where the meaning changes and no text does
  for (const IdlText& text : IdlTexts()) digest = base::Combine(digest, base::Hash(text.text));
  return digest;
}

}  // namespace rodeira::idl
