#include "common/road/network_land.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rodeira::road {
namespace {

using Eigen::Vector2d;
using network::Road;

constexpr double kOfRadius = 0.9;       // what moves with p reaches so far to the middle of a bend
constexpr double kLeastReach_m = 0.5;   // where lanes fold
constexpr double kPostsOfRadius = 0.1;  // posts in a bend stand so much of its radius apart
constexpr double kLeastApart_m = 0.5;
constexpr int kCurvatures = 4;  // samples of a panel's
constexpr double kSample_m = 1e-3;
constexpr double kRounding_m = 1e-6;
constexpr double kStraight_1pm = 1e-7;

// How far from an edge within a bend what moves with p may reach.
double ReachOf(double curvature_1pm, double edge_m) {
  if (!(curvature_1pm > 0.0)) return kHolds_m;
  return std::clamp(kOfRadius * (1.0 / curvature_1pm - edge_m), kLeastReach_m, kHolds_m);
}

// Of an edge on a circle of radius r that climbs evenly by g, seen from a point at the radius q r: how far along it from where it is nearest, by the distance there,
// lies the place for which z - |p - place| / 2 is greatest, or z + |p - place| / 2 least. By h = 2 g and X = (1 - h²)(q² - h²) it is the angle φ with
// cos φ = (h² + √X) / q, which is written here so that nothing is lost for r = ∞, q = 1. 0: there is none.
double TightestBound(double climb, double q) {
  const double h = climb / kBank, x2 = (1.0 - h * h) * (q * q - h * h);
  if (!(h * h < 1.0) || !(q > std::fabs(h))) return 0.0;
  const double by = h / std::sqrt(2.0 * q * (q - h * h + std::sqrt(x2))), sine = by * std::fabs(q - 1.0);
  return 2.0 * by * (std::fabs(sine) > 1e-8 ? std::asin(sine) / sine : 1.0);
}

bool HasKerbs(const network::LaneSection& section) {
  const auto stands = [](const network::Lane& lane) { return !lane.heights.empty(); };
  return std::any_of(section.left.begin(), section.left.end(), stands) || std::any_of(section.right.begin(), section.right.end(), stands);
}

}  // namespace

NetworkLand::NetworkLand(std::shared_ptr<const network::Network> network) : network_(std::move(network)), decks_(FindDecks(*network_)) {
  for (std::uint32_t road = 0; road < network_->roads().size(); ++road) AddPieces(road);
  for (const network::Junction& junction : network_->junctions()) {
    if (junction.ground != nullptr) AddBoundary(*junction.ground);
  }
  for (const Piece& piece : pieces_) {
    around_.push_back({0.5 * (piece.from_W + piece.to_W), 0.5 * (piece.to_W - piece.from_W).norm() + piece.beside_m + kRounding_m, piece.heights});
  }
  std::vector<SquareLists::Strip> strips;
  for (std::size_t first = 0; first < around_.size(); first += kBlock) {
    const auto some = std::span(around_).subspan(first, std::min<std::size_t>(kBlock, around_.size() - first));
    Vector2d low_W = some.front().middle_W, high_W = low_W;
    Around& block = blocks_.emplace_back(some.front());
    for (const Around& around : some) {
      low_W = low_W.cwiseMin(around.middle_W), high_W = high_W.cwiseMax(around.middle_W);
      block.heights = {std::min(block.heights.low_m, around.heights.low_m), std::max(block.heights.high_m, around.heights.high_m)};
    }
    block.middle_W = 0.5 * (low_W + high_W), block.radius_m = 0.0;
    for (const Around& around : some) block.radius_m = std::max(block.radius_m, (around.middle_W - block.middle_W).norm() + around.radius_m);
    block.radius_m += kRounding_m;
    strips.push_back({block.middle_W, block.middle_W, block.radius_m + kHolds_m});
  }
  near_ = SquareLists(strips);
  near_ = SquareLists(strips);
}

bool NetworkLand::IsOnDeck(std::uint32_t road, double s_m) const {
  return std::any_of(decks_[road].begin(), decks_[road].end(), [s_m](const Stretch& deck) { return s_m > deck.from_s_m && s_m < deck.to_s_m; });
}

