// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/one_ground.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"
#include "common/core/ground/ground.hpp"

namespace rodeira::road {
namespace {

using network::Network;
using network::Surfacing;

constexpr double kMeets_m = 5.0;     // so far from where two roads meet, third ones count little
constexpr double kNearest_m = 1e-6;  // nearer distances are this: at a road's end all others count 1e-13

bool Drivable(const network::Lane& lane) { return network::IsDrivable(lane.type); }

bool LeadsInto(const network::RoadSpec& road, const std::string& junction) {
  const auto into = [&](const std::optional<network::RoadLink>& link) {
    return link && link->junction && link->id == junction;
  };
  return road.junction == junction || into(road.predecessor) || into(road.successor);
}

// Whether both have to do with one junction.
bool AreOfOne(const network::RoadSpec& a, const network::RoadSpec& b) {
  const auto through = [&](const std::optional<network::RoadLink>& link) {
    return link && link->junction && LeadsInto(b, link->id);
  };
  const auto meets = [](const std::optional<network::RoadLink>& link, const network::RoadSpec& middle_of) {
    return link && link->s_m && link->id == middle_of.id;
  };
  if (meets(a.predecessor, b) || meets(a.successor, b) || meets(b.predecessor, a) || meets(b.successor, a)) return true;
  return (!a.junction.empty() && LeadsInto(b, a.junction)) || through(a.predecessor) || through(a.successor);
}

// How far a point is from the edge where something begins, and how that changes in the plane.
struct Away {
  double value = 0.0;
  Eigen::Vector2d slope_W = Eigen::Vector2d::Zero();
};

// The lanes around a point's own that are drivable as it is, or as it is not.
struct Block {
  Away right, left;                                  // of its edges
  bool right_borders = false, left_borders = false;  // lanes of the other kind lie behind the edge
};

// s and t as they change in the plane.
struct RoadGradients {
  Eigen::Vector2d s_W = Eigen::Vector2d::Zero(), t_W = Eigen::Vector2d::Zero();

