// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rodeira::idl {

// The topics of Rodeira (docs/wire.md). The first group are samples of the lockstep, which are always recorded.
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
inline constexpr std::string_view kSampleBatches = "rodeira/sample_batches/";  // and the name of the consumer
inline constexpr std::string_view kGrant = "rodeira/grant";
inline constexpr std::string_view kNack = "rodeira/nack";
inline constexpr std::string_view kRetransmissions = "rodeira/retransmissions";
inline constexpr std::string_view kReport = "rodeira/report";
inline constexpr std::string_view kGroundRequest = "rodeira/ground_request";
inline constexpr std::string_view kGroundReply = "rodeira/ground_reply";
inline constexpr std::string_view kWorldInfo = "rodeira/world_info";
inline constexpr std::string_view kWindowKeys = "rodeira/window_keys";
inline constexpr std::string_view kOperatorRequests = "rodeira/operator_requests";
inline constexpr std::string_view kRunLog = "rodeira/run_log";
inline constexpr std::string_view kTrigger = "rodeira/trigger";
// Only in recordings: the contents of the run log.
inline constexpr std::string_view kWallTime = "rodeira/wall_time";
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

}  // namespace rodeira::idl
