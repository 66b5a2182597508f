#include "common/road/network_ground.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/geometry/plane.hpp"

namespace rodeira::road {
namespace {

using network::Network;
using network::Place;

constexpr double kOverHint_m = 0.5;

SurfacePoint OnRoad(const Network& network, const FrictionTable& friction, const network::Surfacing& surfacing, const SurfaceDetail* detail) {
  network::SurfaceSample sample = surfacing.sample;
  const network::Place& place = surfacing.place;
  if (detail != nullptr) {
    detail->Add(network.roads()[place.lane.road], place.lane.road, network.Section(place.lane), place.s_m, place.t_m, sample);
  }
  const Eigen::Vector3d normal = sample.ds_W.cross(sample.dt_W);
  const network::Lane* lane = network.Find(surfacing.place.lane);
  const network::LaneMaterial* material = network.roads()[surfacing.place.lane.road].MaterialAt(*lane, surfacing.place.s_m);
  const terrain::Surface surface = SurfaceOf(*lane, material);
  const double grip =
      material != nullptr && material->friction ? *material->friction : friction[static_cast<std::size_t>(surface)];
  return {sample.p_W.z(), -normal.x() / normal.z(), -normal.y() / normal.z(), grip, surface, true};
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

terrain::Surface SurfaceOf(const network::Lane& lane, const network::LaneMaterial* material) {
  if (material != nullptr) {
    for (const terrain::Surface known : {terrain::Surface::kAsphalt, terrain::Surface::kConcrete, terrain::Surface::kGravel,
                                         terrain::Surface::kGrass, terrain::Surface::kSoil}) {
      if (material->surface == SurfaceName(known)) return known;
    }
  }
  switch (lane.type) {
    case network::LaneType::kNone:
    case network::LaneType::kMedian: return terrain::Surface::kGrass;
    case network::LaneType::kSidewalk:
    case network::LaneType::kWalking:
    case network::LaneType::kCurb: return terrain::Surface::kConcrete;
    default: return terrain::Surface::kAsphalt;
  }
}

SurfacePoint NetworkGround(const Network& network, const FrictionTable& friction, double x_m, double y_m, double z_hint_m,
                           const SurfaceDetail* detail) {
  thread_local std::vector<network::Surfacing> surfaces;
  network.Surfaces(x_m, y_m, surfaces);
  std::erase_if(surfaces, [&](const network::Surfacing& surfacing) {
    return network.Find(surfacing.place.lane) == nullptr || surfacing.place.lane.lane == 0;
  });
  for (const network::Surfacing& surfacing : surfaces) {
    if (!(surfacing.sample.p_W.z() > z_hint_m + kOverHint_m)) return OnRoad(network, friction, surfacing, detail);  // NaN: the first
  }
  const bool hinted = std::isfinite(z_hint_m);
  const auto place = network.Locate(x_m, y_m, hinted ? std::optional(z_hint_m) : std::nullopt);
  if (!place || place->distance_m > kVerge_m)
    return surfaces.empty() ? SurfacePoint{} : OnRoad(network, friction, surfaces.back(), detail);
  const SurfacePoint verge = OnVerge(network, friction, {x_m, y_m}, *place);
  if (!surfaces.empty() && verge.z_m > z_hint_m + kOverHint_m) return OnRoad(network, friction, surfaces.back(), detail);
  return verge;
}

Extents NetworkExtents(const Network& network) {
  const auto [low, high] = network.Bounds();
  return {low.x() - kVerge_m, low.y() - kVerge_m, high.x() + kVerge_m, high.y() + kVerge_m};
}

}  // namespace rodeira::road