  explicit RoadGradients(const network::SurfaceSample& sample) {
    const Eigen::Vector2d ds = sample.ds_W.head<2>(), dt = sample.dt_W.head<2>();
    const double area = geometry::Cross(ds, dt);
    if (!(area > 1e-6)) return;
    s_W = Eigen::Vector2d(dt.y(), -dt.x()) / area;
    t_W = Eigen::Vector2d(-ds.y(), ds.x()) / area;
  }
};

Block BlockAt(const network::LaneSection& section, const geometry::CubicPoint& centre, const network::Place& place,
              const RoadGradients& gradients) {
  thread_local std::vector<network::LaneSpan> spans;  // from right to left
  spans.clear();
  for (auto lane = section.right.rbegin(); lane != section.right.rend(); ++lane)
    spans.push_back(*section.Span(lane->id, centre, place.s_m));
  for (const network::Lane& lane : section.left) spans.push_back(*section.Span(lane.id, centre, place.s_m));
  const auto own = std::find_if(spans.begin(), spans.end(),
                                [&](const network::LaneSpan& span) { return span.lane->id == place.lane.lane; });
  const bool drivable = Drivable(*own->lane);
  const auto edge = [&](const network::LaneSpan& span, bool left) {
    const bool outer = (span.lane->id > 0) == left;
    const double t = outer ? span.outer_t_m : span.inner_t_m, t_slope = outer ? span.outer_slope : span.inner_slope;
    const double sign = left ? 1.0 : -1.0;
    return Away{std::max(0.0, sign * (t - place.t_m)), sign * (t_slope * gradients.s_W - gradients.t_W)};
  };
  Block block;
  auto last = own;
  for (auto span = own; span != spans.end(); ++span) {
    if (span->width_m() == 0.0) continue;
    if ((block.left_borders = Drivable(*span->lane) != drivable)) break;
    last = span;
  }
  block.left = edge(*last, true);
  last = own;
  for (auto span = std::make_reverse_iterator(own + 1); span != spans.rend(); ++span) {
    if (span->width_m() == 0.0) continue;
    if ((block.right_borders = Drivable(*span->lane) != drivable)) break;
    last = span.base() - 1;
  }
  block.right = edge(*last, false);
  return block;
}

void Times(const Weight& by, Weight& weight) {
  weight.slope_W = by.value * weight.slope_W + weight.value * by.slope_W;
  weight.value *= by.value;
}

// 1 + (5 m / d)²: ever more towards the edge.
Weight More(const Away& away) {
  if (away.value <= kNearest_m) return {1.0 + kMeets_m * kMeets_m / (kNearest_m * kNearest_m), Eigen::Vector2d::Zero()};
  const double ratio = kMeets_m / away.value;
  return {1.0 + ratio * ratio, -2.0 * ratio * ratio / away.value * away.slope_W};
}

// d² / (d² + (5 m)²): nothing at the edge.
Weight Less(const Away& away) {
  const double square = away.value * away.value, sum = square + kMeets_m * kMeets_m;
  return {square / sum, 2.0 * away.value * kMeets_m * kMeets_m / (sum * sum) * away.slope_W};
}

// (a b / (a + b))².
Weight Between(const Away& a, const Away& b) {
  const double sum = a.value + b.value;
  if (!(sum > 0.0)) return {};
  const double of_a = b.value / sum, of_b = a.value / sum, mean = a.value * of_a;
  return {mean * mean, 2.0 * mean * (of_a * of_a * a.slope_W + of_b * of_b * b.slope_W)};
}

// (a / (a + b))².
Weight Part(const Away& a, const Away& b) {
  const double sum = a.value + b.value;
  if (!(sum > 0.0)) return {};
  const double part = a.value / sum;
  return {part * part, 2.0 * part / sum * (a.slope_W - part * (a.slope_W + b.slope_W))};
}

Weight LateralWeight(const Block& block, bool drivable) {
  const bool right = !drivable && block.right_borders, left = !drivable && block.left_borders;
  if (!right && !left) return Between(block.right, block.left);
  Weight weight = right ? More(block.right) : Part(block.right, block.left);
  Times(left ? More(block.left) : Part(block.left, block.right), weight);
  return weight;
}

Weight WeightOf(const Network& network, const Surfacing& surfacing) {
  const network::Place& place = surfacing.place;
  const network::Road& road = network.roads()[place.lane.road];
  const RoadGradients gradients(surfacing.sample);
  const Block block = BlockAt(network.Section(place.lane), road.CentreAt(place.s_m), place, gradients);
  Weight weight = LateralWeight(block, surfacing.claim.drivable);
  const Away start{place.s_m, gradients.s_W}, end{road.length_m() - place.s_m, -gradients.s_W};
  Times(road.spec().predecessor ? More(start) : Less(start), weight);
  Times(road.spec().successor ? More(end) : Less(end), weight);
  return weight;
}

// Whether a road begins or ends so near that it may be what another one, closed behind its end, goes on into: the gap
// between them and what is closed of it.
bool CanReplace(const Network& network, const Surfacing& surfacing) {
  const network::Road& road = network.roads()[surfacing.place.lane.road];
  const double s = surfacing.place.s_m;
  constexpr double kNear_m = 2.0 * Network::kClosed_m;
  return (s <= kNear_m && road.spec().predecessor) || (road.length_m() - s <= kNear_m && road.spec().successor);
}

bool IsBetter(const Surfacing& a, const Surfacing& b) {
  return a.claim.drivable != b.claim.drivable ? a.claim.drivable : a.claim.Before(b.claim);
}

void Settle(const Network& network, Layer& layer) {
  auto& roads = layer.roads;
  const auto takes_over = [&](const Surfacing* road) { return !road->claim.past_end && CanReplace(network, *road); };
  if (roads.size() > 1 && std::any_of(roads.begin(), roads.end(), takes_over))
    std::erase_if(roads, [](const Surfacing* road) { return road->claim.past_end; });
  layer.named = *std::min_element(roads.begin(), roads.end(),
                                  [](const Surfacing* a, const Surfacing* b) { return IsBetter(*a, *b); });
  if (roads.size() > 1)
    std::erase_if(roads, [&](const Surfacing* road) { return road->claim.drivable != layer.named->claim.drivable; });
  layer.weights.clear();
  layer.z_m = layer.named->sample.p_W.z();
  if (roads.size() == 1) return;
  double sum = 0.0;
  for (const Surfacing* road : roads) sum += layer.weights.emplace_back(WeightOf(network, *road)).value;
  if (!(sum > 0.0)) {  // on the edge of all of them
    roads.assign(1, layer.named);
    layer.weights.clear();
    return;
  }
  const double z = layer.z_m;
  for (std::size_t i = 0; i < roads.size(); ++i)
    layer.z_m += layer.weights[i].value / sum * (roads[i]->sample.p_W.z() - z);
}

}  // namespace

PlaneHeight HeightOf(const network::SurfaceSample& sample) {
  const Eigen::Vector3d normal = sample.ds_W.cross(sample.dt_W);
  return {sample.p_W.z(), {-normal.x() / normal.z(), -normal.y() / normal.z()}};
}

PlaneHeight Layer::Mean(std::span<const PlaneHeight> heights) const {
  if (weights.empty()) return heights[0];
  double sum = 0.0;
  for (const Weight& weight : weights) sum += weight.value;
  PlaneHeight mean{heights[0].z_m,
                   Eigen::Vector2d::Zero()};  // from one of them on: where all agree it is what they say
  for (std::size_t i = 0; i < heights.size(); ++i)
    mean.z_m += weights[i].value / sum * (heights[i].z_m - heights[0].z_m);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    mean.slope_W +=
        weights[i].value / sum * heights[i].slope_W + (heights[i].z_m - mean.z_m) / sum * weights[i].slope_W;
  }
  return mean;
}

void FindLayers(const Network& network, std::span<const Surfacing> surfaces, bool past_ends, std::vector<Layer>& layers,
                std::size_t& count) {
  count = 0;
  thread_local std::vector<const Surfacing*> left;
  left.clear();
  for (const Surfacing& surfacing : surfaces) {
    if (surfacing.place.lane.lane == 0) continue;  // a road without lanes on that side
    if (!past_ends && surfacing.claim.past_end) continue;
    left.push_back(&surfacing);
  }
  while (!left.empty()) {
    if (layers.size() == count) layers.emplace_back();
    Layer& layer = layers[count++];
    layer.roads.assign(1, left.front());
    const double top = left.front()->sample.p_W.z();
    std::size_t others = 0;
    for (std::size_t i = 1; i < left.size(); ++i) {
      const double below = top - left[i]->sample.p_W.z();
      const network::RoadSpec& spec = network.roads()[left[i]->place.lane.road].spec();
      const bool one =
          below <= ground::kMaxAboveHint_m ||
          (below < Network::kLevel_m && std::any_of(layer.roads.begin(), layer.roads.end(), [&](const Surfacing* road) {
             return AreOfOne(network.roads()[road->place.lane.road].spec(), spec);
           }));
      if (one)
        layer.roads.push_back(left[i]);
      else
        left[others++] = left[i];
    }
    left.resize(others);
    Settle(network, layer);
  }
  std::sort(layers.begin(), layers.begin() + static_cast<std::ptrdiff_t>(count), [](const Layer& a, const Layer& b) {
    return a.z_m > b.z_m || (a.z_m == b.z_m && IsBetter(*a.named, *b.named));
  });
}

}  // namespace rodeira::road
