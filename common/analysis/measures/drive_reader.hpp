// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/analysis/measures/condition.hpp"
#include "common/analysis/measures/drive.hpp"
#include "common/core/base/result.hpp"
#include "common/data/decode/aliases.hpp"
#include "common/data/record/mcap_reader.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::measures {

// Something that happened at a time: a mark of the operator, or an event of the scenario.
struct DriveEvent {
  enum class Kind { kMark, kScenario } kind = Kind::kMark;
  double time_s = 0.0;
  std::string name;      // the mark's text; the event's name ("traffic.brake")
  std::string argument;  // of the event
};

// Which road user of a recording is read.
struct DriveQuery {
  std::string subject;                       // name of a vehicle node, or "agent:7"; empty: the first vehicle
  const decode::Aliases* aliases = nullptr;  // names of older recordings; may be null
  // Every message of the recording in the order of the file, with its channel; for digests. May be empty.
  std::function<void(const record::Channel& channel, const record::Message& message)> on_message;
  // Called now and then with the share that is read; false ends the reading with an Error. May be empty.
  std::function<bool(double share)> progress;
};

// A drive, and what happened meanwhile.
struct DriveReading {
  Drive drive;
  std::vector<DriveEvent> events;  // by time
  std::vector<NamedRoad> roads;    // that conditions may name
};

// Reads a recording once and rebuilds the kinematics of one road user, at 100 Hz or at the vehicle's own rate if that
// is lower. Memory grows with the duration, and with the agents near the path. network: of the world that the recording
// embeds; null: there are no roads, and what needs them is missing. Wrong input where the recording has no such road
// user, is no recording of Rodeira, or is damaged.
base::Result<DriveReading> ReadDrive(const record::McapReader& reader, const network::Network* network,
                                     const DriveQuery& query);

// The marks and events of a recording alone, by time. Wrong input where one of their messages is not what its schema
// says, or is damaged.
base::Result<std::vector<DriveEvent>> ReadEvents(const record::McapReader& reader, const decode::Aliases& aliases);

}  // namespace rodeira::measures
