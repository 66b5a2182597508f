// SPDX-License-Identifier: Apache-2.0
#include "common/world/design/props_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "common/core/geometry/angle.hpp"
#include "common/world/design/object_reader.hpp"

namespace rodeira::design {
namespace {

using config::DeclaredList;
using config::DeclaredMap;
using config::Map;
using Eigen::Vector2d;

constexpr double kFarthest_m = 1e8;
constexpr double kLongest_m = 1e5;  // of what goes on

double Radians(double deg) { return deg * geometry::kPi / 180.0; }

// The corners of a line; fewer than two, and a problem, where it is none.
std::vector<Vector2d> ReadAlong(const Map& item) {
  std::vector<Vector2d> points;
  const config::List list = item.Items("along");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::vector<double> p = list.Numbers(i);
    if (p.size() != 2 || !(std::fabs(p[0]) <= kFarthest_m) || !(std::fabs(p[1]) <= kFarthest_m)) {
      list.Problem(i, "config.out_of_range", "a point of 'along' is [x, y], in metres, each at most 1e8");
      return {};
    }
    const Vector2d point(p[0], p[1]);
    if (!points.empty() && !((point - points.back()).norm() > 1e-6)) {
      list.Problem(i, "this point of 'along' is the one before");
      return {};
    }
    points.push_back(point);
  }
  if (points.size() < 2)
    item.Problem("along", "config.too_few",
                 fmt::format("'along' has {} points; two or more were expected", points.size()));
  return points;
}

double PolylineLength(const std::vector<Vector2d>& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

// From the line's beginning on one every so often, turned against it.
void StandInARow(const DeclaredMap& item, const std::vector<Vector2d>& line, std::size_t object,
                 network::Props& props) {
  const double every = item.RequiredNumber("every_m"), turn = Radians(item.Number("rotation_deg"));
  const double last = std::floor(PolylineLength(line) / every + 1e-9);
  if (last >= kMaxInRow)
    return item.map().Problem("every_m", "config.out_of_range", "more than 100 000 in a row; fewer were expected");
  std::size_t piece = 1;
  double before = 0.0;  // the piece's first point, along the line
  for (double i = 0.0; i <= last; i += 1.0) {
    Vector2d way = line[piece] - line[piece - 1];
    while (i * every > before + way.norm() && piece + 1 < line.size()) {
      before += way.norm();
      ++piece;
      way = line[piece] - line[piece - 1];
    }
    props.placements.push_back(
        {object, line[piece - 1] + (i * every - before) * way.normalized(), std::atan2(way.y(), way.x()) + turn});
  }
}

void ReadThing(const DeclaredMap& keys, const TerrainIsAt& terrain_is_at, const terrain::GroundMove& move,
               network::Props& props) {
  const Map& item = keys.map();
  auto [object, continuous] = ReadObjectItself(keys, fmt::format("object{}", props.objects.size()));
  const std::size_t index = props.objects.size(), first = props.placements.size();
  props.objects.push_back(std::move(object));
  if (continuous || item.Has("along")) {
    for (const char* key : {"x_m", "y_m", "heading_deg"}) {
      if (item.Has(key))
        item.Problem(key, "config.conflicting_keys",
                     fmt::format("what stands 'along' a line has no '{}' of its own", key));
    }
    std::vector<Vector2d> line = ReadAlong(keys.MapWith("along"));
    if (line.size() < 2) return;
    for (Vector2d& p : line) {
      double heading_rad = 0.0;
      if (move) move(p, heading_rad);
    }
    for (const Vector2d& p : line) {
      if (terrain_is_at && !terrain_is_at(p.x(), p.y()))
        return item.Problem("along", "world.outside_of_terrain",
                            fmt::format("there is no terrain at ({:g}, {:g})", p.x(), p.y()));
    }
    if (!continuous)
      StandInARow(keys, line, index, props);
    else if (item.Has("every_m"))
      item.Problem("every_m", "config.conflicting_keys", "what goes on has no 'every_m'");
    else if (PolylineLength(line) > kLongest_m)
      item.Problem(
          "along", "config.out_of_range",
          fmt::format("'along' is {:.0f} m long; at most {:.0f} m was expected", PolylineLength(line), kLongest_m));
    else
      props.runs.push_back({index, std::move(line)});
  } else {
    props.placements.push_back(
        {index, {keys.RequiredNumber("x_m"), keys.RequiredNumber("y_m")}, Radians(keys.Number("heading_deg"))});
    if (move) move(props.placements.back().at_W, props.placements.back().heading_rad);
    if (item.Has("every_m"))
      item.Problem("every_m", "what is repeated stands 'along' a line: 'along: [[x, y], [x, y]]'");
  }
  for (std::size_t i = first; i < props.placements.size(); ++i) {
    const Vector2d& p = props.placements[i].at_W;
    if (terrain_is_at && !terrain_is_at(p.x(), p.y()))
      return item.Problem(item.Has("along") ? "along" : "x_m", "world.outside_of_terrain",
                          fmt::format("there is no terrain at ({:g}, {:g})", p.x(), p.y()));
  }
}

}  // namespace

void ReadProps(const DeclaredMap& file, const TerrainIsAt& terrain_is_at, const terrain::GroundMove& move,
               network::Props& props) {
  const DeclaredList objects = file.Items("objects");
  for (std::size_t i = 0; i < objects.size(); ++i) ReadThing(objects.At(i), terrain_is_at, move, props);
}

}  // namespace rodeira::design