void NetworkLand::AddPieces(std::uint32_t road_index) {
  const Road& road = network_->roads()[road_index];
  const std::vector<geometry::AxisPanel>& panels = road.axis().panels();
  for (const Stretch& standing : StandingOn(road, decks_[road_index])) {
    for (std::uint32_t i = 0; i < panels.size(); ++i) {
      const geometry::AxisPanel& panel = panels[i];
      const double begin = std::max(panel.begin_s_m(), standing.from_s_m), end = std::min(panel.end_s_m(), standing.to_s_m);
      if (!(begin < end)) continue;
      Piece piece;
      piece.road = road_index, piece.panel = i, piece.stretch = {begin, end};
      piece.from_W = road.axis().At(panel, -panel.half_m).p_W, piece.to_W = road.axis().At(panel, panel.half_m).p_W;
      piece.beside_m = EdgesBeside(road, panel);
      piece.heights = HeightsOfEdges(road, begin, end);
      piece.right_reach_m = piece.left_reach_m = kHolds_m;
      for (int k = 0; k <= kCurvatures; ++k) {
        const double s = begin + (end - begin) * k / kCurvatures, curvature = road.axis().At(panel, s - panel.middle_s_m).curvature_1pm;
        double right, left;
        road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
        piece.left_reach_m = std::min(piece.left_reach_m, ReachOf(curvature, left)), piece.right_reach_m = std::min(piece.right_reach_m, ReachOf(-curvature, -right));
      }
      AddPosts(road, panel, piece);
      pieces_.push_back(piece);
    }
  }
}

// On both edges at both ends, where a lane section begins, and in a bend some more.
void NetworkLand::AddPosts(const Road& road, const geometry::AxisPanel& panel, Piece& piece) {
  const auto& [from, to] = piece.stretch;
  std::vector<double> stations{from, to};
  for (const network::LaneSection& section : road.spec().sections) {
    if (section.s_m > from && section.s_m < to) stations.insert(stations.end(), {std::nextafter(section.s_m, 0.0), section.s_m});
  }
  const double reach = std::min(piece.left_reach_m, piece.right_reach_m);
  if (reach < kHolds_m) {
    const int apart = static_cast<int>(std::ceil((to - from) / std::max(kLeastApart_m, kPostsOfRadius / kOfRadius * reach)));
    for (int k = 1; k < apart; ++k) stations.push_back(from + (to - from) * k / apart);
  }
  piece.first_post = static_cast<std::uint32_t>(posts_W_.size());
  for (const double s : stations) {
    const network::LaneSection& section = road.SectionAt(s);
    const geometry::PlanPoint axis = road.axis().At(panel, s - panel.middle_s_m);
    const auto put = [&](double t, const network::LaneSpan& span) { posts_W_.push_back(road.Surface(axis, s, t, section, span).p_W); };
    double right, left, outside;
    section.Bounds(road.spec().lane_offset, s, s, right, left);
    for (const double t : {right, left}) put(t, section.At(t, road.CentreAt(s), s, outside));
    if ((s != from && s != to) || !HasKerbs(section)) continue;
    for (const auto* lanes : {&section.left, &section.right}) {  // across its end the road steps
      for (const network::Lane& lane : *lanes) {
        const network::LaneSpan span = *section.Span(lane.id, road.CentreAt(s), s);
        put(span.inner_t_m, span), put(span.outer_t_m, span);
      }
    }
  }
  piece.posts = static_cast<std::uint32_t>(posts_W_.size()) - piece.first_post;
}

void NetworkLand::AddBoundary(const network::JunctionGround& ground) {
  const std::vector<Vector2d>& corners = ground.boundary_W();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Piece piece;
    piece.ground = &ground;
    piece.from_W = corners[i], piece.to_W = corners[(i + 1) % corners.size()];
    if (piece.from_W == piece.to_W) continue;
    double low = std::numeric_limits<double>::infinity(), high = -low, last = 0.0, most = 0.0;
    constexpr int kSamples = 16;
    for (int k = 0; k <= kSamples; ++k) {
      const double z = ground.At(piece.from_W + static_cast<double>(k) / kSamples * (piece.to_W - piece.from_W)).z_m;
      if (k > 0) most = std::max(most, std::fabs(z - last));
      low = std::min(low, z), high = std::max(high, z), last = z;
    }
    piece.heights = {low - most - kSample_m, high + most + kSample_m};
    pieces_.push_back(piece);
  }
}

