// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/traffic/demand/demand_settings.hpp"
#include "common/world/lanes/edge_marks.hpp"
#include "common/world/lanes/graph.hpp"

namespace rodeira::traffic {

// Roads that are passed one after the other, as a table: for each leg (how many of them have been reached) and track
// the way that is left to the last one, lanes changed on the way counted as kChange_m each.
class Route {
 public:
  static constexpr double kChange_m = 300.0;

  // Wrong input where the roads are unknown, or no way leads from one to the next; `place` says where they stand.
  static base::Result<Route> Make(const lanes::Graph& graph, const lanes::EdgeMarks& marks,
                                  const RouteSettings& settings);

  // Whether its end can be reached from a track, by changes of lanes where marks allow them.
  bool Reaches(std::uint32_t leg, std::uint32_t track) const { return At(leg, track).left_m < kNever_m; }
  // The leg of a vehicle on a track, having been on this one: further by every road that the track belongs to.
  std::uint32_t LegOn(std::uint32_t leg, std::uint32_t track) const;
  // The link that leads on best; nothing where none does.
  std::optional<std::size_t> LinkOn(const lanes::Graph& graph, std::uint32_t leg, std::uint32_t track) const;
  // How many changes of lanes lie ahead, and whether the next one must be made on this track.
  int Changes(std::uint32_t leg, std::uint32_t track) const { return At(leg, track).changes; }
  bool MustChange(std::uint32_t leg, std::uint32_t track) const { return At(leg, track).must_change; }
  std::uint32_t legs() const { return static_cast<std::uint32_t>(reached_.size()); }

 private:
  static constexpr double kNever_m = 1e18;
  struct Left {
    double left_m = kNever_m;
    int changes = 0;
    bool must_change = false;
  };
  const Left& At(std::uint32_t leg, std::uint32_t track) const { return left_[leg][track]; }
  void FindWays(const lanes::Graph& graph, const lanes::EdgeMarks& marks, std::uint32_t leg);

  std::vector<std::vector<bool>> reached_;  // by leg and track: the track belongs to the road that the leg leads to
  std::vector<std::vector<Left>> left_;     // by leg and track; the last one, when all have been reached: 0 everywhere
};

// Demand of a network: the flows of vehicles, with the track where each enters and its route.
class Demand {
 public:
  // A flow of the settings, with its indices in the network.
  struct Flow {
    std::int64_t track = -1;  // where its vehicles enter; below 0: a random one of the network's entries
    std::int64_t route = -1;
  };

  // Wrong input, a sentence with file and line, where a lane or road is unknown, a route is not there or cannot be
  // driven.
  static base::Result<Demand> Make(const lanes::Graph& graph, const lanes::EdgeMarks& marks,
                                   const DemandSettings& settings);

  const std::vector<Flow>& flows() const { return flows_; }
  // Precondition: a number of Flow::route that is not below 0.
  const Route& route(std::int64_t number) const { return routes_[static_cast<std::size_t>(number)]; }
  // By what chance the links of a track are taken, one after the other added up to 1; empty: all alike.
  std::span<const double> Shares(std::uint32_t track) const {
    return shares_.empty() ? std::span<const double>() : shares_[track];
  }

 private:
  std::vector<Flow> flows_;
  std::vector<Route> routes_;
  std::vector<std::vector<double>> shares_;  // by track
};

// The tracks of ROAD or ROAD:LANE, in the order in which traffic comes to them; wrong input, with the nearest name,
// where there are none.
base::Result<std::vector<std::uint32_t>> TracksOf(const lanes::Graph& graph, const std::string& way,
                                                  const std::string& place);

}  // namespace rodeira::traffic
