// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/network_ground.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/world/network/junction_ground.hpp"
#include "common/world/road/one_ground.hpp"

namespace rodeira::road {
namespace {

using network::Network;
using network::Place;

// What a point on a road is answered from.
struct Source {
  const Network& network;
  const LaneGrounds& grounds;
  const FrictionTable& friction;
  const MarkPaint* paint;
  const SurfaceDetail* detail;
};

SurfacePoint OnLayer(const Source& source, const Layer& layer) {
  const auto& [network, grounds, friction, paint, detail] = source;
  thread_local std::vector<PlaneHeight> heights;
  heights.clear();
  Eigen::Vector2d p_W = Eigen::Vector2d::Zero();
  for (const network::Surfacing* road : layer.roads) {
    network::SurfaceSample sample = road->sample;
    const network::Place& at = road->place;
    if (detail != nullptr)
      detail->Add(network.roads()[at.lane.road], at.lane.road, network.Section(at.lane), at.s_m, at.t_m, sample);
    if (road == layer.named) p_W = sample.p_W.head<2>();
    heights.push_back(HeightOf(sample));
  }
  const PlaneHeight height = layer.Mean(heights);
  const network::Place& place = layer.named->place;
  LaneGround ground = grounds.At(network, place.lane, place.s_m);
  if (paint != nullptr && paint->At(place.lane.road, place.lane.section, place.s_m, place.t_m)) {
    ground.surface = ground::Surface::kRoadMark;
    ground.friction = friction[static_cast<std::size_t>(ground.surface)];
  }
  if (detail != nullptr) {
    ground.friction = detail->FrictionAt(place.lane.road, place.s_m, place.t_m, p_W).value_or(ground.friction);
    detail->Cover(place.lane.road, place.s_m, place.t_m, ground);
  }
  return {height.z_m, height.slope_W.x(), height.slope_W.y(), ground.friction, ground.surface, true};
}

// Within a junction that has a ground of its own, between its connecting roads.
SurfacePoint OnJunction(const network::JunctionGround& ground, const FrictionTable& friction,
                        const Eigen::Vector2d& p) {
  const network::GroundHeight at = ground.At(p);
  return {at.z_m,
          at.slope_x,
          at.slope_y,
          friction[static_cast<std::size_t>(ground::Surface::kAsphalt)],
          ground::Surface::kAsphalt,
          true};
}

SurfacePoint OnLand(const PlaneHeight& land, const FrictionTable& friction) {
  return {land.z_m,
          land.slope_W.x(),
          land.slope_W.y(),
          friction[static_cast<std::size_t>(ground::Surface::kGrass)],
          ground::Surface::kGrass,
          true};
}

// What answers at a point: a layer of roads, a junction's own ground, or the land; none of them: nothing is there.
struct Answer {
  const Layer* layer = nullptr;
  const network::JunctionGround* between = nullptr;
  std::optional<PlaneHeight> land;
};

// The layers hold until the next question of this thread.
Answer Find(const Network& network, const NetworkLand& land, const Eigen::Vector2d& p_W, double z_hint_m) {
  thread_local std::vector<network::Surfacing> surfaces;
  network.Surfaces(p_W.x(), p_W.y(), surfaces);
  const network::JunctionGround* open = network.GroundAt(p_W);
  const double between_z = open == nullptr ? 0.0 : open->At(p_W).z_m;
  const bool meant = open != nullptr && !(between_z > z_hint_m + ground::kMaxAboveHint_m);
  thread_local std::vector<Layer> layers;
  std::size_t count;
  FindLayers(network, surfaces, open == nullptr, layers, count);  // where a road goes on over a gap, the junction lies
  const Layer* lowest = nullptr;
  for (const Layer& layer : std::span(layers).first(count)) {
    const bool its_own = open != nullptr && network.roads()[layer.named->place.lane.road].spec().ground.get() == open;
    if (meant && between_z > layer.z_m && !its_own) return {nullptr, open, {}};
    if (!(layer.z_m > z_hint_m + ground::kMaxAboveHint_m)) return {&layer, nullptr, {}};  // NaN: the first
    lowest = &layer;
  }
  if (meant) return {nullptr, open, {}};
  if (lowest != nullptr) {
    const auto on_deck = [&](const network::Surfacing* road) {
      return land.IsOnDeck(road->place.lane.road, road->place.s_m);
    };
    if (!std::all_of(lowest->roads.begin(), lowest->roads.end(), on_deck)) return {lowest, nullptr, {}};
  }
  const std::optional<PlaneHeight> below = land.At(p_W);
  if (lowest != nullptr && !(below && below->z_m < lowest->z_m)) return {lowest, nullptr, {}};
  return {nullptr, nullptr, below};
}

}  // namespace

SurfacePoint NetworkGround(const Network& network, const LaneGrounds& grounds, const NetworkLand& land,
                           const FrictionTable& friction, double x_m, double y_m, double z_hint_m,
                           const MarkPaint* paint, const SurfaceDetail* detail) {
  const Eigen::Vector2d p_W(x_m, y_m);
  const Answer answer = Find(network, land, p_W, z_hint_m);
  if (answer.layer != nullptr) return OnLayer({network, grounds, friction, paint, detail}, *answer.layer);
  if (answer.between != nullptr) return OnJunction(*answer.between, friction, p_W);
  return answer.land ? OnLand(*answer.land, friction) : SurfacePoint{};
}

std::optional<Place> NetworkPlace(const Network& network, const NetworkLand& land, double x_m, double y_m,
                                  double z_hint_m) {
  const Answer answer = Find(network, land, {x_m, y_m}, z_hint_m);
  if (answer.layer != nullptr) return answer.layer->named->place;
  if (!answer.land) return std::nullopt;
  return network.Locate(x_m, y_m, answer.land->z_m);
}

Extents NetworkExtents(const Network& network) {
  const auto [low, high] = network.Bounds();
  return {low.x() - kVerge_m, low.y() - kVerge_m, high.x() + kVerge_m, high.y() + kVerge_m};
}

}  // namespace rodeira::road
