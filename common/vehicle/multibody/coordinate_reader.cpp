// SPDX-License-Identifier: Apache-2.0
// Angles, distances and constraints of a mechanism file.
#include <fmt/format.h>

#include <cmath>

#include "common/core/base/suggest.hpp"
#include "common/vehicle/multibody/drawing_reader.hpp"

namespace rodeira::multibody {
namespace {

using config::DeclaredMap;
using config::Map;

constexpr double kShort = 1e-9;

}  // namespace

void DrawingReader::ReadAngles(const DeclaredMap& root) {
  const Map angles = root.map().OptionalChild("angles");
  for (const auto& [name, declared] : root.Named("angles")) {
    const Map& map = declared.map();
    const std::optional<double> rate_radps = declared.OptionalNumber("rate_radps");
    if (map.Has("rotor_kgm2")) {  // an angle of its own: a wheel of a gear train, a steering column
      const double inertia = declared.RequiredNumber("rotor_kgm2");
      const double start = declared.Number("at_rad");
      if (!IsNew(angles, name)) continue;
      const int rotor = AddEntity(angles, name, EntityKind::kAngle, {start, 0.0, 0.0});
      drawing_.entities.back().inertia = inertia;
      if (rate_radps) drawing_.velocities.push_back({rotor, 0, *rate_radps, map.Place("rate_radps")});
      continue;
    }
    const auto of = Direction(declared, "of");
    std::optional<Form> from = Single(world_x_);
    std::optional<Form> to = Single(world_y_);
    if (map.Has("from") || map.Has("to") || !planar_) {
      from = Direction(declared, "from");
      to = Direction(declared, "to");
    }
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
    if (rate_radps) drawing_.velocities.push_back({row.coordinate, 0, *rate_radps, map.Place("rate_radps")});
  }
}

void DrawingReader::ReadDistances(const DeclaredMap& root) {
  const Map distances = root.map().OptionalChild("distances");
  for (const auto& [name, declared] : root.Named("distances")) {
    const Map& map = declared.map();
    const auto points = TwoPoints(declared, "points");
    std::optional<Form> along;
    if (map.Has("along")) along = Direction(declared, "along");
    const std::optional<double> rate_mps = declared.OptionalNumber("rate_mps");
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
    if (rate_mps) drawing_.velocities.push_back({row.coordinate, 0, *rate_mps, map.Place("rate_mps")});
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

Law DrawingReader::ReadLaw(const DeclaredMap& map, std::string_view value_key, std::optional<double> drawn) {
  Law law;
  law.c1 = map.Number("rate_per_s");
  law.c2 = map.Number("square_per_s2");
  const DeclaredMap sine = map.Child("sine");
  if (map.map().Has("sine")) {
    law.amplitude = sine.Number("amplitude");
    law.frequency_Hz = sine.Number("frequency_Hz");
    law.phase_rad = sine.Number("phase_rad");
  }
  law.c0 = drawn ? map.Number(value_key, *drawn - law.amplitude * std::sin(law.phase_rad)) : map.Number(value_key);
  return law;
}

void DrawingReader::ReadConstraints(const DeclaredMap& root) {
  for (const auto& [name, constraint] : root.Named("constraints")) ReadConstraint(constraint, name);
}

void DrawingReader::ReadConstraint(const DeclaredMap& found, const std::string& name) {
  const std::string kind = found.Word("kind");
  const DeclaredMap declared = found.OfKind(kind);
  const Map& map = declared.map();
  RowDrawing row;
  row.name = name;
  row.place = map.Place();
  if (kind == "distance") {
    const auto points = TwoPoints(declared, "points");
    if (!points) return;
    row.v = row.w = Sum((*points)[1], (*points)[0], -1.0);
    const double length = declared.Number("length_m", Drawn(row.v).norm());
    if (!(length >= kShort))
      return map.Problem("points", "mechanism.no_length",
                         "the points coincide; a distance over 0 was expected ('kind: same' joins points)");
    row.value = length * length;
    row.scale = 0.5 / length;
    row.keeps_length = true;
    return drawing_.rows.push_back(row);
  }
  if (kind == "perpendicular" || kind == "dot") {
    const auto a = Direction(declared, "a");
    const auto b = Direction(declared, "b");
    if (!a || !b) return;
    const double sizes = Drawn(*a).norm() * Drawn(*b).norm();
    if (!(sizes > kShort * kShort)) return map.Problem("a", "mechanism.no_length", "a direction has no length");
    row.v = *a;
    row.w = *b;
    row.value = kind == "perpendicular" ? 0.0 : declared.Number("value_m2", Drawn(*a).dot(Drawn(*b)));
    row.scale = 1.0 / std::sqrt(sizes);
    return drawing_.rows.push_back(row);
  }
  if (kind == "coplanar") {
    const auto a = Direction(declared, "a");
    const auto b = Direction(declared, "b");
    const auto c = Direction(declared, "c");
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
    const auto points = TwoPoints(declared, "points");
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
    const auto coordinate = CoordinateNamed(map, "coordinate", declared.Text("coordinate"));
    const Coordinate known = coordinate.value_or(Coordinate{});
    row.law = ReadLaw(declared, "value", at_[static_cast<std::size_t>(3 * known.entity + known.component)]);
    if (!coordinate) return;
    row.sum = {{coordinate->entity, Vector3d::Unit(coordinate->component)}};
    return drawing_.rows.push_back(row);
  }
  const auto factors = declared.NamedNumbers("terms");
  const Map terms = map.OptionalChild("terms");
  double drawn = 0.0;
  double largest = 0.0;
  for (const auto& [coordinate_name, factor] : factors) {
    const auto coordinate = CoordinateNamed(terms, coordinate_name, coordinate_name);
    if (!coordinate) return;
    row.sum.emplace_back(coordinate->entity, factor * Vector3d::Unit(coordinate->component));
    drawn += factor * at_[static_cast<std::size_t>(3 * coordinate->entity + coordinate->component)];
    largest = std::max(largest, std::fabs(factor));
  }
  row.value = declared.Number("value", drawn);
  if (!(largest > 0.0)) return map.Problem("terms", "all terms are zero; a relation between coordinates was expected");
  for (auto& term : row.sum) term.second /= largest;
  row.value /= largest;
  drawing_.rows.push_back(row);
}

}  // namespace rodeira::multibody
