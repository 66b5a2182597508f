// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/world/network/network.hpp"
#include "common/world/opendrive/read.hpp"

// How links of lanes are repaired.
namespace rodeira::opendrive {

inline constexpr double kFound_m = 0.1;  // the lane that lies nearer is meant

// Makes repairs of the file's text for lanes and connections of a network that was built from it; all three arguments
// outlive it.
class LaneRepairs {
 public:
  LaneRepairs(const network::Network& network, std::span<const RoadLines> lines, Source& source);

  // A lane's link to a lane that is not there.
  Repair DropLink(const network::LaneKey& lane, network::End end, int id) const;
  // A connection's way from or to a lane that is not there.
  Repair DropLaneLink(const network::JunctionConnection& connection, const network::JunctionLaneLink& link) const;
  // The whole connection, by its indices in the junction.
  Repair DropConnection(std::size_t junction, std::size_t connection) const;
  // Two lanes that go on into one another with a gap between their edges: kept where a car can drive it.
  Repair GapRepair(const network::LaneEnd& from, const network::LaneEnd& to) const;
  // A lane that goes on nowhere at one end, where exactly one lane lies there: a link to that, and one of its road
  // where that has none or names the wrong end.
  Repair FindLink(const network::LaneEnd& from, const network::LaneEnd& to) const;
  // Whether traffic that leaves one lane at its end enters the other, or the other way round.
  bool LeadOn(const network::LaneEnd& from, const network::LaneEnd& to) const;
  // Whether a car can go from one lane's end into the other, and how far that is aside.
  struct Passing {
    bool drivable = false;
    double kink_rad = 0.0, aside_m = 0.0, ahead_m = 0.0;
  };
  // The farther of both edges' gaps between a lane's end and the lanes of one section that it goes on into, which lie
  // side by side.
  double GapToAll(const network::LaneEnd& from, std::span<const network::LaneEnd> to) const;
  // Seen out of `from`; no number is negative.
  Passing PassingOf(const network::LaneEnd& from, const network::LaneEnd& to) const;

 private:
  Node LaneNode(const network::LaneKey& key) const;
  void Unlink(const network::LaneEnd& from, const network::LaneEnd& to, std::vector<Edit>& edits) const;
  // The only lane of the road that a wrong link names onto which a car can go on, at either end of that road.
  std::optional<network::LaneEnd> MeantBy(const network::LaneEnd& from, const network::LaneEnd& to) const;
  // Where a file names the wrong end of a road, or the wrong one of its lanes: the lane that lies there.
  std::optional<Repair> Relink(const network::LaneEnd& from, const network::LaneEnd& to) const;
  // Takes a connecting road of one lane out, and the links of roads that go on nowhere else.
  Repair DropConnectingRoad(std::uint32_t road) const;

  const network::Network& network_;
  std::span<const RoadLines> lines_;
  Source& source_;
  std::vector<std::vector<Node>> connections_;                              // by junction
  std::map<std::string, std::vector<std::uint32_t>, std::less<>> ways_of_;  // the roads of a junction, by its id
  // Connections by their two roads.
  std::map<std::pair<std::string, std::string>, std::vector<Node>> between_;
};

}  // namespace rodeira::opendrive
