// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "common/world/lanes/curve.hpp"
#include "common/world/network/network.hpp"

namespace rodeira::lanes {

// How a track goes on: where its end lies in the frame of the next one's beginning.
struct Link {
  std::uint32_t to = 0;
  double from_d_m = 0.0;  // d on the next track beside this one's end; gaps of the file may make it other than 0
  double offset_m = 0.0;  // this one's end lies so far to the left of the next one's middle
  double slope = 0.0;     // tangent of the angle by which this one's end points farther to the left
  bool joins = false;     // this lane ends, and its traffic goes over into the lane beside
};

// A drivable lane of one lane section as its traffic uses it.
struct Track {
  network::LaneKey lane;
  bool along = true;  // with growing s of the road
  Curve curve;
  std::vector<Link> next;             // ascending by `to`
  std::vector<std::uint32_t> before;  // tracks that lead here; ascending
  std::optional<std::uint32_t> left,
      right;                   // beside it in the same direction, on its own road or on one that shares that side
  std::int32_t junction = -1;  // index into Network::junctions() for a connecting road's lane
  bool entry = false;          // traffic may enter the network here, at its beginning
  bool left_hand = false;

  double length_m() const { return curve.length_m(); }
};

// A node of a track's curve.
struct NodeKey {
  std::uint32_t track = 0;
  std::uint32_t node = 0;

  auto operator<=>(const NodeKey&) const = default;
};

// The drivable lanes of a network as a directed graph. Lanes of both directions are driven on the side of the road's
// rule. A lane that narrows to an end beside another one goes on into that one, and one that opens beside another is
// entered from where that one is. A lane on which the network lets vehicles end goes on into nothing, whatever its file
// links it to. A two-way turning lane (a lane of both directions beside lanes of one) carries no traffic. Immutable:
// any number of threads may ask. Distances d run along a track's middle from its beginning, metres. The network must
// outlive it.
class Graph {
 public:
  explicit Graph(const network::Network& network);

  const network::Network& network() const { return *network_; }
  const std::vector<Track>& tracks() const { return tracks_; }
  const Track& operator[](std::uint32_t track) const { return tracks_[track]; }
  // The lane's track, an index into tracks(); nothing where the lane is not driven on.
  std::optional<std::uint32_t> Find(const network::LaneKey& lane) const;
  // Whether the network says itself where vehicles begin; then those are the entries, all of them and no others.
  bool says_entries() const { return says_entries_; }
  // The limit at d, within what a car may drive where the network says none (50 km/h) or is without limit (130 km/h).
  double SpeedLimit_mps(std::uint32_t track, double d_m) const;

  // The distance along a track beside it, of the same lane section or of a road that shares a side, that lies beside
  // `d_m` of this one, in metres; beyond the ends as far as there. The two must lie beside one another.
  double Across(std::uint32_t track, double d_m, std::uint32_t beside) const;

  // The track with traffic that comes towards this one's beside it on the left (in left-hand traffic: on the right).
  std::optional<std::uint32_t> Oncoming(std::uint32_t track) const;

  // Every node within radius of (x, y) in W, by track and node, in place of what `nodes` held.
  void Near(const Eigen::Vector2d& p_W, double radius_m, std::vector<NodeKey>& nodes) const;

  // Where a point of W lies beside a track.
  struct Beside {
    std::uint32_t track = 0;
    Curve::Foot foot;
  };
  // Of each track with a node within radius its foot at the node that is nearest to the point, by ascending track.
  std::vector<Beside> TracksAt(const Eigen::Vector2d& p_W, double radius_m) const;

 private:
  void AddTracks();
  std::optional<std::uint32_t> BesideOf(const Track& track, bool left, bool same_way) const;
  void AddAllFeet();
  void AddFeet(std::uint32_t track, std::uint32_t beside, bool same_way);
  void LinkLanes();
  void LinkEndingLanes();
  void AddLink(std::uint32_t from, std::uint32_t to, double to_d_m, bool joins);
  void FindEntries();
  void BuildGrid();

  struct Cell {
    std::int64_t x, y;
    NodeKey node;
    auto operator<=>(const Cell&) const = default;
  };
  // Where a track of another road lies beside one, at its beginning and every so many metres.
  struct Feet {
    std::uint32_t track, beside;
    double apart_m;
    bool same_way;
    std::vector<double> d_m;
  };
  const network::Network* network_;
  std::vector<Track> tracks_;
  std::vector<Feet> feet_;   // by track, then beside
  std::vector<Cell> cells_;  // ascending
  bool says_entries_ = false;
};

}  // namespace rodeira::lanes
