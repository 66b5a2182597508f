// SPDX-License-Identifier: Apache-2.0
// Angles, distances and constraints of a mechanism file.
#include <fmt/format.h>

#include <cmath>

#include "common/core/base/suggest.hpp"
#include "common/vehicle/multibody/drawing_reader.hpp"

namespace rodeira::multibody {
namespace {

using config::Map;

constexpr double kShort = 1e-9;

}  // namespace

void DrawingReader::ReadAngles(const Map& root) {
  const Map angles = root.OptionalChild("angles");
  for (const std::string& name : angles.Keys()) {
    const Map map = angles.Child(name);
    if (map.Has("rotor_kgm2")) {  // an angle of its own: a wheel of a gear train, a steering column
      const double inertia = map.Number("rotor_kgm2", {1e-12, 1e9});
      const double start = map.Number("at_rad", {-1e6, 1e6}, 0.0);
      const double speed = map.Number("rate_radps", {-1e6, 1e6}, 0.0);
      if (!IsNew(angles, name)) continue;
      const int rotor = AddEntity(angles, name, EntityKind::kAngle, {start, 0.0, 0.0});
      drawing_.entities.back().inertia = inertia;
      if (map.Has("rate_radps")) drawing_.velocities.push_back({rotor, 0, speed, map.Place("rate_radps")});
      continue;
    }
    const auto of = Direction(map, "of");
    std::optional<Form> from = Single(world_x_);
    std::optional<Form> to = Single(world_y_);
    if (map.Has("from") || map.Has("to") || !planar_) {
      from = Direction(map, "from");
      to = Direction(map, "to");
    }
    const double rate = map.Number("rate_radps", {-1e6, 1e6}, 0.0);
    if (!of || !from || !to || !IsNew(angles, name)) continue;
    RowDrawing row;
    row.name = name + " (angle)";
    row.place = angles.Place(name);
    row.kind = RowKind::kAngle;
    row.u = *of;
    row.v = *from;
    row.w = *to;
    const Vector3d u = Drawn(*of), v = Drawn(*from), w = Drawn(*to);
    if (std::hypot(u.dot(v), u.dot(w)) < kShort) {
      map.Problem("of", "mechanism.no_length",
                  "the direction has no part in the plane of 'from' and 'to': its angle is not defined");
      continue;
    }
    row.scale = 1.0 / std::hypot(u.dot(v), u.dot(w));
    row.coordinate = AddEntity(angles, name, EntityKind::kAngle, {std::atan2(u.dot(w), u.dot(v)), 0.0, 0.0});
    drawing_.rows.push_back(row);
    if (map.Has("rate_radps")) drawing_.velocities.push_back({row.coordinate, 0, rate, map.Place("rate_radps")});
  }
}

void DrawingReader::ReadDistances(const Map& root) {
  const Map distances = root.OptionalChild("distances");
  for (const std::string& name : distances.Keys()) {
    const Map map = distances.Child(name);
    const auto points = TwoPoints(map, "points");
    std::optional<Form> along;
    if (map.Has("along")) along = Direction(map, "along");
    const double rate = map.Number("rate_mps", {-1e6, 1e6}, 0.0);
    if (!points || (map.Has("along") && !along) || !IsNew(distances, name)) continue;
    RowDrawing row;
    row.name = name + " (distance)";
    row.place = distances.Place(name);
    row.v = Sum((*points)[1], (*points)[0], -1.0);
    const Vector3d way = Drawn(row.v);
    double at = way.norm();
    if (along) {
      row.kind = RowKind::kSlide;
      row.w = *along;
      const double size = Drawn(*along).norm();
      if (size < kShort) {
        map.Problem("along", "mechanism.no_length", "the direction has no length");
        continue;
      }
      row.scale = 1.0 / size;
      at = way.dot(Drawn(*along)) / size;
    } else {
      row.kind = RowKind::kSquare;
      if (at < kShort) {
        map.Problem("points", "mechanism.no_length",
                    "the points coincide: their distance has no derivative there; 'along' a direction it has");
        continue;
      }
      row.scale = 0.5 / at;
    }
    row.coordinate = AddEntity(distances, name, EntityKind::kDistance, {at, 0.0, 0.0});
    drawing_.rows.push_back(row);
    if (map.Has("rate_mps")) drawing_.velocities.push_back({row.coordinate, 0, rate, map.Place("rate_mps")});
  }
}

// "beta" or "P.x".
std::optional<DrawingReader::Coordinate> DrawingReader::CoordinateNamed(const Map& map, std::string_view key,
                                                                        const std::string& name) const {
  const auto dot = name.rfind('.');
  if (dot != std::string::npos && dot + 2 == name.size() &&
      std::string("xyz").find(name[dot + 1]) != std::string::npos) {
    const auto entity = Entity(map, key, name.substr(0, dot), false);
    if (!entity) return std::nullopt;
    return Coordinate{*entity, static_cast<int>(std::string("xyz").find(name[dot + 1]))};
  }
  const auto entity = Entity(map, key, name, true);
  if (!entity) return std::nullopt;
  return Coordinate{*entity, 0};
}

Law DrawingReader::ReadLaw(const Map& map, std::string_view value_key) const {
  Law law;
  law.c0 = map.Number(value_key, {-1e12, 1e12}, 0.0);
  law.c1 = map.Number("rate_per_s", {-1e12, 1e12}, 0.0);
  law.c2 = map.Number("square_per_s2", {-1e12, 1e12}, 0.0);
  const Map sine = map.OptionalChild("sine");
  if (map.Has("sine")) {
    law.amplitude = sine.Number("amplitude", {-1e12, 1e12});
    law.frequency_Hz = sine.Number("frequency_Hz", {0.0, 1e5});
    law.phase_rad = sine.Number("phase_rad", {-100.0, 100.0}, 0.0);
  }
  return law;
}

void DrawingReader::ReadConstraints(const Map& root) {
  const Map constraints = root.OptionalChild("constraints");
  for (const std::string& name : constraints.Keys()) ReadConstraint(constraints, name);
}

void DrawingReader::ReadConstraint(const Map& constraints, const std::string& name) {
  const Map map = constraints.Child(name);
  const std::string kind =
      map.Choice("kind", {"distance", "perpendicular", "dot", "coplanar", "same", "drive", "linear"});
  RowDrawing row;
  row.name = name;
  row.place = constraints.Place(name);
  if (kind == "distance") {
    const auto points = TwoPoints(map, "points");
    if (!points) return;
    row.v = row.w = Sum((*points)[1], (*points)[0], -1.0);
    const double length = map.Has("length_m") ? map.Number("length_m", {kShort, 1e6}) : Drawn(row.v).norm();
    if (!(length >= kShort))
      return map.Problem("points", "mechanism.no_length",
                         "the points coincide; a distance over 0 was expected ('kind: same' joins points)");
    row.value = length * length;
    row.scale = 0.5 / length;
    row.keeps_length = true;
    return drawing_.rows.push_back(row);
  }
  if (kind == "perpendicular" || kind == "dot") {
    const auto a = Direction(map, "a");
    const auto b = Direction(map, "b");
    if (!a || !b) return;
    const double sizes = Drawn(*a).norm() * Drawn(*b).norm();
    if (!(sizes > kShort * kShort)) return map.Problem("a", "mechanism.no_length", "a direction has no length");
    row.v = *a;
    row.w = *b;
    row.value = kind == "perpendicular"
                    ? 0.0
                    : (map.Has("value_m2") ? map.Number("value_m2", {-1e12, 1e12}) : Drawn(*a).dot(Drawn(*b)));
    row.scale = 1.0 / std::sqrt(sizes);
    return drawing_.rows.push_back(row);
  }
  if (kind == "coplanar") {
    const auto a = Direction(map, "a");
    const auto b = Direction(map, "b");
    const auto c = Direction(map, "c");
    if (!a || !b || !c) return;
    const double sizes = Drawn(*a).norm() * Drawn(*b).norm() * Drawn(*c).norm();
    if (!(sizes > kShort * kShort * kShort))
      return map.Problem("a", "mechanism.no_length", "a direction has no length");
    row.kind = RowKind::kTriple;
    row.u = *a;
    row.v = *b;
    row.w = *c;
    row.scale = 1.0 / std::cbrt(sizes * sizes);
    return drawing_.rows.push_back(row);
  }
  row.kind = RowKind::kSum;
  if (kind == "same") {
    const auto points = TwoPoints(map, "points");
    if (!points) return;
    for (int c = 0; c < (planar_ ? 2 : 3); ++c) {
      row.name = fmt::format("{} ({})", name, "xyz"[c]);
      row.sum.clear();
      const Form way = Sum((*points)[1], (*points)[0], -1.0);
      row.sum_parts = way.parts;
      row.sum_axis = Vector3d::Unit(c);
      for (const Term& term : way.terms) row.sum.emplace_back(term.entity, Transposed(term, Vector3d::Unit(c)));
      drawing_.rows.push_back(row);
    }
    return;
  }
  if (kind == "drive") {
    const auto coordinate = CoordinateNamed(map, "coordinate", map.Text("coordinate"));
    row.law = ReadLaw(map, "value");
    if (!coordinate) return;
    if (!map.Has("value"))
      row.law.c0 = at_[static_cast<std::size_t>(3 * coordinate->entity + coordinate->component)] -
                   row.law.amplitude * std::sin(row.law.phase_rad);
    row.sum = {{coordinate->entity, Vector3d::Unit(coordinate->component)}};
    return drawing_.rows.push_back(row);
  }
  const Map terms = map.Child("terms");
  double drawn = 0.0;
  double largest = 0.0;
  for (const std::string& coordinate_name : terms.Keys()) {
    const double factor = terms.Number(coordinate_name, {-1e6, 1e6});
    const auto coordinate = CoordinateNamed(terms, coordinate_name, coordinate_name);
    if (!coordinate) return;
    row.sum.emplace_back(coordinate->entity, factor * Vector3d::Unit(coordinate->component));
    drawn += factor * at_[static_cast<std::size_t>(3 * coordinate->entity + coordinate->component)];
    largest = std::max(largest, std::fabs(factor));
  }
  if (!(largest > 0.0)) return map.Problem("terms", "all terms are zero; a relation between coordinates was expected");
  row.value = map.Has("value") ? map.Number("value", {-1e9, 1e9}) : drawn;
  for (auto& term : row.sum) term.second /= largest;
  row.value /= largest;
  drawing_.rows.push_back(row);
}

}  // namespace rodeira::multibody
