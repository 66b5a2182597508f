// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/world/network/lights.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::network {

// A lane that goes on into another: ids of lanes.
struct JunctionLaneLink {
  int from = 0;  // lane of the incoming road
  int to = 0;    // lane of the connecting road
};

// A way into a junction. In a direct junction the second road is the one that is met without any connecting road.
struct JunctionConnection {
  std::string id, incoming_road, connecting_road;
  End contact = End::kStart;  // the connecting road's end that meets the incoming road
  std::vector<JunctionLaneLink> lane_links;
};

// Traffic from `high` goes before traffic from `low`.
struct JunctionPriority {
  std::string high, low;  // ids of connecting roads; where roads cross, or meet in the middle of one, of those
};

// An OpenDRIVE <junction>, and the ground that this program made for it.
struct Junction {
  std::string id, name;
  std::string type = "default";  // default, direct, virtual, crossing
  std::string main_road;         // of a virtual junction: the road at the middle of which it lies; empty: none
  std::vector<JunctionConnection> connections;
  std::vector<JunctionPriority> priorities;
  std::vector<std::string> controllers;
  // Of a junction made by this program: the corners of its surface, counter-clockwise, without the first one again; the
  // part that is paved, and all of it with the verges. Within it World::At says the height. Empty: what its roads
  // cover.
  std::vector<Eigen::Vector2d> paved_W, outline_W;
  std::shared_ptr<const JunctionGround> ground;  // of a file's junction that has heights of its own; null: its roads'
};

// A signal that a controller switches.
struct ControllerEntry {
  std::string signal_id, type;
};

// Signals that show the same. Without times their lights are dark.
struct Controller {
  std::string id, name;
  std::vector<ControllerEntry> controls;
  std::optional<LightTimes> times;
  std::string place;  // "file:line" where its green is written down; empty: not known
};

}  // namespace rodeira::network
