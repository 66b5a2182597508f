// SPDX-License-Identifier: Apache-2.0
#include "common/editor/snap.hpp"

namespace rodeira::editor {
namespace {

Snapped SnapEnd(const Document& document, const std::set<std::int32_t>& dragged, const Eigen::Vector2d& p_W,
                double radius_m) {
  Snapped snapped{p_W};
  double nearest = radius_m;
  for (const auto& line : document.map.curves) {
    if (dragged.contains(line.value.id)) continue;
    const traffic_map::Cubic cubic = CubicOf(line.value);
    for (const std::size_t end : {0u, 3u}) {
      const double distance = (cubic.p_W[end] - p_W).norm();
      if (distance > nearest) continue;
      nearest = distance;
      snapped = {cubic.p_W[end], true};
    }
  }
  return snapped;
}

Snapped SnapTangent(const Document& document, const Handle& handle, const std::set<std::int32_t>& dragged,
                    const Eigen::Vector2d& p_W, double radius_m) {
  Snapped snapped{p_W};
  const auto own = Find(document.map.curves, handle.curve);
  if (!own) return snapped;
  const Eigen::Vector2d end = CubicOf(document.map.curves[*own].value).p_W[handle.index == 1 ? 0 : 3];
  double nearest = radius_m;
  for (const auto& line : document.map.curves) {
    if (dragged.contains(line.value.id) || line.value.id == handle.curve) continue;
    const traffic_map::Cubic cubic = CubicOf(line.value);
    for (const bool begins : {true, false}) {
      if ((cubic.p_W[begins ? 0 : 3] - end).norm() > kJoined_m) continue;
      const Eigen::Vector2d along = cubic.Tangent(begins ? 0.0 : 1.0);
      const Eigen::Vector2d foot = end + (p_W - end).dot(along) * along;
      const double distance = (foot - p_W).norm();
      if (distance > nearest) continue;
      nearest = distance;
      snapped = {foot, true};
    }
  }
  return snapped;
}

}  // namespace

Snapped Snap(const Document& document, const Handle& handle, const std::set<std::int32_t>& dragged,
             const Eigen::Vector2d& p_W, double radius_m) {
  const bool is_end = handle.index == 0 || handle.index == 3;
  return is_end ? SnapEnd(document, dragged, p_W, radius_m) : SnapTangent(document, handle, dragged, p_W, radius_m);
}

}  // namespace rodeira::editor
