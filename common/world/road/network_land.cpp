// SPDX-License-Identifier: Apache-2.0
#include "common/world/road/network_land.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/core/geometry/plane.hpp"
#include "common/world/road/road_edge.hpp"

namespace rodeira::road {
namespace {

using Eigen::Vector2d;

constexpr double kOfRadius = 0.9;       // what moves with p reaches so far to the middle of a bend
constexpr double kMinReach_m = 0.5;     // where lanes fold
constexpr double kPostsOfRadius = 0.1;  // posts in a bend stand so much of its radius apart
constexpr double kMinApart_m = 0.5;
constexpr int kCurvatures = 4;  // samples of a panel's
constexpr double kDistanceRounding_m = 1e-6;
constexpr double kStraight_1pm = 1e-7;
constexpr double kHeldSide_m = 8.0;
constexpr double kSurelyVerge = 0.8;

float NextFloatBelow(double value) {
  return std::nextafter(static_cast<float>(value), -std::numeric_limits<float>::infinity());
}

// How far from an edge within a bend what moves with p may reach.
double ReachOf(double curvature_1pm, double edge_m) {
  if (!(curvature_1pm > 0.0)) return kHolds_m;
  return std::clamp(kOfRadius * (1.0 / curvature_1pm - edge_m), kMinReach_m, kHolds_m);
}

// Of an edge on a circle of radius r that climbs evenly by g, seen from a point at the radius q r: how far along it
// from where it is nearest, by the distance there, lies the place for which z - |p - place| / 2 is greatest, or z + |p
// - place| / 2 least. By h = 2 g and X = (1 - h²)(q² - h²) it is the angle φ with cos φ = (h² + √X) / q, which is
// written here so that nothing is lost for r = ∞, q = 1. 0: there is none.
double TightestBound(double climb, double q) {
  const double h = climb / kBank, x2 = (1.0 - h * h) * (q * q - h * h);
  if (!(h * h < 1.0) || !(q > std::fabs(h))) return 0.0;
  const double by = h / std::sqrt(2.0 * q * (q - h * h + std::sqrt(x2))), sine = by * std::fabs(q - 1.0);
  return 2.0 * by * (std::fabs(sine) > 1e-8 ? std::asin(sine) / sine : 1.0);
}

bool HasKerbs(const network::LaneSection& section) {
  const auto stands = [](const network::Lane& lane) { return !lane.heights.empty(); };
  return std::any_of(section.left.begin(), section.left.end(), stands) ||
         std::any_of(section.right.begin(), section.right.end(), stands);
}

}  // namespace

NetworkLand::NetworkLand(std::shared_ptr<const network::Network> network)
    : network_(std::move(network)), decks_(FindDecks(*network_)) {
  for (std::uint32_t road = 0; road < network_->roads().size(); ++road) AddPieces(road);
  for (const network::Junction& junction : network_->junctions()) {
    if (junction.ground != nullptr) AddBoundary(*junction.ground);
  }
  for (const Piece& piece : pieces_) {
    around_.push_back({0.5 * (piece.from_W + piece.to_W),
                       0.5 * (piece.to_W - piece.from_W).norm() + piece.edges.beside_m + kDistanceRounding_m,
                       piece.heights});
  }
  std::vector<SquareLists::Strip> strips;
  for (std::size_t first = 0; first < around_.size(); first += kBlock) {
    const auto some = std::span(around_).subspan(first, std::min<std::size_t>(kBlock, around_.size() - first));
    Vector2d low_W = some.front().middle_W, high_W = low_W;
    Around& block = blocks_.emplace_back(some.front());
    for (const Around& around : some) {
      low_W = low_W.cwiseMin(around.middle_W), high_W = high_W.cwiseMax(around.middle_W);
      block.heights = {std::min(block.heights.low_m, around.heights.low_m),
                       std::max(block.heights.high_m, around.heights.high_m)};
    }
    block.middle_W = 0.5 * (low_W + high_W), block.radius_m = 0.0;
    for (const Around& around : some)
      block.radius_m = std::max(block.radius_m, (around.middle_W - block.middle_W).norm() + around.radius_m);
    block.radius_m += kDistanceRounding_m;
    strips.push_back({block.middle_W, block.middle_W, block.radius_m + kHolds_m});
  }
  near_ = SquareLists(strips);
  held_ = LazySquares<Held>(near_.grid(), kHeldSide_m);
}

bool NetworkLand::IsOnDeck(std::uint32_t road, double s_m) const {
  return std::any_of(decks_[road].begin(), decks_[road].end(),
                     [s_m](const Stretch& deck) { return s_m > deck.from_s_m && s_m < deck.to_s_m; });
}

void NetworkLand::AddPieces(std::uint32_t road_index) {
  const network::Road& road = network_->roads()[road_index];
  const std::vector<geometry::AxisPanel>& panels = road.axis().panels();
  for (const Stretch& standing : StandingOn(road, decks_[road_index])) {
    for (std::uint32_t i = 0; i < panels.size(); ++i) {
      const geometry::AxisPanel& panel = panels[i];
      const double begin = std::max(panel.begin_s_m(), standing.from_s_m),
                   end = std::min(panel.end_s_m(), standing.to_s_m);
      if (!(begin < end)) continue;
      Piece piece;
      piece.road = road_index, piece.panel = i, piece.stretch = {begin, end};
      piece.from_W = road.axis().At(panel, -panel.half_m).p_W, piece.to_W = road.axis().At(panel, panel.half_m).p_W;
      piece.edges = EdgesBeside(road, panel);
      if (piece.from_W != piece.to_W) piece.left_W = geometry::Left((piece.to_W - piece.from_W).normalized());
      piece.heights = HeightsOfEdges(road, begin, end);
      piece.steady = SteadyEdgesOf(road, piece.stretch);
      piece.right_reach_m = piece.left_reach_m = kHolds_m;
      for (int k = 0; k <= kCurvatures; ++k) {
        const double s = begin + (end - begin) * k / kCurvatures,
                     curvature = road.axis().At(panel, s - panel.middle_s_m).curvature_1pm;
        double right, left;
        road.SectionAt(s).Bounds(road.spec().lane_offset, s, s, right, left);
        piece.left_reach_m = std::min(piece.left_reach_m, ReachOf(curvature, left)),
        piece.right_reach_m = std::min(piece.right_reach_m, ReachOf(-curvature, -right));
      }
      AddPosts(road, panel, piece);
      pieces_.push_back(piece);
    }
  }
}

// On both edges at both ends, where a lane section begins, and in a bend some more.
void NetworkLand::AddPosts(const network::Road& road, const geometry::AxisPanel& panel, Piece& piece) {
  const auto& [from, to] = piece.stretch;
  std::vector<double> stations{from, to};
  for (const network::LaneSection& section : road.spec().sections) {
    if (section.s_m > from && section.s_m < to)
      stations.insert(stations.end(), {std::nextafter(section.s_m, 0.0), section.s_m});
  }
  const double reach = std::min(piece.left_reach_m, piece.right_reach_m);
  if (reach < kHolds_m) {
    const int apart =
        static_cast<int>(std::ceil((to - from) / std::max(kMinApart_m, kPostsOfRadius / kOfRadius * reach)));
    for (int k = 1; k < apart; ++k) stations.push_back(from + (to - from) * k / apart);
  }
  piece.first_post = static_cast<std::uint32_t>(posts_W_.size());
  for (const double s : stations) {
    const network::LaneSection& section = road.SectionAt(s);
    const geometry::PlanPoint axis = road.axis().At(panel, s - panel.middle_s_m);
    const auto put = [&](double t, const network::LaneSpan& span) {
      posts_W_.push_back(road.Surface(axis, s, t, section, span).p_W);
    };
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
    piece.heights = {low - most - kSampleMargin_m, high + most + kSampleMargin_m};
    pieces_.push_back(piece);
  }
}

void NetworkLand::FromPost(const Eigen::Vector3d& post_W, const Vector2d& p_W, LandBounds& bounds) {
  const Vector2d apart = p_W - post_W.head<2>();
  const double distance = apart.norm();
  if (distance >= kHolds_m) return;
  const auto [more, more_slope] = Steepening(distance, kHolds_m);
  bounds.Add({post_W.z(), distance + more, Vector2d::Zero(),
              distance > 0.0 ? Vector2d((1.0 + more_slope) / distance * apart) : Vector2d::Zero()},
             distance);
}

// Behind the end of a road with kerbs: so that nothing steps there, a lane's end holds the land ever less towards the
// lane's edges, where posts stand.
void NetworkLand::FromEnd(const EdgePlace& place, const network::Road& road, const Vector2d& p_W,
                          LandBounds& bounds) const {
  double outside;
  const network::LaneSpan span = road.SectionAt(place.s_m).At(place.t_m, road.CentreAt(place.s_m), place.s_m, outside);
  const Vector2d apart = p_W - place.sample.p_W.head<2>();
  const double distance = apart.norm(), to_inner = std::fabs(place.t_m - span.inner_t_m),
               to_outer = std::fabs(place.t_m - span.outer_t_m), inside = std::min(to_inner, to_outer);
  if (distance >= kHolds_m || (!(inside > 1e-9) && distance > 0.0)) return;
  const auto [more, more_slope] = Steepening(distance, kHolds_m);
  const Vector2d away = distance > 0.0 ? Vector2d(apart / distance) : Vector2d::Zero();
  const double ratio = distance > 0.0 ? distance / inside : 0.0;
  const bool grows = (place.t_m > span.inner_t_m) == (to_inner < to_outer);  // with t
  const Vector2d inside_slope = (grows ? 1.0 : -1.0) * place.axis.left_W();
  const Eigen::Vector3d& across = place.sample.dt_W;
  bounds.Add({place.sample.p_W.z(), distance + more + distance * ratio, across.z() * place.axis.left_W(),
              (1.0 + more_slope + 2.0 * ratio) * (away - away.dot(across.head<2>()) * place.axis.left_W()) -
                  ratio * ratio * inside_slope},
             distance);
}

// station_slope_W: how the place's s goes as p moves.
void NetworkLand::FromPlace(const EdgePlace& place, const Vector2d& station_slope_W, double reach_m,
                            const Vector2d& p_W, LandBounds& bounds) {
  const Eigen::Vector3d along = place.sample.ds_W + place.t_slope * place.sample.dt_W;
  const Vector2d apart = p_W - place.sample.p_W.head<2>();
  const double distance = apart.norm();
  if (distance >= reach_m) return;
  const Vector2d away = distance > 0.0 ? Vector2d(apart / distance) : Vector2d::Zero();
  const auto [more, more_slope] = Steepening(distance, reach_m);
  bounds.Add({place.sample.p_W.z(), distance + more, along.z() * station_slope_W,
              (1.0 + more_slope) * (away - away.dot(along.head<2>()) * station_slope_W)},
             distance);
}

void NetworkLand::FromRoad(const Piece& piece, const Vector2d& p_W, LandBounds& bounds) const {
  const network::Road& road = network_->roads()[piece.road];
  const geometry::AxisPanel& panel = road.axis().panels()[piece.panel];
  EdgePlace place = PlaceOnEdge(road, panel, piece.stretch, p_W, piece.steady);
  const bool left = place.found_t_m > road.CentreAt(place.s_m).value;
  const double reach = left ? piece.left_reach_m : piece.right_reach_m;
  const Vector2d slope = place.pace > 0.0 ? Vector2d(place.axis.tangent_W / place.pace) : Vector2d::Zero();
  if (place.outside_m == 0.0 && HasKerbs(road.SectionAt(place.s_m)))
    FromEnd(place, road, p_W, bounds);
  else
    FromPlace(place, slope, place.beside ? reach : kHolds_m, p_W, bounds);
  const Eigen::Vector3d along = place.sample.ds_W + place.t_slope * place.sample.dt_W;
  const double length = along.head<2>().norm(), curvature = place.axis.curvature_1pm;
  if (place.beyond_m != 0.0 &&
      std::fabs(curvature) > kStraight_1pm) {  // where the point would be found if the bend went on
    const double ahead = curvature * place.beyond_m, aside = 1.0 - curvature * place.found_t_m,
                 t = (1.0 - std::hypot(ahead, aside)) / curvature;
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
    FromPlace(MovedTo(s, road, panel, place, piece.steady), station, reach, p_W, bounds);
  }
  const SteeperBounds* steeper = bounds.steeper();
  const bool all = steeper == nullptr && (bounds.every() || !(bounds.nearest_m() < kVerge_m));
  for (const Eigen::Vector3d& post_W : std::span(posts_W_).subspan(piece.first_post, piece.posts)) {
    const double within_m = steeper != nullptr
                                ? steeper->Within_m(post_W.z(), post_W.z())
                                : bounds.TightensWithin(post_W.z(), post_W.z()) +
                                      kDistanceRounding_m;  // most hold nothing: that is told without a root
    if (all || (within_m > 0.0 && (p_W - post_W.head<2>()).squaredNorm() <= within_m * within_m))
      FromPost(post_W, p_W, bounds);
  }
}

void NetworkLand::FromBoundary(const Piece& piece, const Vector2d& p_W, LandBounds& bounds) const {
  const Vector2d way = piece.to_W - piece.from_W;
  const double part = std::clamp((p_W - piece.from_W).dot(way) / way.squaredNorm(), 0.0, 1.0);
  const Vector2d at = piece.from_W + part * way, apart = p_W - at;
  const double distance = apart.norm();
  if (distance >= kHolds_m) return;
  const network::GroundHeight height = piece.ground->At(at);
  const auto [more, more_slope] = Steepening(distance, kHolds_m);
  LandBound bound{height.z_m, distance + more, Vector2d::Zero(),
                  distance > 0.0 ? Vector2d((1.0 + more_slope) / distance * apart) : Vector2d::Zero()};
  if (part > 0.0 && part < 1.0)
    bound.z_slope_W = way * (way.dot(Vector2d(height.slope_x, height.slope_y)) / way.squaredNorm());
  bounds.Add(bound, distance);
}

// Leaves out pieces that for no point of the square are the nearest one, nor bound the land more tightly than others.
// Posts have fixed places, so their bounds hold everywhere in the square.
NetworkLand::Held NetworkLand::MakeHeld(std::span<const std::uint32_t> blocks, const Vector2d& middle_W) const {
  const double radius_m = held_.radius_m();
  struct Known {
    double distance_m;
    std::uint32_t piece;
  };
  thread_local std::vector<Known> known;
  known.clear();
  EachOf(
      blocks, [&](const Around& around) { return around.MayBeWithin(middle_W, kHolds_m + radius_m); },
      [&](std::uint32_t piece) {
        known.push_back({pieces_[piece].DistanceFrom(middle_W), piece});
      });
  std::sort(known.begin(), known.end(), [](const Known& a, const Known& b) {
    return a.distance_m < b.distance_m || (a.distance_m == b.distance_m && a.piece < b.piece);
  });
  Held held{middle_W, {}};
  if (known.empty() || known.front().distance_m - radius_m > kVerge_m) return held;
  LandBounds bounds;
  bounds.Clear(false);
  for (const auto& [distance_m, index] : known) {
    const Piece& piece = pieces_[index];
    if (!(distance_m + radius_m < bounds.TightensWithin(piece.heights.low_m, piece.heights.high_m))) continue;
    for (const Eigen::Vector3d& post_W : std::span(posts_W_).subspan(piece.first_post, piece.posts)) {
      const double farthest_m = (middle_W - post_W.head<2>()).norm() + radius_m;
      if (Steepening(farthest_m, kHolds_m).first == 0.0) bounds.Add({post_W.z(), farthest_m}, farthest_m);
    }
  }
  const double nearest_m = known.front().distance_m + 2.0 * radius_m;
  // Where the nearest piece may be beyond the verge, all pieces within the verge are examined.
  const double told_m = nearest_m < kSurelyVerge * kVerge_m ? nearest_m : std::max(nearest_m, kVerge_m + radius_m);
  for (const auto& [distance_m, index] : known) {
    const EdgeHeights& heights = pieces_[index].heights;
    const double least_m = distance_m - radius_m - kDistanceRounding_m;
    if (distance_m > told_m + kDistanceRounding_m && least_m > bounds.TightensWithin(heights.low_m, heights.high_m))
      continue;
    const float low_m = NextFloatBelow(heights.low_m), high_m = -NextFloatBelow(-heights.high_m);
    held.pieces.push_back({index, NextFloatBelow(distance_m - kDistanceRounding_m), low_m, high_m, low_m, high_m});
  }
  for (std::size_t i = held.pieces.size(); i-- > 1;) {
    Held::Near &near = held.pieces[i - 1], &behind = held.pieces[i];
    near.rest_low_m = std::min(near.rest_low_m, behind.rest_low_m),
    near.rest_high_m = std::max(near.rest_high_m, behind.rest_high_m);
  }
  held.pieces.shrink_to_fit();
  return held;
}

// The nearest piece; of equally near ones the first.
std::optional<std::uint32_t> NetworkLand::NearestPiece(const Held& held, const Vector2d& p_W, double off_m) const {
  std::optional<std::uint32_t> nearest;
  double nearest_m = kVerge_m;
  for (const Held::Near& near : held.pieces) {
    if (static_cast<double>(near.distance_m) - off_m > nearest_m) break;
    const double distance_m = pieces_[near.piece].DistanceFrom(p_W);
    if (distance_m < nearest_m || (nearest && distance_m == nearest_m && near.piece < *nearest))
      nearest = near.piece, nearest_m = distance_m;
  }
  return nearest;
}

void NetworkLand::Query(std::uint32_t index, const Vector2d& p_W, LandBounds& bounds) const {
  const Piece& piece = pieces_[index];
  bounds.Rank(index + 1);
  piece.ground != nullptr ? FromBoundary(piece, p_W, bounds) : FromRoad(piece, p_W, bounds);
}

std::optional<PlaneHeight> NetworkLand::At(const Vector2d& p_W) const {
  if (!p_W.allFinite()) return std::nullopt;
  const Held* held =
      held_.At(p_W, [&](std::size_t square, const Vector2d& middle_W) { return MakeHeld(near_.Of(square), middle_W); });
  if (held == nullptr) return std::nullopt;
  const double off_m = (p_W - held->middle_W).norm();
  const std::optional<std::uint32_t> nearest = NearestPiece(*held, p_W, off_m);
  if (!nearest) return std::nullopt;
  thread_local LandBounds bounds;
  bounds.Clear(false);
  Query(*nearest, p_W, bounds);
  bounds.Leads();  // of equally tight bounds those of the nearest piece count
  for (const Held::Near& near : held->pieces) {
    const double least_m = static_cast<double>(near.distance_m) - off_m;
    const bool is_verge = bounds.nearest_m() < kVerge_m;
    if (is_verge &&
        !(least_m < bounds.TightensWithin(static_cast<double>(near.rest_low_m), static_cast<double>(near.rest_high_m))))
      break;  // nor is any behind it nearer
    if (is_verge &&
        !(least_m < bounds.TightensWithin(static_cast<double>(near.low_m), static_cast<double>(near.high_m))))
      continue;
    const Piece& piece = pieces_[near.piece];
    if (is_verge && !(piece.AsideFrom(p_W) <
                      bounds.TightensWithin(piece.heights.low_m, piece.heights.high_m) + kDistanceRounding_m))
      continue;
    const double distance_m = piece.DistanceFrom(p_W);
    if (near.piece == *nearest || distance_m >= kHolds_m) continue;
    const double more_m = Steepening(distance_m, kHolds_m).first;
    if ((!is_verge && distance_m < kVerge_m) ||
        distance_m + more_m < bounds.TightensWithin(piece.heights.low_m, piece.heights.high_m))
      Query(near.piece, p_W, bounds);
  }
  if (!(bounds.nearest_m() < kVerge_m)) return std::nullopt;
  return bounds.low_m() > bounds.high_m() ? Steep(bounds, p_W) : bounds.Meet();
}

std::optional<PlaneHeight> NetworkLand::AtBySearch(const Vector2d& p_W) const {
  const auto farther = [&](const Piece& a, const Piece& b) { return a.DistanceFrom(p_W) < b.DistanceFrom(p_W); };
  if (pieces_.empty() || !p_W.allFinite()) return std::nullopt;
  const auto nearest =
      static_cast<std::uint32_t>(std::min_element(pieces_.begin(), pieces_.end(), farther) - pieces_.begin());
  LandBounds bounds;
  const auto ask_all = [&](std::uint32_t but) {
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) {
      if (piece != but && pieces_[piece].DistanceFrom(p_W) < kHolds_m) Query(piece, p_W, bounds);
    }
  };
  bounds.Clear(true);
  Query(nearest, p_W, bounds);
  bounds.Leads();
  ask_all(nearest);
  if (!(bounds.nearest_m() < kVerge_m)) return std::nullopt;
  if (bounds.low_m() > bounds.high_m()) {
    bounds.Clear(true);
    ask_all(static_cast<std::uint32_t>(pieces_.size()));
  }
  return bounds.Meet();
}

// Where no land of the slope kBank lies between all bounds all that may matter at a steeper one are looked at: at the
// least slope by which the tightest two meet, and at any greater one, what is farther than they are and holds the land
// no tighter does not.
PlaneHeight NetworkLand::Steep(const LandBounds& tightest, const Vector2d& p_W) const {
  const SteeperBounds steeper(tightest);
  const auto within = [&](const EdgeHeights& heights) {
    return std::min(kHolds_m, steeper.Within_m(heights.low_m, heights.high_m));
  };
  thread_local LandBounds bounds;
  bounds.ClearForSteeper(steeper);
  EachOf(
      near_.At(p_W), [&](const Around& around) { return around.MayBeWithin(p_W, within(around.heights)); },
      [&](std::uint32_t piece) {
        const double distance_m = pieces_[piece].DistanceFrom(p_W);
        if (distance_m < kHolds_m && distance_m <= within(pieces_[piece].heights)) Query(piece, p_W, bounds);
      });
  return bounds.Meet();
}

}  // namespace rodeira::road
