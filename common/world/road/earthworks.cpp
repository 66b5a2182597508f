// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/earthworks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/world/road/built_ground.hpp"

namespace rodeira::road {
namespace {

// The stretches of a panel that stand on the ground.
template <class Use>
void ForEachGroundStretch(const network::Road& road, double low_m, double high_m, const Use& use) {
  double from = low_m;
  while (from <= high_m) {
    double to = high_m;
    bool exempt = false;
    for (const network::Structure& structure : road.spec().structures) {
      const double begin = structure.s_m, end = structure.s_m + structure.length_m;
      if (from >= begin && from < end) {
        exempt = true;
        to = std::min(high_m, end);
        break;
      }
      if (begin > from) to = std::min(to, begin);
    }
    if (!exempt) use(from, to);
    if (to >= high_m) break;
    from = to;
  }
}

}  // namespace

Earthworks::Earthworks(std::shared_ptr<const network::Network> network,
                       std::vector<std::shared_ptr<const design::JunctionSurface>> junctions)
    : network_(std::move(network)), junctions_(std::move(junctions)) {
  for (std::uint32_t road = 0; road < network_->roads().size(); ++road) {
    if (network_->roads()[road].spec().earthwork) AddReaches(road);
  }
  const auto with_blend = [](const network::Road& road) {
    return road.spec().earthwork && road.spec().earthwork->blend_m > 0.0;
  };
  blends_ = std::any_of(network_->roads().begin(), network_->roads().end(), with_blend);
  RODEIRA_ASSERT(!blends_ || (network_->roads().size() == 1 && junctions_.empty() && !network_->roads()[0].rolled()));
  std::vector<SquareLists::Strip> strips;
  for (const Reach& reach : reaches_) {
    const network::Earthwork& earthwork = *network_->roads()[reach.road].spec().earthwork;
    strips.push_back({reach.from_W, reach.to_W, reach.beside_m + (blends_ ? earthwork.blend_m : earthwork.reach_m)});
  }
  for (const auto& junction : junctions_) {
    const Eigen::Vector2d middle_W = 0.5 * (junction->low_W() + junction->high_W());
    strips.push_back({middle_W, middle_W, (junction->high_W() - middle_W).norm() + network::Earthwork().reach_m});
  }
  near_ = SquareLists(strips);
  for (const auto& junction : junctions_) {
    std::vector<Heights>& heights = edge_heights_.emplace_back();
    Heights& all = junction_heights_.emplace_back(
        Heights{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
    for (const design::FreeEdge& edge : junction->free_edges()) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const double q : {0.0, 0.5, 1.0}) {
        const double z = junction->At(edge.from_W + q * (edge.to_W - edge.from_W)).z_m;
        low = std::min(low, z), high = std::max(high, z);
      }
      heights.push_back({low - kSampleMargin_m, high + kSampleMargin_m});
      all = {std::min(all.low_m, low - kSampleMargin_m), std::max(all.high_m, high + kSampleMargin_m)};
    }
  }
}

void Earthworks::AddReaches(std::uint32_t road_index) {
  const network::Road& road = network_->roads()[road_index];
  const std::vector<geometry::AxisPanel>& panels = road.axis().panels();
  for (std::uint32_t i = 0; i < panels.size(); ++i) {
    const geometry::AxisPanel& panel = panels[i];
    if (i > 0 && panel.begin_s_m() > road.length_m()) break;
    const double begin = std::max(panel.begin_s_m(), 0.0), end = std::min(panel.end_s_m(), road.length_m());
    Reach reach;
    reach.road = road_index, reach.panel = i;
    reach.from_W = road.axis().At(panel, -panel.half_m).p_W, reach.to_W = road.axis().At(panel, panel.half_m).p_W;
    reach.beside_m = EdgesBeside(road, panel).beside_m;
    reach.heights = HeightsOfEdges(road, begin, end);
    reaches_.push_back(reach);
  }
}

bool Earthworks::MayTighten(const network::Earthwork& earthwork, const Heights& heights, double distance_m,
                            const Bounds& bounds) {
  if (distance_m >= earthwork.reach_m) return false;
  if (!bounds.low.any || !bounds.high.any) return true;
  const double more = Steepening(distance_m, earthwork.reach_m).first;
  return heights.high_m - distance_m / earthwork.fill - more > bounds.low.z_m ||
         heights.low_m + distance_m / earthwork.cut + more < bounds.high.z_m;
}

void Earthworks::Offer(const network::Earthwork& earthwork, const Edge& edge, const Eigen::Vector2d& p_W,
                       Bounds& bounds) {
  const Eigen::Vector2d apart = p_W - edge.p_W;
  const double distance = apart.norm();
  if (distance >= earthwork.reach_m) return;
  const Eigen::Vector2d away = distance > 0.0 ? Eigen::Vector2d(apart / distance) : Eigen::Vector2d::Zero();
  const auto [more, more_slope] = Steepening(distance, earthwork.reach_m);
  const double low = edge.z_m - distance / earthwork.fill - more, high = edge.z_m + distance / earthwork.cut + more;
  if (!bounds.low.any || low > bounds.low.z_m) {
    bounds.low = {low, distance, edge.along - (1.0 / earthwork.fill + more_slope) * away, away, true};
  }
  if (!bounds.high.any || high < bounds.high.z_m) {
    bounds.high = {high, distance, edge.along + (1.0 / earthwork.cut + more_slope) * away, away, true};
  }
}

void Earthworks::FromRoad(const network::Road& road, std::uint32_t panel_index, const Eigen::Vector2d& p_W,
                          Bounds& bounds) const {
  const geometry::AxisPanel& panel = road.axis().panels()[panel_index];
  const double low = std::max(panel.begin_s_m(), 0.0), high = std::min(panel.end_s_m(), road.length_m());
  ForEachGroundStretch(road, low, high, [&](double from, double to) {
    const EdgePlace place = PlaceOnEdge(road, panel, {from, to}, p_W);
    Edge edge{place.sample.p_W.head<2>(), place.sample.p_W.z(), Eigen::Vector2d::Zero()};
    if (place.pace > 0.0)
      edge.along = place.sample.ds_W.z() / place.pace * place.axis.tangent_W;  // the height goes along with the road's
    Offer(*road.spec().earthwork, edge, p_W, bounds);
  });
}

// The nearest panel first; then only those that can hold the ground more tightly.
void Earthworks::FromRoads(std::span<const std::uint32_t> near, const Eigen::Vector2d& p_W, Bounds& bounds) const {
  if (near.empty()) return;
  thread_local std::vector<double> distances;
  distances.clear();
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    distances.push_back(reaches_[near[i]].DistanceFrom(p_W));
    if (distances[i] < distances[nearest]) nearest = i;
  }
  const auto ask = [&](std::size_t i) {
    const Reach& reach = reaches_[near[i]];
    const network::Road& road = network_->roads()[reach.road];
    if (MayTighten(*road.spec().earthwork, reach.heights, distances[i], bounds))
      FromRoad(road, reach.panel, p_W, bounds);
  };
  ask(nearest);
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (i != nearest) ask(i);
  }
}

