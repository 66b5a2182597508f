// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/points.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/core/base/files.hpp"
#include "common/core/geometry/angle.hpp"
#include "common/core/geometry/plane.hpp"
#include "common/core/geometry/polyline.hpp"

namespace rodeira::design {
namespace {

using geometry::Cubic;
using geometry::PlanElement;
using Points = std::vector<Eigen::Vector3d>;

// The second derivatives of the natural cubic spline through values at ascending knots.
template <class Value>
std::vector<Value> SplineBends(const std::vector<double>& x, const std::vector<Value>& y) {
  const std::size_t n = x.size();
  std::vector<Value> bend(n, Value(y[0] - y[0]));
  std::vector<double> ratio(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {  // forward elimination of the tridiagonal system
    const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
    const double pivot = 2.0 * (h0 + h1) - h0 * ratio[i - 1];
    ratio[i] = h1 / pivot;
    const Value right = 6.0 * ((y[i + 1] - y[i]) / h1 - (y[i] - y[i - 1]) / h0);
    bend[i] = (right - h0 * bend[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) bend[i] -= ratio[i] * bend[i + 1];
  return bend;
}

std::vector<double> Chords(const Points& points) {
  std::vector<double> x{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) x.push_back(x.back() + (points[i] - points[i - 1]).head<2>().norm());
  return x;
}

// A cubic spline through the points: curvature goes on without jumps.
void Smooth(const Points& points, AxisReading& axis) {
  const std::vector<double> x = Chords(points);
  std::vector<Eigen::Vector2d> plan;
  for (const Eigen::Vector3d& p : points) plan.emplace_back(p.head<2>());
  const auto bend = SplineBends(x, plan);
  double s = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double h = x[i + 1] - x[i];
    const Eigen::Vector2d first =
        (plan[i + 1] - plan[i]) - h * h / 6.0 * (2.0 * bend[i] + bend[i + 1]);  // by p in [0, 1]
    const Eigen::Vector2d second = 0.5 * h * h * bend[i], third = h * h / 6.0 * (bend[i + 1] - bend[i]);
    PlanElement element;
    element.kind = PlanElement::Kind::kCubic;
    element.s_m = s;
    element.start_W = plan[i];
    element.heading_rad = std::atan2(first.y(), first.x());
    const Eigen::Vector2d ahead = first.normalized();
    element.u = {0.0, first.norm(), ahead.dot(second), ahead.dot(third)};
    element.v = {0.0, 0.0, geometry::Cross(ahead, second), geometry::Cross(ahead, third)};
    element.length_m = geometry::CubicLength(element, 1.0);
    s += element.length_m;
    axis.elements.push_back(element);
  }
}

// Straight pieces with corners rounded by arcs that pass the point within the distance given.
void AsTheyAre(const Points& points, double within_m, AxisReading& axis) {
  const auto plan = [&](std::size_t i) { return Eigen::Vector2d(points[i].head<2>()); };
  double s = 0.0, cut = 0.0;  // how much of the piece the corner before took
  const auto add = [&](const Eigen::Vector2d& from, double heading, double length, double curvature) {
    PlanElement element;
    element.s_m = s, element.length_m = length, element.start_W = from, element.heading_rad = heading;
    element.curvature_start_1pm = element.curvature_end_1pm = curvature;
    s += length;
    axis.elements.push_back(element);
  };
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector2d piece = plan(i + 1) - plan(i), ahead = piece.normalized();
    const double heading = std::atan2(ahead.y(), ahead.x());
    double next_cut = 0.0, turn = 0.0;
    if (i + 2 < points.size()) {
      const Eigen::Vector2d next = plan(i + 2) - plan(i + 1);
      turn = std::atan2(geometry::Cross(ahead, next), ahead.dot(next));
      if (std::fabs(turn) > 1e-9) {
        next_cut = std::min({within_m / std::tan(0.25 * std::fabs(turn)), 0.49 * piece.norm(), 0.49 * next.norm()});
      }
    }
    add(plan(i) + cut * ahead, heading, piece.norm() - cut - next_cut, 0.0);
    cut = next_cut;
    if (next_cut == 0.0) continue;
    const double radius = next_cut / std::tan(0.5 * std::fabs(turn));
    add(plan(i + 1) - next_cut * ahead, heading, radius * std::fabs(turn), std::copysign(1.0 / radius, turn));
  }
}

// Heights over s: the spline through those of the points, each at the station nearest to it.
geometry::CubicTable Heights(const Points& points, const std::vector<double>& s, bool smooth) {
  std::vector<double> z;
  for (const Eigen::Vector3d& p : points) z.push_back(p.z());
  const std::vector<double> bend = smooth ? SplineBends(s, z) : std::vector<double>(s.size(), 0.0);
  std::vector<Cubic> records;
  for (std::size_t i = 0; i + 1 < s.size(); ++i) {
    const double h = s[i + 1] - s[i];
    records.push_back({s[i], z[i], (z[i + 1] - z[i]) / h - h / 6.0 * (2.0 * bend[i] + bend[i + 1]), 0.5 * bend[i],
                       (bend[i + 1] - bend[i]) / (6.0 * h)});
  }
  return geometry::CubicTable(std::move(records));
}

Points ReadList(const config::Map& map, bool& has_z) {
  Points points;
  const config::List list = map.Items("list");
  has_z = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::vector<double> numbers = list.Numbers(i);
    if (numbers.size() != 2 && numbers.size() != 3) {
      list.Problem(i, "config.wrong_length",
                   fmt::format("a point has {} numbers; [x, y] or [x, y, z] in m was expected", numbers.size()));
      continue;
    }
    has_z = has_z && numbers.size() == 3;
    points.emplace_back(numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 0.0);
    if (!(points.back().cwiseAbs().maxCoeff() < 1e8))
      list.Problem(i, "config.out_of_range", "a coordinate is beyond 1e8 m");
    if (points.size() > 1 && !((points.back() - points[points.size() - 2]).head<2>().norm() > 1e-3)) {
      list.Problem(i, "the point stands over the one before");
    }
  }
  return points;
}

}  // namespace

void ReadPoints(const config::DeclaredMap& keys, const terrain::GroundMove& move, AxisReading& axis) {
  const config::Map& map = keys.map();
  Points points;
  bool has_z = false;
  if (map.Has("file") == map.Has("list"))
    map.Problem(map.Has("file") ? "file" : "", "config.conflicting_keys", "'points' needs either a 'file' or a 'list'");
  if (map.Has("file")) {
    const auto path = keys.MapWith("file").Path("file");
    const auto text = base::ReadText(path);
    if (!text) return map.Problem("file", text.error().id, text.error().Text());
    const auto line = geometry::ReadPolyline(text.value(), path.string());
    if (!line) return map.Problem("file", line.error().id, line.error().Text());
    points = line.value().points_W;
    has_z = line.value().has_z;
    for (const Eigen::Vector3d& p : points) {
      if (!(p.cwiseAbs().maxCoeff() < 1e8))
        return map.Problem("file", "config.out_of_range", "a coordinate is beyond 1e8 m");
    }
  } else if (map.Has("list")) {
    points = ReadList(keys.MapWith("list"), has_z);
  }
  if (move) {
    for (Eigen::Vector3d& p : points) {
      Eigen::Vector2d at = p.head<2>();
      double heading_rad = 0.0;
      move(at, heading_rad);
      p.head<2>() = at;
    }
  }
  const bool smooth = keys.Flag("smooth");
  const double within = keys.Number("within_m");
  if (points.size() < 2) {
    return map.Problem(
        "", "config.too_few",
        fmt::format("'{}' has {} points; two or more were expected", map.Has("file") ? "file" : "list", points.size()));
  }
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Eigen::Vector2d before = (points[i - 1] - points[i - 2]).head<2>(),
                          after = (points[i] - points[i - 1]).head<2>();
    if (before.normalized().dot(after.normalized()) < -0.9) {
      return map.Problem(
          "", "world.road_does_not_fit",
          fmt::format("the line turns back at point {} ({:.3f}, {:.3f})", i, points[i - 1].x(), points[i - 1].y()));
    }
  }
  if (smooth)
    Smooth(points, axis);
  else
    AsTheyAre(points, within, axis);
  if (!has_z) return;
  std::vector<double> stations;
  if (smooth) {
    for (const PlanElement& element : axis.elements) stations.push_back(element.s_m);
  } else {
    stations.push_back(0.0);
    for (std::size_t i = 0; i + 1 < axis.elements.size(); ++i) {
      const PlanElement& element = axis.elements[i];
      if (element.curvature_start_1pm != 0.0)
        stations.push_back(element.s_m + 0.5 * element.length_m);
      else if (axis.elements[i + 1].curvature_start_1pm == 0.0)
        stations.push_back(element.s_m + element.length_m);
    }
  }
  stations.push_back(axis.elements.back().s_m + axis.elements.back().length_m);
  axis.elevation = Heights(points, stations, smooth);
}

}  // namespace rodeira::design
