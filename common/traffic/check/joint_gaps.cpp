// SPDX-License-Identifier: Apache-2.0
#include "common/traffic/check/joint_gaps.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/geometry/plane.hpp"

namespace rodeira::traffic {
namespace {

constexpr double kFarthest_m = 2.0;  // between the middles of linked ends: a car drives gaps of up to 1 m
constexpr double kApart_m = 1e-3;    // of the edges: less is no gap
constexpr double kAround_m = 6.0;    // from a lane's middle to a point of its gap

bool InTriangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                const Eigen::Vector2d& p) {
  const double ab = geometry::Cross(b - a, p - a), bc = geometry::Cross(c - b, p - b),
               ca = geometry::Cross(a - c, p - c);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

}  // namespace

JointGaps::JointGaps(const lanes::Graph& graph) : graph_(graph) {
  for (std::uint32_t track = 0; track < graph.tracks().size(); ++track) {
    const lanes::Curve& curve = graph[track].curve;
    const lanes::CurvePoint end = curve.At(curve.length_m());
    for (const lanes::Link& link : graph[track].next) {
      const lanes::Curve& next = graph[link.to].curve;
      const lanes::CurvePoint begin = next.At(0.0);
      if (link.joins || (end.p_W - begin.p_W).norm() > kFarthest_m) continue;
      const Eigen::Vector2d out_W = 0.5 * curve.nodes().back().width_m * end.left_W(),
                            in_W = 0.5 * next.nodes().front().width_m * begin.left_W();
      const Gap gap{track,
                    end.p_W.z(),
                    {end.p_W.head<2>() + out_W, end.p_W.head<2>() - out_W, begin.p_W.head<2>() + in_W,
                     begin.p_W.head<2>() - in_W}};
      if ((gap.corners_W[0] - gap.corners_W[2]).norm() < kApart_m &&
          (gap.corners_W[1] - gap.corners_W[3]).norm() < kApart_m)
        continue;
      gaps_.push_back(gap);
      gaps_.push_back(gap);
      gaps_.back().track = link.to;
    }
  }
  std::stable_sort(gaps_.begin(), gaps_.end(), [](const Gap& a, const Gap& b) { return a.track < b.track; });
}

bool JointGaps::Holds(const Eigen::Vector3d& p_W) const {
  if (gaps_.empty()) return false;
  const Eigen::Vector2d p = p_W.head<2>();
  for (const lanes::Graph::Beside& beside : graph_.TracksAt(p, kAround_m)) {
    auto gap = std::lower_bound(gaps_.begin(), gaps_.end(), beside.track,
                                [](const Gap& a, std::uint32_t track) { return a.track < track; });
    for (; gap != gaps_.end() && gap->track == beside.track; ++gap) {
      const auto& [a, b, c, d] = gap->corners_W;
      if (std::fabs(gap->z_m - p_W.z()) < network::Network::kLevel_m &&
          (InTriangle(a, b, c, p) || InTriangle(a, b, d, p) || InTriangle(a, c, d, p) || InTriangle(b, c, d, p)))
        return true;
    }
  }
  return false;
}

}  // namespace rodeira::traffic
