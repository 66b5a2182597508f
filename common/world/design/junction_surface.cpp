// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/junction_surface.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/base/assert.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/core/geometry/polygon.hpp"

namespace rodeira::design {
namespace {

constexpr double kOnTheLine_m = 1e-9;

// What of a road at one s: its lanes' edges from the right one to the left one, with heights that leave kerbs out.
struct Edge {
  double t_m;
  Eigen::Vector3d p_W;
  bool paved;  // lanes on both sides that are paved, or the outermost such edge
};

bool IsPavedLane(network::LaneType type) {
  return type != network::LaneType::kNone && type != network::LaneType::kMedian;
}

std::vector<Edge> EdgesAtEnd(const network::Road& road, network::End end) {
  const double s = end == network::End::kStart ? 0.0 : road.length_m();
  const std::size_t index = end == network::End::kStart ? 0 : road.spec().sections.size() - 1;
  const network::LaneSection& section = road.spec().sections[index];
  const network::LaneSpan bare{};  // a lane without heights
  std::vector<Edge> edges;
  const auto add = [&](double t, bool paved) { edges.push_back({t, road.Surface(s, t, section, bare).p_W, paved}); };
  for (std::size_t i = section.right.size(); i-- > 0;) {
    bool paved = IsPavedLane(section.right[i].type);
    for (std::size_t k = i + 1; k < section.right.size(); ++k) paved = paved || IsPavedLane(section.right[k].type);
    add(section.Span(section.right[i].id, road.CentreAt(s), s)->outer_t_m, paved);
  }
  add(road.CentreAt(s).value, true);
  for (std::size_t i = 0; i < section.left.size(); ++i) {
    bool paved = IsPavedLane(section.left[i].type);
    for (std::size_t k = i + 1; k < section.left.size(); ++k) paved = paved || IsPavedLane(section.left[k].type);
    add(section.Span(section.left[i].id, road.CentreAt(s), s)->outer_t_m, paved);
  }
  return edges;
}

// One arm's height at p and how it changes; its distance and how that changes.
struct Share {
  double z, distance;
  Eigen::Vector2d slope, away;
};

Share ShareOf(const ArmSection& arm, const Eigen::Vector2d& p) {
  const Eigen::Vector2d across = (arm.right_W - arm.left_W).normalized();
  const double width = arm.at_m.back();
  const double along = (p - arm.left_W).dot(across);
  const double held = std::clamp(along, 0.0, width), beyond = (p - arm.left_W).dot(arm.inward_W);
  auto after = std::upper_bound(arm.at_m.begin() + 1, arm.at_m.end() - 1, held);
  const auto i = static_cast<std::size_t>(after - arm.at_m.begin());
  const double slope = (arm.z_m[i] - arm.z_m[i - 1]) / (arm.at_m[i] - arm.at_m[i - 1]);
  Share share;
  share.z = arm.z_m[i - 1] + slope * (held - arm.at_m[i - 1]) + arm.grade * beyond;
  share.slope = arm.grade * arm.inward_W;
  if (along == held) share.slope += slope * across;
  const Eigen::Vector2d apart = p - (arm.left_W + held * across);
  share.distance = apart.norm();
  share.away = share.distance > 0.0 ? Eigen::Vector2d(apart / share.distance) : arm.inward_W;
  return share;
}

}  // namespace

std::pair<Eigen::Vector2d, Eigen::Vector2d> EdgesAt(const network::Road& road, network::End end, bool paved) {
  const std::vector<Edge> edges = EdgesAtEnd(road, end);
  const auto first = std::find_if(edges.begin(), edges.end(), [&](const Edge& edge) { return !paved || edge.paved; });
  const auto last = std::find_if(edges.rbegin(), edges.rend(), [&](const Edge& edge) { return !paved || edge.paved; });
  const Eigen::Vector2d right = first->p_W.head<2>(), left = last->p_W.head<2>();
  // Looking out of the junction is along s where the road starts here.
  return end == network::End::kStart ? std::pair(left, right) : std::pair(right, left);
}

ArmSection SectionOf(const network::Road& road, network::End end, double weight) {
  std::vector<Edge> edges = EdgesAtEnd(road, end);
  const bool starts = end == network::End::kStart;
  if (starts) std::reverse(edges.begin(), edges.end());  // from the left, looking out
  ArmSection arm;
  arm.weight = weight;
  arm.left_W = edges.front().p_W.head<2>();
  arm.right_W = edges.back().p_W.head<2>();
  const Eigen::Vector2d across = (arm.right_W - arm.left_W).normalized();
  arm.inward_W = -geometry::Left(across);
  for (const Edge& edge : edges) {
    const double at = (edge.p_W.head<2>() - arm.left_W).dot(across);
    if (!arm.at_m.empty() && at - arm.at_m.back() < 1e-6) continue;
    arm.at_m.push_back(at);
    arm.z_m.push_back(edge.p_W.z());
  }
  RODEIRA_ASSERT(arm.at_m.size() >= 2);
  const double s = starts ? 0.0 : road.length_m();
  const Eigen::Vector3d ds = road.Surface(s, road.CentreAt(s).value).ds_W;
  arm.grade = (starts ? -1.0 : 1.0) * ds.z() / ds.head<2>().norm();
  return arm;
}

JunctionSurface::JunctionSurface(std::string id, std::vector<ArmSection> arms, std::vector<Eigen::Vector2d> outline,
                                 std::vector<Eigen::Vector2d> paved, std::vector<FreeEdge> free_edges)
    : id_(std::move(id)),
      arms_(std::move(arms)),
      outline_(std::move(outline)),
      paved_(std::move(paved)),
      free_edges_(std::move(free_edges)) {
  RODEIRA_ASSERT(arms_.size() >= 2 && outline_.size() >= 3);
  low_ = high_ = outline_[0];
  for (const Eigen::Vector2d& p : outline_) {
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
}

bool JunctionSurface::Contains(const Eigen::Vector2d& p) const {
  if (p.x() < low_.x() || p.y() < low_.y() || p.x() > high_.x() || p.y() > high_.y()) return false;
  return geometry::InPolygon(outline_, p);
}

bool JunctionSurface::IsPaved(const Eigen::Vector2d& p) const { return geometry::InPolygon(paved_, p); }

JunctionHeight JunctionSurface::At(const Eigen::Vector2d& p) const {
  double weights = 0.0, heights = 0.0;
  Eigen::Vector2d weight_slopes = Eigen::Vector2d::Zero(), height_slopes = Eigen::Vector2d::Zero();
  for (const ArmSection& arm : arms_) {
    const Share share = ShareOf(arm, p);
    if (share.distance < kOnTheLine_m) return {share.z, share.slope.x(), share.slope.y()};
    const double weight = arm.weight / (share.distance * share.distance);
    const Eigen::Vector2d weight_slope = -2.0 * weight / share.distance * share.away;
    weights += weight;
    heights += weight * share.z;
    weight_slopes += weight_slope;
    height_slopes += weight * share.slope + share.z * weight_slope;
  }
  const double z = heights / weights;
  const Eigen::Vector2d slope = (height_slopes - z * weight_slopes) / weights;
  return {z, slope.x(), slope.y()};
}

}  // namespace rodeira::design
