// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/world/design/junction_surface.hpp"
#include "common/world/network/network.hpp"
#include "common/world/road/bare_terrain.hpp"
#include "common/world/road/earthworks.hpp"
#include "common/world/road/lane_grounds.hpp"
#include "common/world/road/paint.hpp"
#include "common/world/road/squares.hpp"
#include "common/world/road/surface_detail.hpp"
#include "common/world/road/surface_point.hpp"
#include "common/world/road/tunnel_sides.hpp"

namespace rodeira::road {

// SUELO of a network that is built into a terrain: road surfaces, junctions, and the terrain, cut and filled to meet
// them. Where several lie over one another, the highest that is not more than 0.5 m above the hint answers, without a
// hint the highest. The ground itself is under bridges and over tunnels; elsewhere a road takes its place. Under the
// hill beside a tunnel's road lies its floor, for some metres.
class BuiltGround {
 public:
  using Junctions = std::vector<std::shared_ptr<const design::JunctionSurface>>;
  BuiltGround(std::shared_ptr<const network::Network> network, Junctions junctions, const FrictionTable& friction,
              SurfaceDetail detail, BareTerrain terrain);

  const Junctions& junctions() const { return junctions_; }
  // The same ground with something else on its roads.
  std::shared_ptr<const BuiltGround> With(SurfaceDetail detail) const;

  // SUELO at (x, y) in W: altitude, normal, friction and surface.
  SurfacePoint At(double x_m, double y_m, double z_hint_m) const;
  // The same of points close to one another, where they lie on one road alone; its surface then answers whatever the
  // hints: to the bit what At says of each. False, and then nothing is written, where that is not so or not told so
  // quickly. Spans of equal length, of Cluster::kMost at most.
  bool QueryBatch(std::span<const ground::GroundQuery> queries, std::span<ground::GroundPoint> points) const;

 private:
  // A surface over or under a point.
  struct Layer {
    double z_m;
    const network::Surfacing* road;           // or
    const design::JunctionSurface* junction;  // or
    const SurfacePoint* ground;               // the terrain, or the floor beside a tunnel
  };

  bool OneRoadAlone(const network::Cluster& cluster) const;
  SurfacePoint OnRoad(const network::Surfacing& surfacing) const;
  SurfacePoint OnJunction(const design::JunctionSurface& junction, const Eigen::Vector2d& p_W,
                          std::span<const network::Surfacing> surfaces) const;
  void KeepTunnels(std::span<const network::Surfacing> surfaces, const SurfacePoint& bare, SurfacePoint& ground) const;
  // The floor beside a tunnel at a place, under what lies higher there. Nothing where another road lies on its level.
  std::optional<SurfacePoint> FloorBeside(const Eigen::Vector2d& p_W, std::span<const Layer> layers) const;
  void LayOnJunction(std::span<const network::Surfacing> surfaces, SurfacePoint& point) const;

  std::shared_ptr<const network::Network> network_;
  Junctions junctions_;
  FrictionTable friction_;
  SurfaceDetail detail_;
  BareTerrain terrain_;
  LaneGrounds grounds_;
  Paint paint_;
  Earthworks earthworks_;
  TunnelSides tunnel_sides_;
  Squares junction_squares_;
  std::vector<bool> in_junction_;  // by road: its surface is a junction's
};

// Whether a road is carried by a bridge or runs in a tunnel at s.
bool IsExempt(const network::RoadSpec& road, double s_m);
// Whether a bridge carries it there.
bool IsOnBridge(const network::RoadSpec& road, double s_m);

}  // namespace rodeira::road
