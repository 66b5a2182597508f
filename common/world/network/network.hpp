// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/world/network/band_index.hpp"
#include "common/world/network/band_record.hpp"
#include "common/world/network/junction.hpp"
#include "common/world/network/road.hpp"

namespace rodeira::network {

struct Cluster;

// A lane of one lane section: indices into Network::roads() and RoadSpec::sections, and the lane's id.
struct LaneKey {
  std::uint32_t road = 0;
  std::uint32_t section = 0;
  int lane = 0;

  auto operator<=>(const LaneKey&) const = default;
};

// A lane that another one goes on into, and the end of it that is met.
struct LaneEnd {
  LaneKey lane;
  End end = End::kStart;

  auto operator<=>(const LaneEnd&) const = default;
};

// Where a point lies in the network.
struct Place {
  LaneKey lane;      // lane 0: a road without lanes on that side
  double s_m = 0.0;  // station along the road's axis
  double t_m = 0.0;  // across it, positive to the left as seen along s
  double z_m = 0.0;  // of the surface there
  double distance_m =
      0.0;  // from the lanes, across the road; farther than kLevel_m above or below counts too. 0: on it
};

// What a caller may keep between its questions. It makes the next answer faster and never another one.
struct Hint {
  std::uint32_t band = std::numeric_limits<std::uint32_t>::max();
};

// What decides between places that hold the same point on one level.
struct Claim {
  bool past_end = false;  // in a gap that is closed
  bool drivable = false;
  double from_centre_m = 0.0;  // of the lane
  std::uint32_t band = 0;

  bool Before(const Claim& other) const;  // the better one
};

// A road's surface over or under a point.
struct Surfacing {
  Place place;
  SurfaceSample sample;
  Claim claim;
};

// How a network's coordinates lie in those of its geo reference: turned by the heading, then moved.
struct GeoOffset {
  double x_m = 0.0, y_m = 0.0;
  double heading_rad = 0.0;

  // From the network's coordinates to those of the geo reference, in metres, and back.
  Eigen::Vector2d ToMap(const Eigen::Vector2d& p_W) const;
  // The inverse of ToMap.
  Eigen::Vector2d FromMap(const Eigen::Vector2d& p_map) const;
};

// What a reader of a file makes a network of; links and sign speeds are found by Network.
struct NetworkSpec {
  std::string name;
  std::string geo_reference;  // PROJ or WKT text; empty: none
  GeoOffset geo_offset;
  std::vector<Road> roads;
  std::vector<Junction> junctions;
  std::vector<Controller> controllers;
};

// Roads and junctions, what goes on into what, and where a point lies. Immutable: every answer is a pure function of
// it, on any number of threads. Stations s, offsets t and coordinates are metres; a LaneKey that is handed over must
// name a lane of the network, except for Find.
class Network {
 public:
  // Two surfaces nearer than this in height are one level; a point this far over a road is still on it.
  static constexpr double kLevel_m = 2.0;
  // Gaps up to this between elements and between roads are closed.
  static constexpr double kClosed_m = 0.05;

  // No coordinate of a road or a question is as large.
  static constexpr double kFarthest_m = 1e8;

  explicit Network(NetworkSpec spec);
  Network(const Network&) = delete;  // records point into the roads
  Network& operator=(const Network&) = delete;

  const std::string& name() const { return spec_.name; }
  const std::string& geo_reference() const { return spec_.geo_reference; }
  const GeoOffset& geo_offset() const { return spec_.geo_offset; }
  std::span<const Road> roads() const { return spec_.roads; }
  std::span<const Junction> junctions() const { return spec_.junctions; }
  std::span<const Controller> controllers() const { return spec_.controllers; }
  // The index of the road or junction with this id; nothing where there is none.
  std::optional<std::uint32_t> FindRoad(std::string_view id) const;
  std::optional<std::uint32_t> FindJunction(std::string_view id) const;
  // The ground of the junction with a boundary that holds a point; null where none does.
  const JunctionGround* GroundAt(const Eigen::Vector2d& p_W) const;

  // The lane at (x, y), on the level of z (without z: the top one). Of several that overlap, as in a junction: a
  // drivable one, then the one with the nearest middle, then the first road. Beside all roads: the nearest. Nothing
  // where there is no road, or a coordinate is not finite or beyond kFarthest_m.
  std::optional<Place> Locate(double x_m, double y_m, std::optional<double> z_m = std::nullopt,
                              Hint* hint = nullptr) const;
  // The same without any index or record, for tests.
  std::optional<Place> LocateSlowly(double x_m, double y_m, std::optional<double> z_m = std::nullopt) const;
  // Every road's surface at (x, y), from the highest to the lowest.
  void Surfaces(double x_m, double y_m, std::vector<Surfacing>& surfaces) const;