void NetworkLand::Bounds::Clear() {
  all.clear();
  low = high = 0;
  nearest_m = std::numeric_limits<double>::infinity();
}

void NetworkLand::Bounds::Add(const Bound& bound, double distance_m) {
  all.push_back(bound);
  nearest_m = std::min(nearest_m, distance_m);
  if (bound.z_m - kBank * bound.distance_m > Low()) low = all.size() - 1;
  if (bound.z_m + kBank * bound.distance_m < High()) high = all.size() - 1;
}

void NetworkLand::FromPost(const Eigen::Vector3d& post_W, const Vector2d& p_W, Bounds& bounds) {
  const Vector2d apart = p_W - post_W.head<2>();
  const double distance = apart.norm();
  if (distance >= kHolds_m) return;
  const auto [more, more_slope] = Steepening(distance, kHolds_m);
  bounds.Add({post_W.z(), distance + more, Vector2d::Zero(), distance > 0.0 ? Vector2d((1.0 + more_slope) / distance * apart) : Vector2d::Zero()}, distance);
}

// Behind the end of a road with kerbs: so that nothing steps there, a lane's end holds the land ever less towards the lane's edges, where posts stand.
void NetworkLand::FromEnd(const EdgePlace& place, const Road& road, const Vector2d& p_W, Bounds& bounds) const {
  double outside;
  const network::LaneSpan span = road.SectionAt(place.s_m).At(place.t_m, road.CentreAt(place.s_m), place.s_m, outside);
  const Vector2d apart = p_W - place.sample.p_W.head<2>();
  const double distance = apart.norm(), to_inner = std::fabs(place.t_m - span.inner_t_m), to_outer = std::fabs(place.t_m - span.outer_t_m), inside = std::min(to_inner, to_outer);
  if (distance >= kHolds_m || (!(inside > 1e-9) && distance > 0.0)) return;
  const auto [more, more_slope] = Steepening(distance, kHolds_m);
  const Vector2d away = distance > 0.0 ? Vector2d(apart / distance) : Vector2d::Zero();
  const double ratio = distance > 0.0 ? distance / inside : 0.0;
  const bool grows = (place.t_m > span.inner_t_m) == (to_inner < to_outer);  // with t
  const Vector2d inside_slope = (grows ? 1.0 : -1.0) * place.axis.left_W();
  const Eigen::Vector3d& across = place.sample.dt_W;
  bounds.Add({place.sample.p_W.z(), distance + more + distance * ratio, across.z() * place.axis.left_W(),
              (1.0 + more_slope + 2.0 * ratio) * (away - away.dot(across.head<2>()) * place.axis.left_W()) - ratio * ratio * inside_slope},
             distance);
}

// station_slope_W: how the place's s goes as p moves.
void NetworkLand::FromPlace(const EdgePlace& place, const Vector2d& station_slope_W, double reach_m, const Vector2d& p_W, Bounds& bounds) {
  const Eigen::Vector3d along = place.sample.ds_W + place.t_slope * place.sample.dt_W;
  const Vector2d apart = p_W - place.sample.p_W.head<2>();
  const double distance = apart.norm();
  if (distance >= reach_m) return;
  const Vector2d away = distance > 0.0 ? Vector2d(apart / distance) : Vector2d::Zero();
  const auto [more, more_slope] = Steepening(distance, reach_m);
  bounds.Add({place.sample.p_W.z(), distance + more, along.z() * station_slope_W, (1.0 + more_slope) * (away - away.dot(along.head<2>()) * station_slope_W)}, distance);
}

