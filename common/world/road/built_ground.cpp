// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/built_ground.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace rodeira::road {
namespace {

constexpr double kTunnelRoof_m = 5.0;  // of a tunnel's mouth, over the road in it

bool IsInTunnel(const network::RoadSpec& road, double s_m) {
  return std::any_of(road.structures.begin(), road.structures.end(), [s_m](const network::Structure& structure) {
    return !structure.bridge && s_m >= structure.s_m && s_m <= structure.s_m + structure.length_m;
  });
}

}  // namespace

bool IsExempt(const network::RoadSpec& road, double s_m) {
  return std::any_of(road.structures.begin(), road.structures.end(), [s_m](const network::Structure& structure) {
    return s_m >= structure.s_m && s_m <= structure.s_m + structure.length_m;
  });
}

bool IsOnBridge(const network::RoadSpec& road, double s_m) {
  return std::any_of(road.structures.begin(), road.structures.end(), [s_m](const network::Structure& structure) {
    return structure.bridge && s_m >= structure.s_m && s_m <= structure.s_m + structure.length_m;
  });
}

BuiltGround::BuiltGround(std::shared_ptr<const network::Network> network, Junctions junctions,
                         const FrictionTable& friction, SurfaceDetail detail, BareTerrain terrain)
    : network_(std::move(network)),
      junctions_(std::move(junctions)),
      friction_(friction),
      detail_(std::move(detail)),
      terrain_(std::move(terrain)),
      grounds_(*network_, friction),
      paint_(*network_),
      earthworks_(network_, junctions_),
      tunnel_sides_(network_) {
  std::set<std::string> made;
  std::vector<Squares::Box> boxes;
  for (const auto& junction : junctions_) {
    made.insert(junction->id());
    boxes.push_back({junction->low_W(), junction->high_W()});
  }
  junction_squares_ = Squares(boxes);
  for (const network::Road& road : network_->roads()) in_junction_.push_back(made.contains(road.spec().junction));
}

std::shared_ptr<const BuiltGround> BuiltGround::With(SurfaceDetail detail) const {
  auto other = std::make_shared<BuiltGround>(*this);
  other->detail_ = std::move(detail);
  return other;
}

SurfacePoint BuiltGround::OnRoad(const network::Surfacing& surfacing) const {
  const network::Place& place = surfacing.place;
  const network::Road& road = network_->roads()[place.lane.road];
  network::SurfaceSample sample = surfacing.sample;
  LaneGround ground = grounds_.At(*network_, place.lane, place.s_m);
  if (paint_.At(place.lane.road, place.s_m, place.t_m)) {
    ground.surface = ground::Surface::kRoadMark;
    ground.friction = friction_[static_cast<std::size_t>(ground.surface)];
  }
  if (!detail_.empty()) {
    detail_.Add(road, place.lane.road, network_->Section(place.lane), place.s_m, place.t_m, sample);
    ground.friction =
        detail_.FrictionAt(place.lane.road, place.s_m, place.t_m, sample.p_W.head<2>()).value_or(ground.friction);
    detail_.Cover(place.lane.road, place.s_m, place.t_m, ground);
  }
  const Eigen::Vector3d normal = sample.ds_W.cross(sample.dt_W);
  const double down = -1.0 / normal.z();
  return {sample.p_W.z(), normal.x() * down, normal.y() * down, ground.friction, ground.surface, true};
}

