#include "common/road/network_ground.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/plane.hpp"
#include "common/network/junction_ground.hpp"

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

SurfacePoint OnRoad(const Source& source, const network::Surfacing& surfacing) {
  const auto& [network, grounds, friction, paint, detail] = source;
  network::SurfaceSample sample = surfacing.sample;
  const network::Place& place = surfacing.place;
  if (detail != nullptr) {
    detail->Add(network.roads()[place.lane.road], place.lane.road, network.Section(place.lane), place.s_m, place.t_m, sample);
  }
  const Eigen::Vector3d normal = sample.ds_W.cross(sample.dt_W);
  LaneGround ground = grounds.At(network, place.lane, place.s_m);
  if (paint != nullptr && paint->At(place.lane.road, place.lane.section, place.s_m, place.t_m)) {
    ground.surface = terrain::Surface::kRoadMark;
    ground.friction = friction[static_cast<std::size_t>(ground.surface)];
  }
  const auto measured = detail == nullptr ? std::nullopt : detail->FrictionAt(place.lane.road, place.s_m, place.t_m, sample.p_W.head<2>());
  return {sample.p_W.z(), -normal.x() / normal.z(), -normal.y() / normal.z(), measured.value_or(ground.friction), ground.surface, true};
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

}  // namespace

SurfacePoint NetworkGround(const Network& network, const LaneGrounds& grounds, const FrictionTable& friction, double x_m, double y_m,
                           double z_hint_m, const MarkPaint* paint, const SurfaceDetail* detail) {
  const Source source{network, grounds, friction, paint, detail};
  thread_local std::vector<network::Surfacing> surfaces;
  network.Surfaces(x_m, y_m, surfaces);
  const network::JunctionGround* open = network.GroundAt({x_m, y_m});
  const SurfacePoint between = open == nullptr ? SurfacePoint{} : OnJunction(*open, friction, {x_m, y_m});
  const bool meant = open != nullptr && !(between.z_m > z_hint_m + terrain::kHintAbove_m);
  const network::Surfacing* lowest = nullptr;
  for (const network::Surfacing& surfacing : surfaces) {
    if (surfacing.place.lane.lane == 0) continue;  // a road without lanes on that side
    if (open != nullptr && surfacing.claim.past_end) continue;  // a road goes on over a gap; the junction lies there
    const double z = surfacing.sample.p_W.z();
    const bool its_own = open != nullptr && network.roads()[surfacing.place.lane.road].spec().ground.get() == open;
    if (meant && between.z_m > z && !its_own) return between;
    if (!(z > z_hint_m + terrain::kHintAbove_m)) return OnRoad(source, surfacing);  // NaN: the first
    lowest = &surfacing;
  }
  if (meant) return between;
  const bool hinted = std::isfinite(z_hint_m);
  const auto place = network.Locate(x_m, y_m, hinted ? std::optional(z_hint_m) : std::nullopt);
  if (!place || place->distance_m > kVerge_m) return lowest == nullptr ? SurfacePoint{} : OnRoad(source, *lowest);
  const SurfacePoint verge = OnVerge(network, friction, {x_m, y_m}, *place);
  if (lowest != nullptr && verge.z_m > z_hint_m + terrain::kHintAbove_m) return OnRoad(source, *lowest);
  return verge;
}

Extents NetworkExtents(const Network& network) {
  const auto [low, high] = network.Bounds();
  return {low.x() - kVerge_m, low.y() - kVerge_m, high.x() + kVerge_m, high.y() + kVerge_m};
}

}  // namespace rodeira::road