void NetworkLand::FromRoad(const Piece& piece, const Vector2d& p_W, Bounds& bounds) const {
  const Road& road = network_->roads()[piece.road];
  const geometry::AxisPanel& panel = road.axis().panels()[piece.panel];
  EdgePlace place = PlaceOnEdge(road, panel, piece.stretch, p_W);
  const bool left = place.found_t_m > road.CentreAt(place.s_m).value;
  const double reach = left ? piece.left_reach_m : piece.right_reach_m;
  const Vector2d slope = place.pace > 0.0 ? Vector2d(place.axis.tangent_W / place.pace) : Vector2d::Zero();
  if (place.outside_m == 0.0 && HasKerbs(road.SectionAt(place.s_m))) FromEnd(place, road, p_W, bounds);
  else FromPlace(place, slope, place.beside ? reach : kHolds_m, p_W, bounds);
  const Eigen::Vector3d along = place.sample.ds_W + place.t_slope * place.sample.dt_W;
  const double length = along.head<2>().norm(), curvature = place.axis.curvature_1pm;
  if (place.beyond_m != 0.0 && std::fabs(curvature) > kStraight_1pm) {  // where the point would be found if the bend went on
    const double ahead = curvature * place.beyond_m, aside = 1.0 - curvature * place.found_t_m, t = (1.0 - std::hypot(ahead, aside)) / curvature;
    place.found_s_m += std::atan2(ahead, aside) / curvature;
    place.outside_m = std::max(0.0, place.outside_m + (left ? t - place.found_t_m : place.found_t_m - t));
    place.found_t_m = t;
  } else {
    place.found_s_m += place.beyond_m;
  }
  const double pace = 1.0 - curvature * (left ? place.outside_m : -place.outside_m) / length;
  const double off = TightestBound(along.z() / length, pace) / length;
  for (const double side : {-off, off}) {
    if (off == 0.0 || place.outside_m == 0.0) break;
    const double s = place.found_s_m + side * place.outside_m;
    if (!(s > piece.stretch.from_s_m && s < piece.stretch.to_s_m)) continue;  // posts stand at the ends
    const Vector2d found = place.beside ? slope : place.axis.tangent_W;
    const Vector2d station = found + side * (left ? 1.0 : -1.0) * (place.axis.left_W() - place.t_slope * found);
    FromPlace(MovedTo(s, road, panel, place), station, reach, p_W, bounds);
  }
  for (const Eigen::Vector3d& post_W : std::span(posts_W_).subspan(piece.first_post, piece.posts)) FromPost(post_W, p_W, bounds);
}

void NetworkLand::FromBoundary(const Piece& piece, const Vector2d& p_W, Bounds& bounds) const {
  const Vector2d way = piece.to_W - piece.from_W;
  const double part = std::clamp((p_W - piece.from_W).dot(way) / way.squaredNorm(), 0.0, 1.0);
  const Vector2d at = piece.from_W + part * way, apart = p_W - at;
  const double distance = apart.norm();
  if (distance >= kHolds_m) return;
  const network::GroundHeight height = piece.ground->At(at);
  const auto [more, more_slope] = Steepening(distance, kHolds_m);
  Bound bound{height.z_m, distance + more, Vector2d::Zero(), distance > 0.0 ? Vector2d((1.0 + more_slope) / distance * apart) : Vector2d::Zero()};
  if (part > 0.0 && part < 1.0) bound.z_slope_W = way * (way.dot(Vector2d(height.slope_x, height.slope_y)) / way.squaredNorm());
  bounds.Add(bound, distance);
}

