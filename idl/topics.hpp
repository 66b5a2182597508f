// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/hash.hpp"

namespace rodeira::idl {

// The topics of Rodeira. The first group are samples of the lockstep, recorded always.
namespace topics {
inline constexpr std::string_view kControls = "rodeira/controls";
inline constexpr std::string_view kVehicleState = "rodeira/vehicle_state";
inline constexpr std::string_view kCollisions = "rodeira/collisions";
inline constexpr std::string_view kTrafficState = "rodeira/traffic_state";
inline constexpr std::string_view kTrafficDetails = "rodeira/traffic_details";
inline constexpr std::string_view kSignalsState = "rodeira/signals_state";
inline constexpr std::string_view kScenarioEvents = "rodeira/scenario_events";
inline constexpr std::string_view kWeatherState = "rodeira/weather_state";
inline constexpr std::string_view kPulse = "rodeira/pulse";
inline constexpr std::string_view kSnapshot = "rodeira/snapshot";
inline constexpr std::string_view kParcels = "rodeira/parcels/";  // and the name of the node that they are for
inline constexpr std::string_view kGrant = "rodeira/grant";
inline constexpr std::string_view kAsk = "rodeira/ask";
inline constexpr std::string_view kAnswers = "rodeira/answers";
inline constexpr std::string_view kReport = "rodeira/report";
inline constexpr std::string_view kGroundRequest = "rodeira/ground_request";
inline constexpr std::string_view kGroundReply = "rodeira/ground_reply";
inline constexpr std::string_view kWorldInfo = "rodeira/world_info";
inline constexpr std::string_view kLiveKeys = "rodeira/live_keys";
inline constexpr std::string_view kLiveRequests = "rodeira/live_requests";
inline constexpr std::string_view kRunLog = "rodeira/run_log";
inline constexpr std::string_view kTrigger = "rodeira/trigger";
// Only in recordings: what came by the run's log.
inline constexpr std::string_view kWall = "rodeira/wall";
inline constexpr std::string_view kRemarks = "rodeira/remarks";
}  // namespace topics

struct TopicInfo {
  std::string_view topic;
  std::string_view type;     // "rodeira::msg::Controls", the name on the wire and of the schema in a recording
  std::string_view subject;  // which IDL text
  bool lockstep = false;     // its samples begin with the header
};

const std::vector<TopicInfo>& Topics();
// Null where there is no such topic.
const TopicInfo* FindTopic(std::string_view topic);

struct IdlText {
  std::string subject;
  std::string text;  // self-contained, without preprocessor lines
};
const std::vector<IdlText>& IdlTexts();
// The text of a subject; an unknown one is our mistake.
const std::string& IdlTextOf(std::string_view subject);
// Of all texts: two programs with equal hashes read each other's messages.
base::Digest ProtocolHash();

}  // namespace rodeira::idl