void Earthworks::FromJunction(std::size_t index, const Eigen::Vector2d& p_W, Bounds& bounds) const {
  const design::JunctionSurface& junction = *junctions_[index];
  const network::Earthwork usual;
  const Eigen::Vector2d box = (junction.low_W() - p_W).cwiseMax(p_W - junction.high_W()).cwiseMax(0.0);
  if (!MayTighten(usual, junction_heights_[index], box.norm(), bounds)) return;
  const std::vector<design::FreeEdge>& edges = junction.free_edges();
  const auto foot = [&](const design::FreeEdge& edge, double& q) {
    const Eigen::Vector2d along = edge.to_W - edge.from_W;
    q = std::clamp((p_W - edge.from_W).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return Eigen::Vector2d(edge.from_W + q * along);
  };
  const auto offer = [&](const design::FreeEdge& edge) {
    double q;
    const Eigen::Vector2d at = foot(edge, q);
    const design::JunctionHeight height = junction.At(at);
    Edge point{at, height.z_m, Eigen::Vector2d::Zero()};
    const Eigen::Vector2d along = (edge.to_W - edge.from_W).normalized();
    if (q > 0.0 && q < 1.0) point.along = along * along.dot(Eigen::Vector2d(height.slope_x, height.slope_y));
    Offer(usual, point, p_W, bounds);
  };
  // The nearest edge first; then only those that can hold the ground more tightly.
  std::size_t nearest = 0;
  double best = std::numeric_limits<double>::infinity(), q;
  thread_local std::vector<double> distances;
  distances.clear();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    distances.push_back((p_W - foot(edges[i], q)).norm());
    if (distances.back() < best) best = distances.back(), nearest = i;
  }
  if (best >= usual.reach_m) return;
  offer(edges[nearest]);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i == nearest) continue;
    if (MayTighten(usual, edge_heights_[index][i], distances[i], bounds)) offer(edges[i]);
  }
}