// In the middle of both bounds; where the lower is the greater one, at the least slope by which they meet.
PlaneHeight NetworkLand::Meet(Bounds& bounds) {
  double slope = kBank;
  const auto low_at = [&](const Bound& bound) { return bound.z_m - slope * bound.distance_m; };
  const auto high_at = [&](const Bound& bound) { return bound.z_m + slope * bound.distance_m; };
  for (;;) {
    const Bound &low = bounds.all[bounds.low], &high = bounds.all[bounds.high];
    const double sum = low.distance_m + high.distance_m;
    const double steeper = sum > 0.0 ? (low.z_m - high.z_m) / sum : 0.0;  // the edges of two roads touch: a wall
    if (!(low_at(low) > high_at(high)) || !(steeper > slope)) break;
    slope = steeper;
    for (std::size_t i = 0; i < bounds.all.size(); ++i) {
      if (low_at(bounds.all[i]) > low_at(bounds.all[bounds.low])) bounds.low = i;
      if (high_at(bounds.all[i]) < high_at(bounds.all[bounds.high])) bounds.high = i;
    }
  }
  const Bound &low = bounds.all[bounds.low], &high = bounds.all[bounds.high];
  if (slope == kBank) return {0.5 * (low_at(low) + high_at(high)), 0.5 * (low.z_slope_W + high.z_slope_W + slope * (high.distance_slope_W - low.distance_slope_W))};
  const double sum = low.distance_m + high.distance_m, part = high.distance_m / sum, step = low.z_m - high.z_m;
  const Vector2d part_slope = (low.distance_m * high.distance_slope_W - high.distance_m * low.distance_slope_W) / (sum * sum);
  return {high.z_m + part * step, high.z_slope_W + part * (low.z_slope_W - high.z_slope_W) + step * part_slope};
}

// Of equally near ones the first. Where a place is asked after one beside it, the last answer is tried first, so that most others are known to be farther away.
std::uint32_t NetworkLand::NearestPiece(std::span<const std::uint32_t> near, const Vector2d& p_W) const {
  thread_local std::uint32_t last = 0;
  std::uint32_t nearest = near.front() * kBlock;
  double nearest_m = std::numeric_limits<double>::infinity();
  const auto look_at = [&](std::uint32_t piece) {
    const double distance_m = pieces_[piece].DistanceFrom(p_W);
    if (distance_m < nearest_m || (distance_m == nearest_m && piece < nearest)) nearest = piece, nearest_m = distance_m;
  };
  if (last < pieces_.size()) look_at(last);
  EachOf(near, [&](const Around& around) { return around.MayBeWithin(p_W, nearest_m); }, look_at);
  return last = nearest;
}

std::optional<PlaneHeight> NetworkLand::At(const Vector2d& p_W) const {
  if (!p_W.allFinite()) return std::nullopt;
  const std::span<const std::uint32_t> near = near_.At(p_W);
  if (near.empty()) return std::nullopt;
  thread_local Bounds bounds;
  bounds.Clear();
  const auto ask = [&](std::uint32_t index) {
    const Piece& piece = pieces_[index];
    piece.ground != nullptr ? FromBoundary(piece, p_W, bounds) : FromRoad(piece, p_W, bounds);
  };
  const std::uint32_t nearest = NearestPiece(near, p_W);
  ask(nearest);
  // First only those that may hold the land more tightly.
  const auto may_tighten = [&](const Around& around) {
    if (bounds.all.empty()) return around.MayBeWithin(p_W, kHolds_m);
    const double within_m = std::min(kHolds_m, std::max(around.heights.high_m - bounds.Low(), bounds.High() - around.heights.low_m) / kBank);
    return within_m > 0.0 && around.MayBeWithin(p_W, within_m);
  };
  EachOf(near, may_tighten, [&](std::uint32_t piece) {
    const double distance_m = pieces_[piece].DistanceFrom(p_W);
    if (piece == nearest || distance_m >= kHolds_m) return;
    const EdgeHeights& heights = pieces_[piece].heights;
    const double bank = kBank * (distance_m + Steepening(distance_m, kHolds_m).first);
    if (bounds.all.empty() || heights.high_m - bank > bounds.Low() || heights.low_m + bank < bounds.High()) ask(piece);
  });
  if (!(bounds.nearest_m < kVerge_m)) return std::nullopt;
  if (bounds.Low() > bounds.High()) {
    bounds.Clear();
    EachOf(near, [&](const Around& around) { return around.MayBeWithin(p_W, kHolds_m); },
           [&](std::uint32_t piece) {
             if (pieces_[piece].DistanceFrom(p_W) < kHolds_m) ask(piece);
           });
  }
  return Meet(bounds);
}

}  // namespace rodeira::road
