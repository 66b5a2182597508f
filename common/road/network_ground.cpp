#include "common/road/network_ground.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/plane.hpp"
#include "common/network/junction_ground.hpp"
#include "common/road/one_ground.hpp"

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
    if (detail != nullptr) detail->Add(network.roads()[at.lane.road], at.lane.road, network.Section(at.lane), at.s_m, at.t_m, sample);
    if (road == layer.named) p_W = sample.p_W.head<2>();
    heights.push_back(HeightOf(sample));
  }
  const PlaneHeight height = layer.Mean(heights);
  const network::Place& place = layer.named->place;
  LaneGround ground = grounds.At(network, place.lane, place.s_m);
  if (paint != nullptr && paint->At(place.lane.road, place.lane.section, place.s_m, place.t_m)) {
    ground.surface = terrain::Surface::kRoadMark;
    ground.friction = friction[static_cast<std::size_t>(ground.surface)];
  }
  if (detail != nullptr) {
    ground.friction = detail->FrictionAt(place.lane.road, place.s_m, place.t_m, p_W).value_or(ground.friction);
    detail->Cover(place.lane.road, place.s_m, place.t_m, ground);
  }
  return {height.z_m, height.slope_W.x(), height.slope_W.y(), ground.friction, ground.surface, true};
}

// Within a junction that has a ground of its own, between its connecting roads.
SurfacePoint OnJunction(const network::JunctionGround& ground, const FrictionTable& friction, const Eigen::Vector2d& p) {
  const network::GroundHeight at = ground.At(p);
  return {at.z_m, at.slope_x, at.slope_y, friction[static_cast<std::size_t>(terrain::Surface::kAsphalt)], terrain::Surface::kAsphalt, true};
}

SurfacePoint OnVerge(const Network& network, const FrictionTable& friction, const Eigen::Vector2d& p, const Place& place) {
  const network::Road& road = network.roads()[place.lane.road];
  const network::LaneSection& section = network.Section(place.lane);
  double outside = 0.0;
  const geometry::CubicPoint centre = road.CentreAt(place.s_m);
  const network::LaneSpan span = section.At(place.t_m, centre, place.s_m, outside);
  const double edge = place.t_m + (place.t_m > centre.value ? -outside : outside);
  const network::SurfaceSample sample = road.Surface(place.s_m, edge, section, span);
  SurfacePoint point{sample.p_W.z(),           0.0, 0.0, friction[static_cast<std::size_t>(terrain::Surface::kGrass)],
                     terrain::Surface::kGrass, true};
  const geometry::PlanPoint axis = road.axis().Evaluate(place.s_m);
  const Eigen::Vector2d away = p - sample.p_W.head<2>();
  const double pace = sample.ds_W.head<2>().norm() - axis.curvature_1pm * geometry::Cross(axis.tangent_W, away);
  const bool alongside = std::fabs(axis.tangent_W.dot(away)) <= 1e-6 + 1e-9 * away.norm();
  if (alongside && pace > 0.0) {  // the height goes along with the road's
    point.slope_x = sample.ds_W.z() / pace * axis.tangent_W.x();
    point.slope_y = sample.ds_W.z() / pace * axis.tangent_W.y();
  }
  return point;
}

// What answers at a point: a layer of roads, a junction's own ground, or the verge beside a place; null all of them: nothing is there.
struct Answer {
  const Layer* layer = nullptr;
  const network::JunctionGround* between = nullptr;
  std::optional<Place> beside;
};

// verge_z: how high the verge beside a place lies. The layers hold until the next question of this thread.
template <class VergeHeight>
Answer Find(const Network& network, const Eigen::Vector2d& p_W, double z_hint_m, const VergeHeight& verge_z) {
  thread_local std::vector<network::Surfacing> surfaces;
  network.Surfaces(p_W.x(), p_W.y(), surfaces);
  const network::JunctionGround* open = network.GroundAt(p_W);
  const double between_z = open == nullptr ? 0.0 : open->At(p_W).z_m;
  const bool meant = open != nullptr && !(between_z > z_hint_m + terrain::kHintAbove_m);
  thread_local std::vector<Layer> layers;
  std::size_t count;
  FindLayers(network, surfaces, open == nullptr, layers, count);  // where a road goes on over a gap, the junction lies
  const Layer* lowest = nullptr;
  for (const Layer& layer : std::span(layers).first(count)) {
    const bool its_own = open != nullptr && network.roads()[layer.named->place.lane.road].spec().ground.get() == open;
    if (meant && between_z > layer.z_m && !its_own) return {nullptr, open, {}};
    if (!(layer.z_m > z_hint_m + terrain::kHintAbove_m)) return {&layer, nullptr, {}};  // NaN: the first
    lowest = &layer;
  }
  if (meant) return {nullptr, open, {}};
  const auto place = network.Locate(p_W.x(), p_W.y(), std::isfinite(z_hint_m) ? std::optional(z_hint_m) : std::nullopt);
  if (!place || place->distance_m > kVerge_m) return {lowest, nullptr, {}};
  if (lowest != nullptr && verge_z(*place) > z_hint_m + terrain::kHintAbove_m) return {lowest, nullptr, {}};
  return {nullptr, nullptr, place};
}

}  // namespace

SurfacePoint NetworkGround(const Network& network, const LaneGrounds& grounds, const FrictionTable& friction, double x_m, double y_m,
                           double z_hint_m, const MarkPaint* paint, const SurfaceDetail* detail) {
  const Eigen::Vector2d p_W(x_m, y_m);
  const auto verge = [&](const Place& place) { return OnVerge(network, friction, p_W, place); };
  const Answer answer = Find(network, p_W, z_hint_m, [&](const Place& place) { return verge(place).z_m; });
  if (answer.layer != nullptr) return OnLayer({network, grounds, friction, paint, detail}, *answer.layer);
  if (answer.between != nullptr) return OnJunction(*answer.between, friction, p_W);
  return answer.beside ? verge(*answer.beside) : SurfacePoint{};
}

std::optional<Place> NetworkPlace(const Network& network, double x_m, double y_m, double z_hint_m) {
  const Eigen::Vector2d p_W(x_m, y_m);
  const Answer answer = Find(network, p_W, z_hint_m, [&](const Place& place) { return OnVerge(network, kUsualFriction, p_W, place).z_m; });
  if (answer.layer != nullptr) return answer.layer->named->place;
  return answer.between != nullptr ? std::nullopt : answer.beside;
}

Extents NetworkExtents(const Network& network) {
  const auto [low, high] = network.Bounds();
  return {low.x() - kVerge_m, low.y() - kVerge_m, high.x() + kVerge_m, high.y() + kVerge_m};
}

}  // namespace rodeira::road
