// SPDX-License-Identifier: Apache-2.0
#include "common/driving/driver/route_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/plane.hpp"

namespace rodeira::driver {
namespace {

constexpr double kNode_m = 0.5;
constexpr double kBendHalfLength_m = 0.25;  // the curvature is measured over twice this
constexpr double kUnsaid_mps = 50.0 / 3.6;  // where a network says no limit
constexpr double kNoLimit_mps = 130.0 / 3.6;
constexpr double kBeyond_m = 1e-6;
constexpr double kReach_m = 2.0 * kNode_m;  // a place is looked for so far from its nearest node

}  // namespace

RoutePath::RoutePath(const network::Network& network, std::vector<RouteLeg> legs)
    : network_(&network), legs_(std::move(legs)) {
  RODEIRA_ASSERT(!legs_.empty());
  double d = 0.0;
  std::vector<Eigen::Vector3d> points_W;
  for (std::size_t leg = 0; leg < legs_.size(); ++leg) {
    const network::LaneSection& section = network.Section(legs_[leg].lane);
    const double length = section.end_s_m - section.s_m;
    const int count = 1 + static_cast<int>(length / kNode_m);
    const auto station = [&](double i) {
      return legs_[leg].along ? section.s_m + length * i / count : section.end_s_m - length * i / count;
    };
    for (int i = 0; i <= count; ++i) {
      if (i > 0) {  // Gauss's rule of two points
        const double h = length / count, off = 0.5 / std::sqrt(3.0);
        const double speed = MotionAt({leg, station(i - 0.5 - off)}).v_W.head<2>().norm() +
                             MotionAt({leg, station(i - 0.5 + off)}).v_W.head<2>().norm();
        d += 0.5 * h * speed;
      }
      nodes_.push_back({d, leg, station(i)});
      points_W.push_back(MotionAt({leg, station(i)}).p_W);
    }
  }
  boxes_.emplace(std::move(points_W));
}

double RoutePath::Distance(std::size_t leg, double s_m) const {
  const bool along = legs_[leg].along;
  const auto after = std::partition_point(nodes_.begin(), nodes_.end(), [&](const Node& node) {
    return node.leg < leg || (node.leg == leg && (along ? node.s_m < s_m : node.s_m > s_m));
  });
  if (after == nodes_.begin() || (after - 1)->leg != leg) return after->d_m;
  const Node& before = *(after - 1);
  if (after == nodes_.end() || after->leg != leg) return before.d_m;
  return before.d_m + (s_m - before.s_m) / (after->s_m - before.s_m) * (after->d_m - before.d_m);
}

RoutePath::Spot RoutePath::SpotAt(double d_m) const {
  return SpotBefore(
      std::upper_bound(nodes_.begin(), nodes_.end(), d_m, [](double d, const Node& node) { return d < node.d_m; }),
      d_m);
}

RoutePath::Spot RoutePath::SpotNear(std::size_t node, double d_m) const {
  auto after = nodes_.begin() + static_cast<std::ptrdiff_t>(node);
  while (after != nodes_.end() && after->d_m <= d_m) ++after;
  while (after != nodes_.begin() && (after - 1)->d_m > d_m) --after;
  return SpotBefore(after, d_m);
}

RoutePath::Spot RoutePath::SpotBefore(std::vector<Node>::const_iterator after, double d_m) const {
  if (after == nodes_.begin()) return {nodes_.front().leg, nodes_.front().s_m};
  const Node& before = *(after - 1);
  if (after == nodes_.end() || after->leg != before.leg) return {before.leg, before.s_m};
  const double part = (d_m - before.d_m) / (after->d_m - before.d_m);
  return {before.leg, before.s_m + part * (after->s_m - before.s_m)};
}

RoutePath::Motion RoutePath::MotionAt(const Spot& spot) const {
  const network::LaneKey& lane = legs_[spot.leg].lane;
  const network::Road& road = network_->roads()[lane.road];
  const double s = road.Held(lane.section, spot.s_m);
  const auto span = network_->Span(lane, s);
  const network::SurfaceSample at = road.Surface(s, span->centre_t_m(), network_->Section(lane), *span);
  return {at.p_W, at.ds_W + 0.5 * (span->inner_slope + span->outer_slope) * at.dt_W};
}

Eigen::Vector3d RoutePath::TangentAt(double d_m) const {
  const Spot spot = SpotAt(d_m);
  return AheadOf(spot, MotionAt(spot));
}

Eigen::Vector3d RoutePath::AheadOf(const Spot& spot, const Motion& motion) const {
  const Eigen::Vector3d& v = motion.v_W;
  const Eigen::Vector3d ahead = legs_[spot.leg].along ? v : Eigen::Vector3d(-v);
  return {ahead.x(), ahead.y(), ahead.z() / ahead.head<2>().norm()};
}

double RoutePath::SpeedLimit_mps(double d_m) const {
  const Spot spot = SpotAt(d_m);
  const network::LaneKey& lane = legs_[spot.leg].lane;
  const auto limit = network_->roads()[lane.road].SpeedLimitAt(*network_->Find(lane), spot.s_m);
  return limit ? std::clamp(*limit, 1.0, kNoLimit_mps) : kUnsaid_mps;
}

LaneFrame RoutePath::At(double d_m) const {
  const double d = std::clamp(d_m, 0.0, length_m());
  const Spot spot = SpotAt(d);
  const Motion motion = MotionAt(spot);
  const Eigen::Vector3d ahead = AheadOf(spot, motion);
  LaneFrame frame;
  frame.p_W = motion.p_W;
  frame.heading_rad = std::atan2(ahead.y(), ahead.x());
  frame.grade = ahead.z();
  const double low = std::max(0.0, d - kBendHalfLength_m), high = std::min(length_m(), d + kBendHalfLength_m);
  const Eigen::Vector2d before = TangentAt(low).head<2>(), after = TangentAt(high).head<2>();
  frame.curvature_1pm = std::atan2(geometry::Cross(before, after), before.dot(after)) / (high - low);
  return frame;
}

Eigen::Vector3d RoutePath::MiddleAt(double d_m) const { return MotionAt(SpotAt(std::clamp(d_m, 0.0, length_m()))).p_W; }

double RoutePath::HeadingAt(double d_m) const {
  const Eigen::Vector3d ahead = TangentAt(std::clamp(d_m, 0.0, length_m()));
  return std::atan2(ahead.y(), ahead.x());
}

double RoutePath::VerticalCurvature_1pm(double d_m) const {
  const double low = std::max(0.0, d_m - 4.0 * kBendHalfLength_m),
               high = std::min(length_m(), d_m + 4.0 * kBendHalfLength_m);
  return (TangentAt(high).z() - TangentAt(low).z()) / (high - low);
}

Eigen::Vector3d RoutePath::Position(double d_m, double offset_m) const {
  const Spot spot = SpotAt(std::clamp(d_m, 0.0, length_m()));
  const network::LaneKey& lane = legs_[spot.leg].lane;
  const network::Road& road = network_->roads()[lane.road];
  const double s = road.Held(lane.section, spot.s_m);
  const double middle = network_->Span(lane, s)->centre_t_m();
  return road.Surface(s, legs_[spot.leg].along ? middle + offset_m : middle - offset_m).p_W;
}

std::optional<Way::Place> RoutePath::Locate(double x_m, double y_m, std::optional<double> z_m) const {
  const Eigen::Vector2d p(x_m, y_m);
  const auto nearest = boxes_->Nearest(p, z_m, network::Network::kLevel_m, boxes_->Likely(p));
  return nearest ? PlaceNear(*nearest, p) : std::nullopt;
}

std::optional<Way::Place> RoutePath::Near(std::size_t& hint, double x_m, double y_m, std::optional<double> z_m,
                                          const Range& range) const {
  const Eigen::Vector2d p(x_m, y_m);
  const auto nearest = boxes_->Nearest(p, z_m, network::Network::kLevel_m, hint);
  if (!nearest) return std::nullopt;
  hint = *nearest;
  const double node_m = nodes_[*nearest].d_m;
  if (node_m + kReach_m < range.from_m || node_m - kReach_m > range.to_m) return std::nullopt;
  return PlaceNear(*nearest, p);
}

std::optional<Way::Place> RoutePath::PlaceNear(std::size_t node, const Eigen::Vector2d& p) const {
  const double node_m = nodes_[node].d_m;
  double d = node_m;
  Eigen::Vector2d away, way, ahead;
  const auto look = [&] {
    const Spot spot = SpotNear(node, d);
    const Motion motion = MotionAt(spot);
    away = p - motion.p_W.head<2>();
    way = AheadOf(spot, motion).head<2>();
    ahead = way.normalized();
  };
  look();
  for (int turn = 0; turn < 4; ++turn) {
    const double before = d;
    d = std::clamp(d + std::clamp(away.dot(ahead), -kNode_m, kNode_m), std::max(0.0, node_m - kReach_m),
                   std::min(length_m(), node_m + kReach_m));
    if (d == before) break;
    look();
  }
  const double along = away.dot(ahead);
  if ((d == 0.0 && along < -kBeyond_m) || (d == length_m() && along > kBeyond_m)) return std::nullopt;
  return Place{d, geometry::Cross(ahead, away), std::atan2(way.y(), way.x())};
}

}  // namespace rodeira::driver
