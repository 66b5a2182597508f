// SPDX-License-Identifier: Apache-2.0
#include "common/editor/selection.hpp"

#include <algorithm>

namespace rodeira::editor {
namespace {

constexpr int kPieces = 24;  // that a curve is looked at in

Eigen::Vector2d PointOf(const traffic_map::ControlPoint& point) {
  return {static_cast<double>(point.x_m), static_cast<double>(point.y_m)};
}

double DistanceToPiece(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * along).norm();
}

// Whether p lies within the cubic's control points' box, widened.
bool Near(const traffic_map::Cubic& cubic, const Eigen::Vector2d& p, double radius_m) {
  Eigen::Vector2d low = cubic.p_W[0], high = cubic.p_W[0];
  for (const auto& point : cubic.p_W) low = low.cwiseMin(point), high = high.cwiseMax(point);
  return (p.array() >= low.array() - radius_m).all() && (p.array() <= high.array() + radius_m).all();
}

double DistanceTo(const traffic_map::Cubic& cubic, const Eigen::Vector2d& p) {
  double nearest = 1e300;
  Eigen::Vector2d before = cubic.p_W[0];
  for (int i = 1; i <= kPieces; ++i) {
    const Eigen::Vector2d next = cubic.At(static_cast<double>(i) / kPieces);
    nearest = std::min(nearest, DistanceToPiece(p, before, next));
    before = next;
  }
  return nearest;
}

// By the parity of crossings with the ray to the east.
bool Within(const Borders& borders, const Eigen::Vector2d& p) {
  std::vector<Eigen::Vector2d> outline;
  for (int i = 0; i <= kPieces; ++i) outline.push_back(borders.left.At(static_cast<double>(i) / kPieces));
  for (int i = kPieces; i >= 0; --i) outline.push_back(borders.right.At(static_cast<double>(i) / kPieces));
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

}  // namespace

std::vector<Handle> HandlesOf(const Document& document, const Selection& selection) {
  std::set<Handle> all = selection.handles;
  const auto add = [&all](std::int32_t curve) {
    for (int i = 0; i < 4; ++i) all.insert({curve, i});
  };
  for (const std::int32_t curve : selection.curves) add(curve);
  for (const std::int32_t number : selection.lanes) {
    const auto lane = Find(document.map.lanes, number);
    if (lane) add(document.map.lanes[*lane].value.left.curve), add(document.map.lanes[*lane].value.right.curve);
  }
  std::vector<Handle> there;
  for (const Handle& handle : all) {
    if (Find(document.map.curves, handle.curve)) there.push_back(handle);
  }
  return there;
}

Selection Inside(const Document& document, const Eigen::Vector2d& corner_W, const Eigen::Vector2d& opposite_W) {
  const Eigen::Array2d low = corner_W.cwiseMin(opposite_W), high = corner_W.cwiseMax(opposite_W);
  Selection selection;
  for (const auto& line : document.map.curves) {
    int inside = 0;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Array2d p = PointOf(line.value.points[static_cast<std::size_t>(i)]);
      if (!(p >= low).all() || !(p <= high).all()) continue;
      selection.handles.insert({line.value.id, i});
      ++inside;
    }
    if (inside == 4) selection.curves.insert(line.value.id);
  }
  for (const auto& line : document.map.lanes) {
    if (selection.curves.contains(line.value.left.curve) && selection.curves.contains(line.value.right.curve))
      selection.lanes.insert(line.value.id);
  }
  for (const auto& line : document.map.connections) {
    if (selection.lanes.contains(line.value.from) && selection.lanes.contains(line.value.to))
      selection.connections.insert({line.value.from, line.value.to});
  }
  return selection;
}

Selection Chosen(const traffic_map::Finding& finding) {
  Selection selection;
  switch (finding.element) {
    case traffic_map::Element::kCurve:
    case traffic_map::Element::kHeights:
      selection.curves.insert(finding.number);
      break;
    case traffic_map::Element::kLane:
    case traffic_map::Element::kSign:
    case traffic_map::Element::kFlow:
      selection.lanes.insert(finding.number);
      break;
    case traffic_map::Element::kConnection:
      selection.connections.insert({finding.number, finding.to});
      break;
    case traffic_map::Element::kLights:
    case traffic_map::Element::kMap:
      break;
  }
  return selection;
}

std::optional<Eigen::Vector2d> MiddleOf(const Document& document, const Selection& selection) {
  Selection all = selection;
  for (const auto& [from, to] : selection.connections) all.lanes.insert(from), all.lanes.insert(to);
  const std::vector<Handle> handles = HandlesOf(document, all);
  if (handles.empty()) return std::nullopt;
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);
  for (const Handle& handle : handles) {
    const Eigen::Vector2d p = PointOf(document.map.curves[*Find(document.map.curves, handle.curve)]
                                          .value.points[static_cast<std::size_t>(handle.index)]);
    low = low.cwiseMin(p), high = high.cwiseMax(p);
  }
  return Eigen::Vector2d(0.5 * (low + high));
}

std::optional<Handle> HandleAt(const Document& document, const Eigen::Vector2d& p_W, double radius_m) {
  std::optional<Handle> found;
  double nearest = radius_m;
  for (const auto& line : document.map.curves) {
    for (int i = 0; i < 4; ++i) {
      const double distance = (PointOf(line.value.points[static_cast<std::size_t>(i)]) - p_W).norm();
      if (distance > nearest || (found && distance == nearest)) continue;
      nearest = distance;
      found = Handle{line.value.id, i};
    }
  }
  return found;
}

std::optional<std::int32_t> CurveAt(const Document& document, const Eigen::Vector2d& p_W, double radius_m) {
  std::optional<std::int32_t> found;
  double nearest = radius_m;
  for (const auto& line : document.map.curves) {
    const traffic_map::Cubic cubic = CubicOf(line.value);
    if (!Near(cubic, p_W, radius_m)) continue;
    const double distance = DistanceTo(cubic, p_W);
    if (distance > nearest || (found && distance == nearest)) continue;
    nearest = distance;
    found = line.value.id;
  }
  return found;
}

std::optional<std::int32_t> LaneAt(const Document& document, const Eigen::Vector2d& p_W) {
  const traffic_map::NumberIndex curves(document.map.curves);
  for (const auto& line : document.map.lanes) {
    const auto left = curves.Find(line.value.left.curve), right = curves.Find(line.value.right.curve);
    if (!left || !right) continue;
    traffic_map::Cubic box = CubicOf(document.map.curves[*left].value);
    const traffic_map::Cubic other = CubicOf(document.map.curves[*right].value);
    Eigen::Vector2d low = box.p_W[0], high = low;
    for (const auto& cubic : {box, other}) {
      for (const auto& point : cubic.p_W) low = low.cwiseMin(point), high = high.cwiseMax(point);
    }
    if ((p_W.array() < low.array()).any() || (p_W.array() > high.array()).any()) continue;
    if (Within(*BordersOf(document, line.value), p_W)) return line.value.id;
  }
  return std::nullopt;
}

std::vector<Handle> HandlesTogether(const Document& document, const Eigen::Vector2d& p_W) {
  std::vector<Handle> handles;
  for (const auto& line : document.map.curves) {
    for (int i = 0; i < 4; ++i) {
      if ((PointOf(line.value.points[static_cast<std::size_t>(i)]) - p_W).norm() <= kJoined_m)
        handles.push_back({line.value.id, i});
    }
  }
  return handles;
}

}  // namespace rodeira::editor