// What is laid on the roads that go straight on there, one after the other.
void BuiltGround::LayOnJunction(std::span<const network::Surfacing> surfaces, SurfacePoint& point) const {
  thread_local std::vector<const network::Surfacing*> ways;
  ways.clear();
  for (const network::Surfacing& surfacing : surfaces) {
    const network::Place& place = surfacing.place;
    if (in_junction_[place.lane.road] && place.lane.lane != 0 &&
        std::fabs(surfacing.sample.p_W.z() - point.z_m) < network::Network::kLevel_m)
      ways.push_back(&surfacing);
  }
  std::sort(ways.begin(), ways.end(),
            [](const auto* a, const auto* b) { return a->place.lane.road < b->place.lane.road; });
  LaneGround ground{0.0, point.surface, point.friction};
  double rest = 1.0;  // what the ways before leave of the place, and how it changes
  Eigen::Vector2d rest_slope = Eigen::Vector2d::Zero();
  for (const network::Surfacing* way : ways) {
    const network::Place& place = way->place;
    detail_.Cover(place.lane.road, place.s_m, place.t_m, ground);
    const network::Bump::Height raised = detail_.RaisedAt(place.lane.road, place.s_m, place.t_m);
    const network::Road& road = network_->roads()[place.lane.road];
    const geometry::PlanPoint at = road.axis().Evaluate(place.s_m);
    const auto in_world = [&](const auto& of) -> Eigen::Vector2d {
      return of.by_s / (1.0 - at.curvature_1pm * place.t_m) * at.tangent_W + of.by_t * at.left_W();
    };
    Share left;
    const Raised uneven =
        detail_.AddOnWay(road, place.lane.road, network_->Section(place.lane), place.s_m, place.t_m, left);
    const Eigen::Vector2d slope = in_world(raised) + rest * in_world(uneven) + uneven.z_m * rest_slope;
    point.z_m += raised.z_m + rest * uneven.z_m, point.slope_x += slope.x(), point.slope_y += slope.y();
    rest_slope = left.value * rest_slope + rest * in_world(left);
    rest *= left.value;
  }
  point.surface = ground.surface, point.friction = ground.friction;
}

SurfacePoint BuiltGround::OnJunction(const design::JunctionSurface& junction, const Eigen::Vector2d& p_W,
                                     std::span<const network::Surfacing> surfaces) const {
  const design::JunctionHeight height = junction.At(p_W);
  ground::Surface surface = junction.IsPaved(p_W) ? ground::Surface::kAsphalt : ground::Surface::kGrass;
  // What is painted belongs to the ways through it: to the one that a question of the network would find there.
  const network::Surfacing* way = nullptr;
  for (const network::Surfacing& surfacing : surfaces) {
    if (std::fabs(surfacing.place.z_m - height.z_m) > network::Network::kLevel_m) continue;
    if (way == nullptr || surfacing.claim.Before(way->claim)) way = &surfacing;
  }
  if (way != nullptr && in_junction_[way->place.lane.road] &&
      paint_.At(way->place.lane.road, way->place.s_m, way->place.t_m))
    surface = ground::Surface::kRoadMark;
  SurfacePoint point{height.z_m, height.slope_x, height.slope_y, friction_[static_cast<std::size_t>(surface)], surface,
                     true};
  if (!detail_.empty()) LayOnJunction(surfaces, point);
  return point;
}

// The cut before a tunnel's mouth slopes up from the road's own edges: over the tunnel it would begin at the road, and
// a car that drives in would climb it. So there the hill stays, up to its roof.
void BuiltGround::KeepTunnels(std::span<const network::Surfacing> surfaces, const SurfacePoint& bare,
                              SurfacePoint& ground) const {
  for (const network::Surfacing& surfacing : surfaces) {
    const network::Place& place = surfacing.place;
    const double roof_m = surfacing.sample.p_W.z() + kTunnelRoof_m;
    if (place.lane.lane == 0 || ground.z_m >= roof_m ||
        !IsInTunnel(network_->roads()[place.lane.road].spec(), place.s_m))
      continue;
    if (bare.z_m <= roof_m) {
      ground.z_m = bare.z_m, ground.slope_x = bare.slope_x, ground.slope_y = bare.slope_y;
    } else {
      const Eigen::Vector3d normal = surfacing.sample.ds_W.cross(surfacing.sample.dt_W);
      ground.z_m = roof_m, ground.slope_x = -normal.x() / normal.z(), ground.slope_y = -normal.y() / normal.z();
    }
  }
}

