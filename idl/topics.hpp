// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Names and types of Rodeira's topics.

#include <string>
#include <string_view>
#include <vector>

namespace rodeira::idl {

/// The topics of Rodeira (docs/reference/wire.md), each with its type. The samples of kControls … kSnapshot belong to
/// the lockstep and are always recorded.
namespace topics {
inline constexpr std::string_view kControls = "rodeira/controls";           ///< Controls of a vehicle
inline constexpr std::string_view kVehicleState = "rodeira/vehicle_state";  ///< VehicleState of a vehicle
inline constexpr std::string_view kCollisions = "rodeira/collisions";       ///< Collisions of a vehicle
inline constexpr std::string_view kJointForces = "rodeira/joint_forces";    ///< JointForces of a multibody car
inline constexpr std::string_view kTrafficState =
    "rodeira/traffic_state";  ///< TrafficState: position and motion of all traffic
inline constexpr std::string_view kTrafficDetails =
    "rodeira/traffic_details";  ///< TrafficDetails: drivers and engines of all traffic
inline constexpr std::string_view kTrafficRequests =
    "rodeira/traffic_requests";  ///< TrafficRequests, of nodes that control the traffic
inline constexpr std::string_view kTrafficAnswers =
    "rodeira/traffic_answers";  ///< TrafficAnswers, of the traffic to its requests
inline constexpr std::string_view kSignalsState = "rodeira/signals_state";      ///< SignalsState: traffic lights
inline constexpr std::string_view kScenarioEvents = "rodeira/scenario_events";  ///< ScenarioEvents
inline constexpr std::string_view kWeatherState = "rodeira/weather_state";      ///< WeatherState
inline constexpr std::string_view kMeasures = "rodeira/measures";               ///< Measures of a vehicle
inline constexpr std::string_view kPulse = "rodeira/pulse";                     ///< Pulse, of test nodes
inline constexpr std::string_view kSnapshot = "rodeira/snapshot";  ///< Snapshot: states of nodes, for sinks
inline constexpr std::string_view kSampleBatches =
    "rodeira/sample_batches/";                               ///< SampleBatch; the name of the consumer follows
inline constexpr std::string_view kGrant = "rodeira/grant";  ///< Grant, from the clock
inline constexpr std::string_view kNack = "rodeira/nack";    ///< Nack: samples are missing
inline constexpr std::string_view kRetransmissions =
    "rodeira/retransmissions";                                 ///< SampleBatch: the samples that a Nack names
inline constexpr std::string_view kReport = "rodeira/report";  ///< Report, to the clock
inline constexpr std::string_view kGroundRequest = "rodeira/ground_request";  ///< GroundRequest, to the road server
inline constexpr std::string_view kGroundReply = "rodeira/ground_reply";      ///< GroundReply, from the road server
inline constexpr std::string_view kWorldInfo = "rodeira/world_info";          ///< WorldInfo, from the road server
inline constexpr std::string_view kWindowKeys = "rodeira/window_keys";        ///< WindowKeys, from windows
inline constexpr std::string_view kOperatorRequests = "rodeira/operator_requests";  ///< OperatorRequests, from windows
inline constexpr std::string_view kRunLog = "rodeira/run_log";      ///< RunLog, from the clock to the recorder
inline constexpr std::string_view kTrigger = "rodeira/trigger";     ///< Trigger, for external recorders
inline constexpr std::string_view kWallTime = "rodeira/wall_time";  ///< WallTime, in recordings only
inline constexpr std::string_view kRemarks = "rodeira/remarks";     ///< Remark, in recordings only
}  // namespace topics

/// A topic of Rodeira.
struct TopicInfo {
  std::string_view topic;    ///< name of the topic
  std::string_view type;     ///< "rodeira::msg::Controls", the name on the wire and of the schema in a recording
  std::string_view subject;  ///< name of the IDL text with the type
  bool lockstep = false;     ///< true: its samples begin with the sample header
};

/// Lists all topics.
/// @return the topics; the list lives as long as the program
const std::vector<TopicInfo>& Topics();
/// Finds a topic.
/// @param topic name of the topic; of kSampleBatches with or without a consumer
/// @return the topic; null if Rodeira has no such topic
const TopicInfo* FindTopic(std::string_view topic);

/// The text of an IDL file.
struct IdlText {
  std::string subject;  ///< name of the file without its extension
  std::string text;     ///< the text with what it includes, without preprocessor lines
};
/// Lists the texts of Rodeira's IDL files.
/// @return the texts; the list lives as long as the program
const std::vector<IdlText>& IdlTexts();
/// Gives the text of a subject. An unknown subject is an assertion failure.
/// @param subject name of the IDL file without its extension
/// @return the text
const std::string& IdlTextOf(std::string_view subject);

}  // namespace rodeira::idl