  // The same of points close to one another, where one road's surface alone lies at all of them, and no other road is
  // near: to the bit what Surfaces says of each. False, and then nothing is known, where that is not so, or not told so
  // quickly.
  bool QueryBatch(Cluster& cluster) const;

  // Visits the panels of all roads with lanes that may lie within reach_m of (x, y): visit(road, panel of its axis).
  template <class Visit>
  void Near(const Eigen::Vector2d& p_W, double reach_m, const Visit& visit) const {
    index_.Nearest(p_W, reach_m,
                   [&](std::uint32_t band) { visit(index_.bands()[band].road, index_.bands()[band].panel); });
  }

  // The lane section that holds the lane.
  const LaneSection& Section(const LaneKey& key) const { return roads()[key.road].spec().sections[key.section]; }
  // The lane; null where the network has none of that key.
  const Lane* Find(const LaneKey& key) const;
  // The lane's edges at s, which is held within its section; nothing for the centre or a lane that is not there.
  std::optional<LaneSpan> Span(const LaneKey& key, double s_m) const {
    return roads()[key.road].SpanAt(key.section, key.lane, s_m);
  }
  // The point on the surface in the middle of a lane at s, in W. s is held within the lane's section.
  Eigen::Vector3d Centre(const LaneKey& key, double s_m) const;
  // The lanes that a lane goes on into at its end, and at its start; junctions are passed through. Ascending.
  std::span<const LaneEnd> AtEnd(const LaneKey& key) const;
  std::span<const LaneEnd> AtStart(const LaneKey& key) const;
  // Those in the direction of the lane's traffic, and where it comes from. Lanes of both directions: as along s.
  std::span<const LaneEnd> Successors(const LaneKey& key) const;
  std::span<const LaneEnd> Predecessors(const LaneKey& key) const;
  // The lane beside on the left and right as seen along s; nothing at the road's edge. The centre is passed over.
  std::optional<LaneKey> Left(const LaneKey& key) const;
  std::optional<LaneKey> Right(const LaneKey& key) const;
  // A lane of another road that shares this one's side, and whether its road's s runs the same way; nothing where only
  // one of both says so.
  struct Sharing {
    LaneKey lane;
    bool same_way = true;
  };
  std::optional<Sharing> SharingLeft(const LaneKey& key) const { return SharingOf(key, &Lane::left_beside); }
  std::optional<Sharing> SharingRight(const LaneKey& key) const { return SharingOf(key, &Lane::right_beside); }
  // The corners of a box that holds every road's surface.
  std::pair<Eigen::Vector2d, Eigen::Vector2d> Bounds() const { return {index_.low_W(), index_.high_W()}; }
  // A lane's number, the centres' too: dense, below LaneNumbers().
  std::size_t Number(const LaneKey& key) const;
  std::size_t LaneNumbers() const { return ends_.size(); }
  // Every lane but the centres, in ascending order of road, section and id.
  std::vector<LaneKey> Lanes() const;

 private:
  struct Hit;
  struct Ends {
    std::vector<LaneEnd> at_start, at_end;
  };
  Hit Try(const Eigen::Vector2d& p_W, std::uint32_t band) const;
  // The same bits, asked of the road.
  Hit TryRoad(const Eigen::Vector2d& p_W, std::uint32_t band) const;
  SurfaceSample SurfaceAt(const Hit& hit) const;
  void SetHeight(std::optional<double> z_m, Hit& hit) const;
  std::optional<Place> Choose(std::vector<Hit>& hits, bool known_height) const;
  std::optional<Sharing> SharingOf(const LaneKey& key, std::optional<LaneName> Lane::*side) const;
  void Link();
  void LinkEnd(const LaneKey& lane, const std::vector<int>& targets, bool at_end);
  void LinkJunctions();
  void SetSignSpeeds();
  void Join(const LaneEnd& a, const LaneEnd& b);

  NetworkSpec spec_;
  std::map<std::string, std::uint32_t, std::less<>> road_by_id_, junction_by_id_;
  std::vector<const JunctionGround*> grounds_;
  BandIndex index_;
  BandRecords records_;
  std::vector<std::vector<std::uint32_t>> first_lane_;  // by road and section: the number of its lane of lowest id
  std::vector<Ends> ends_;                              // by the lane's number
};

}  // namespace rodeira::network