std::optional<SurfacePoint> BuiltGround::FloorBeside(const Eigen::Vector2d& p_W, std::span<const Layer> layers) const {
  const std::optional<TunnelSides::Floor> floor = tunnel_sides_.At(p_W);
  if (!floor) return std::nullopt;
  const auto covers = [&](const Layer& layer) { return layer.z_m > floor->z_m; };
  const auto takes_its_place = [&](const Layer& layer) {
    return layer.ground == nullptr && std::fabs(layer.z_m - floor->z_m) < network::Network::kLevel_m;
  };
  if (std::none_of(layers.begin(), layers.end(), covers) || std::any_of(layers.begin(), layers.end(), takes_its_place))
    return std::nullopt;
  constexpr ground::Surface kFloor = ground::Surface::kConcrete;
  return SurfacePoint{
      floor->z_m, floor->slope_W.x(), floor->slope_W.y(), friction_[static_cast<std::size_t>(kFloor)], kFloor, true};
}

SurfacePoint BuiltGround::At(double x_m, double y_m, double z_hint_m) const {
  const Eigen::Vector2d p(x_m, y_m);
  thread_local std::vector<network::Surfacing> surfaces;
  network_->Surfaces(x_m, y_m, surfaces);
  const auto in_junction = [&](const auto& junction) { return junction->Contains(p); };
  const auto first =
      junction_squares_.MayHold(p) ? std::find_if(junctions_.begin(), junctions_.end(), in_junction) : junctions_.end();
  const auto exempt = [&](const network::Place& place) {
    return IsExempt(network_->roads()[place.lane.road].spec(), place.s_m);
  };
  const auto answers = [&](const network::Place& place) {
    return !in_junction_[place.lane.road] && place.lane.lane != 0;
  };
  if (first == junctions_.end() && surfaces.size() == 1 && answers(surfaces[0].place) && !exempt(surfaces[0].place) &&
      !tunnel_sides_.MayHold(p)) {
    return OnRoad(surfaces[0]);  // nothing else is here, and the hint has nothing to choose
  }
  thread_local std::vector<Layer> layers;
  layers.clear();
  for (auto junction = first; junction != junctions_.end(); ++junction) {
    if (junction == first || in_junction(*junction))
      layers.push_back({(*junction)->At(p).z_m, nullptr, junction->get(), nullptr});
  }
  bool covered = !layers.empty();  // by what stands on the ground
  for (const network::Surfacing& surfacing : surfaces) {
    const network::Place& place = surfacing.place;
    if (!answers(place)) continue;
    // Beyond the end of a road at a junction the junction answers.
    const bool above = exempt(place);
    if (covered && !above && layers[0].junction != nullptr &&
        std::fabs(layers[0].z_m - surfacing.sample.p_W.z()) < network::Network::kLevel_m) {
      continue;
    }
    covered = covered || !above;
    layers.push_back({surfacing.sample.p_W.z(), &surfacing, nullptr, nullptr});
  }
  SurfacePoint ground;
  if (!covered) {
    ground = terrain_.At(x_m, y_m);
    if (ground.inside) {
      const SurfacePoint bare = ground;
      earthworks_.Shape(p, ground);
      if (ground.z_m < bare.z_m) KeepTunnels(surfaces, bare, ground);
      layers.push_back({ground.z_m, nullptr, nullptr, &ground});
    }
  }
  const std::optional<SurfacePoint> floor = FloorBeside(p, layers);
  if (floor) layers.push_back({floor->z_m, nullptr, nullptr, &*floor});
  if (layers.empty()) return {};
  std::stable_sort(layers.begin(), layers.end(), [](const Layer& a, const Layer& b) { return a.z_m > b.z_m; });
  const Layer* chosen = &layers.back();
  for (const Layer& layer : layers) {
    if (layer.z_m > z_hint_m + ground::kMaxAboveHint_m) continue;  // NaN: the first
    chosen = &layer;
    break;
  }
  if (chosen->road != nullptr) return OnRoad(*chosen->road);
  return chosen->junction != nullptr ? OnJunction(*chosen->junction, p, surfaces) : *chosen->ground;
}

}  // namespace rodeira::road