void Earthworks::Blend(std::span<const std::uint32_t> near, const Eigen::Vector2d& p_W, SurfacePoint& ground) const {
  const network::Road& road = network_->roads().front();
  const std::vector<geometry::AxisPanel>& panels = road.axis().panels();
  // The nearest point of the axis; of equally near ones that of the smallest station.
  const geometry::AxisPanel* panel = nullptr;
  geometry::AxisFoot foot;
  double nearest_m2 = std::numeric_limits<double>::infinity();
  for (const std::uint32_t reach : near) {
    const geometry::AxisPanel& candidate = panels[reaches_[reach].panel];
    const geometry::AxisFoot there = road.axis().Foot(candidate, p_W);
    const double distance_m2 = there.t_m * there.t_m + there.beyond_m * there.beyond_m;
    if (distance_m2 < nearest_m2) panel = &candidate, foot = there, nearest_m2 = distance_m2;
  }
  if (panel == nullptr) return;
  const bool past_end =
      (foot.beyond_m < 0.0 && panel == &panels.front()) || (foot.beyond_m > 0.0 && panel == &panels.back());
  const double beyond = past_end ? foot.beyond_m : 0.0;  // between two panels it is rounding
  const double s = std::clamp(panel->middle_s_m + foot.u_m, 0.0, road.length_m());
  const network::LaneSection& section = road.SectionAt(s);
  const geometry::CubicPoint centre = road.CentreAt(s);
  double outside;
  const network::LaneSpan span = section.At(foot.t_m, centre, s, outside);
  const double aside = foot.t_m > centre.value ? outside : -outside;
  const double excess = std::sqrt(aside * aside + beyond * beyond);  // distance from the verges' outline
  const double blend = road.spec().earthwork->blend_m;
  if (excess >= blend) return;

  // The road's own surface, going on in its slopes. Past an end s stands still and the straight distance counts.
  const network::SurfaceSample sample = road.Surface(foot.at, s, foot.t_m, section, span);
  const Eigen::Vector2d along_W = foot.at.tangent_W, left_W = foot.at.left_W();
  const double pace = past_end ? 1.0 : 1.0 - foot.at.curvature_1pm * foot.t_m;
  const double z = sample.p_W.z() + sample.ds_W.z() * beyond;
  const Eigen::Vector2d slope = sample.ds_W.z() / pace * along_W + sample.dt_W.z() * left_W;
  const double u = excess / blend;
  const double weight = u * u * (3.0 - 2.0 * u);
  const double weight_slope = 6.0 * u * (1.0 - u) / blend;
  const Eigen::Vector2d outward_W =
      excess > 0.0 ? Eigen::Vector2d((aside * left_W + beyond * along_W) / excess) : Eigen::Vector2d::Zero();
  const double step = ground.z_m - z;
  ground.slope_x = slope.x() + weight * (ground.slope_x - slope.x()) + weight_slope * step * outward_W.x();
  ground.slope_y = slope.y() + weight * (ground.slope_y - slope.y()) + weight_slope * step * outward_W.y();
  ground.z_m = z + weight * step;
}

void Earthworks::Shape(const Eigen::Vector2d& p_W, SurfacePoint& ground) const {
  const std::span<const std::uint32_t> near = near_.At(p_W);
  if (near.empty()) return;
  if (blends_) return Blend(near, p_W, ground);
  const auto junction = std::lower_bound(near.begin(), near.end(), reaches_.size());
  Bounds bounds;
  FromRoads({near.begin(), junction}, p_W, bounds);
  for (auto at = junction; at != near.end(); ++at) FromJunction(*at - reaches_.size(), p_W, bounds);
  const auto take = [&](double z, const Eigen::Vector2d& slope) {
    ground.z_m = z;
    ground.slope_x = slope.x();
    ground.slope_y = slope.y();
  };
  const Bound &low = bounds.low, &high = bounds.high;
  if (low.any && high.any && low.z_m > high.z_m) {
    const double sum = low.distance_m + high.distance_m;
    const double part = sum > 0.0 ? high.distance_m / sum : 0.5;
    const Eigen::Vector2d part_slope =
        sum > 0.0 ? Eigen::Vector2d((low.distance_m * high.away - high.distance_m * low.away) / (sum * sum))
                  : Eigen::Vector2d::Zero();
    take(high.z_m + part * (low.z_m - high.z_m),
         high.slope + part * (low.slope - high.slope) + (low.z_m - high.z_m) * part_slope);
  } else if (low.any && ground.z_m < low.z_m) {
    take(low.z_m, low.slope);
  } else if (high.any && ground.z_m > high.z_m) {
    take(high.z_m, high.slope);
  }
}

}  // namespace rodeira::road
