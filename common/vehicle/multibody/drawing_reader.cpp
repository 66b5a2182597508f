// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/drawing_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/suggest.hpp"

namespace rodeira::multibody {
namespace {

using config::List;
using config::Map;
using config::Range;

constexpr double kMaxLength_m = 1e6;
constexpr double kMaxSpeed_mps = 1e6;
constexpr std::size_t kMaxEntities = 3000;  // the initial position is solved with dense matrices

}  // namespace

DrawingReader::DrawingReader(const Map& root) {
  drawing_.name = root.Text("name", "");
  drawing_.place = root.Place();
  planar_ = root.Flag("planar", false);
  drawing_.redundant = root.Flag("redundant", false);
  if (root.Has("gravity_mps2")) drawing_.gravity_mps2 = ThreeNumbers(root, "gravity_mps2", 1e4);
  for (const auto& [name, direction] :
       {std::pair("world x", Vector3d::UnitX()), std::pair("world y", Vector3d::UnitY()),
        std::pair("world z", Vector3d::UnitZ())}) {
    const int entity = AddEntity(root, name, EntityKind::kVector, direction);
    drawing_.entities[static_cast<std::size_t>(entity)].fixed = {true, true, true};
    if (name == std::string("world x")) world_x_ = entity;
    if (name == std::string("world y")) world_y_ = entity;
  }
  ReadPoints(root);
  ReadVectors(root);
  ReadBodies(root);
  ReadMarkers(root);
  ReadAngles(root);
  ReadDistances(root);
  ReadConstraints(root);
  ReadForces(root);
  if (drawing_.entities.size() > kMaxEntities) {
    root.Problem("points", "config.wrong_length",
                 fmt::format("the mechanism has {} points, vectors and coordinates; at most {} were expected",
                             drawing_.entities.size(), kMaxEntities));
  }
}

Vector3d DrawingReader::ThreeNumbers(const Map& map, std::string_view key, double most) {
  const std::vector<double> numbers = map.Numbers(key, {-most, most});
  if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  if (map.Has(key))
    map.Problem(key, "config.wrong_length",
                fmt::format("'{}' holds {} numbers; three were expected", key, numbers.size()));
  return Vector3d::Zero();
}

bool DrawingReader::IsNew(const Map& map, const std::string& name) {
  if (!entities_.contains(name) && !markers_.contains(name)) return true;
  map.Problem(name, "config.duplicate_name", fmt::format("the name '{}' stands for something else already", name));
  return false;
}

int DrawingReader::AddEntity(const Map& map, const std::string& name, EntityKind kind, const Vector3d& at) {
  EntityDrawing entity;
  entity.name = name;
  entity.place = map.Place(name);
  entity.kind = kind;
  entity.at = at;
  const int index = static_cast<int>(drawing_.entities.size());
  drawing_.entities.push_back(entity);
  names_.push_back(name);
  entities_.emplace(name, index);
  for (int c = 0; c < 3; ++c) at_.push_back(at[c]);
  return index;
}

void DrawingReader::ReadPoints(const Map& root) {
  const Map points = root.Child("points");
  for (const std::string& name : points.Keys()) {
    const Map map = points.Child(name);
    const Vector3d at = ThreeNumbers(map, "at_m", kMaxLength_m);
    const std::string fixed = map.Choice("fixed", {"false", "true", "x", "y", "z", "xy", "xz", "yz"}, "false");
    if (!IsNew(points, name)) continue;
    const int index = AddEntity(points, name, EntityKind::kPoint, at);
    EntityDrawing& entity = drawing_.entities.back();
    for (std::size_t c = 0; c < 3; ++c)
      entity.fixed[c] = fixed == "true" || (fixed != "false" && fixed.find("xyz"[c]) != std::string::npos);
    if (planar_) entity.fixed[2] = true;
    if (!map.Has("velocity_mps")) continue;
    const Vector3d velocity = ThreeNumbers(map, "velocity_mps", kMaxSpeed_mps);
    for (int c = 0; c < 3; ++c) drawing_.velocities.push_back({index, c, velocity[c], map.Place("velocity_mps")});
  }
}

void DrawingReader::ReadVectors(const Map& root) {
  const Map vectors = root.OptionalChild("vectors");
  for (const std::string& name : vectors.Keys()) {
    const Map map = vectors.Child(name);
    const Vector3d direction = ThreeNumbers(map, "direction", 1e6);
    const bool fixed = map.Flag("fixed", false);
    const double size = direction.norm();
    if (map.Has("direction") && !(size > 1e-9)) {
      map.Problem("direction", "mechanism.no_length", "'direction' has no length; a direction was expected");
      continue;
    }
    if (!IsNew(vectors, name) || !(size > 0.0)) continue;
    AddEntity(vectors, name, EntityKind::kVector, direction / size);
    drawing_.entities.back().fixed = {fixed, fixed, fixed || planar_};
  }
}

void DrawingReader::ReadBodies(const Map& root) {
  const Map bodies = root.OptionalChild("bodies");
  for (const std::string& name : bodies.Keys()) ReadBody(bodies, name);
}

void DrawingReader::ReadBody(const Map& bodies, const std::string& name) {
  const Map map = bodies.Child(name);
  BodyDrawing body;
  body.name = name;
  body.place = bodies.Place(name);
  const std::string kind =
      map.Choice("kind", {"general", "plate", "planar", "rod", "particle"}, planar_ ? "planar" : "general");
  body.kind = kind == "planar"     ? BodyKind::kPlanar
              : kind == "plate"    ? BodyKind::kPlate
              : kind == "rod"      ? BodyKind::kRod
              : kind == "particle" ? BodyKind::kParticle
                                   : BodyKind::kGeneral;
  bool good = true;
  const auto read = [&](const char* key, EntityKind wanted, std::vector<int>& into) {
    const List list = map.OptionalItems(key);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string entity = list.Text(i);
      const auto found = entities_.find(entity);
      if (found == entities_.end() || drawing_.entities[static_cast<std::size_t>(found->second)].kind != wanted) {
        list.Problem(i, "config.unknown_name",
                     fmt::format("'{}' is no {}{}", entity, wanted == EntityKind::kPoint ? "point" : "vector",
                                 base::DidYouMean(entity, NamesOf(wanted == EntityKind::kPoint,
                                                                  wanted == EntityKind::kVector, false))));
        good = false;
        continue;
      }
      if (std::find(into.begin(), into.end(), found->second) != into.end()) {
        list.Problem(i, "config.duplicate_name", fmt::format("'{}' stands twice", entity));
        good = false;
        continue;
      }
      into.push_back(found->second);
    }
  };
  read("points", EntityKind::kPoint, body.points);
  read("vectors", EntityKind::kVector, body.vectors);
  if (good && body.points.empty()) {
    bodies.Problem(name, "config.too_few", fmt::format("body '{}' has no point; at least one was expected", name));
    good = false;
  }
  body.mass_kg = map.Number("mass_kg", {0.0, 1e9});
  const auto at = [this](int entity) { return Vector3d(Eigen::Map<const Vector3d>(at_.data() + 3 * entity)); };
  Vector3d centre = Vector3d::Zero();
  for (const int point : body.points) centre += at(point) / static_cast<double>(body.points.size());
  const bool line = body.kind == BodyKind::kRod || body.kind == BodyKind::kParticle;
  if (line && body.points.size() > (body.kind == BodyKind::kRod ? 2u : 1u)) {
    map.Problem("points", "config.wrong_length",
                fmt::format("a {} has {} points; {} expected", kind, body.points.size(),
                            body.kind == BodyKind::kRod ? "two were" : "one was"));
    good = false;
  }
  body.centre_m = line && !map.Has("centre_m") ? centre : ThreeNumbers(map, "centre_m", kMaxLength_m);
  if (body.kind == BodyKind::kPlanar) {
    body.inertia_kgm2(2, 2) = map.Number("inertia_zz_kgm2", {0.0, 1e12});
  } else if (body.kind == BodyKind::kRod && good && body.points.size() == 2) {
    const Vector3d way = at(body.points[1]) - at(body.points[0]);
    const double inertia = map.Number("inertia_kgm2", {0.0, 1e12}, body.mass_kg * way.squaredNorm() / 12.0);
    if (way.norm() > 0.0)
      body.inertia_kgm2 = inertia * (Eigen::Matrix3d::Identity() - way * way.transpose() / way.squaredNorm());
  } else if (body.kind == BodyKind::kPlate && !map.Has("inertia_kgm2")) {
    body.inertia_kgm2.setZero();  // as if all of its mass were in its centre
  } else if (body.kind == BodyKind::kGeneral || body.kind == BodyKind::kPlate) {
    const std::vector<double> i = map.Numbers("inertia_kgm2", {-1e12, 1e12});
    if (map.Has("inertia_kgm2") && i.size() != 6 && i.size() != 3) {
      map.Problem(
          "inertia_kgm2", "config.wrong_length",
          fmt::format(
              "'inertia_kgm2' holds {} numbers; three (xx, yy, zz) or six (xx, yy, zz, xy, xz, yz) were expected",
              i.size()));
      good = false;
    }
    if (i.size() == 3) body.inertia_kgm2 = Vector3d(i[0], i[1], i[2]).asDiagonal();
    if (i.size() == 6) body.inertia_kgm2 << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  }
  if (!good) return;
  auto parts = MakeBody(body, at_, names_);
  if (!parts) return bodies.Problem(name, parts.error().id, parts.error().message);
  drawing_.body_names.push_back(name);
  drawing_.bodies.push_back(std::move(parts).value());
  const int index = static_cast<int>(drawing_.bodies.size()) - 1;
  BodyParts& last = drawing_.bodies.back();
  last.frame.body = index;
  if (body.kind != BodyKind::kParticle) last.centre = OfBody(last.centre, index);
}

void DrawingReader::ReadMarkers(const Map& root) {
  const Map markers = root.OptionalChild("markers");
  for (const std::string& name : markers.Keys()) {
    const Map map = markers.Child(name);
    const auto body = Body(map, "body");
    const Vector3d at = ThreeNumbers(map, "at_m", kMaxLength_m);
    if (!body || !IsNew(markers, name)) continue;
    markers_.emplace(name, drawing_.bodies[static_cast<std::size_t>(*body)].frame.PointAt(at));
  }
}

std::vector<std::string> DrawingReader::NamesOf(bool points, bool vectors, bool scalars) const {
  std::vector<std::string> names;
  for (const EntityDrawing& entity : drawing_.entities) {
    const bool wanted = entity.kind == EntityKind::kPoint    ? points
                        : entity.kind == EntityKind::kVector ? vectors
                                                             : scalars;
    if (wanted) names.push_back(entity.name);
  }
  if (points) {
    for (const auto& [name, form] : markers_) names.push_back(name);
  }
  return names;
}

std::optional<int> DrawingReader::Entity(const Map& map, std::string_view key, const std::string& name,
                                         bool scalar) const {
  const auto found = entities_.find(name);
  if (found != entities_.end() && drawing_.entities[static_cast<std::size_t>(found->second)].is_scalar() == scalar)
    return found->second;
  map.Problem(key, "config.unknown_name",
              fmt::format("'{}' is no {}{}", name, scalar ? "angle or distance" : "point or vector",
                          base::DidYouMean(name, NamesOf(!scalar, !scalar, scalar))));
  return std::nullopt;
}

std::optional<Form> DrawingReader::Point(const Map& map, std::string_view key, const std::string& name) const {
  const auto marker = markers_.find(name);
  if (marker != markers_.end()) return marker->second;
  const auto found = entities_.find(name);
  if (found != entities_.end() && drawing_.entities[static_cast<std::size_t>(found->second)].kind == EntityKind::kPoint)
    return Single(found->second);
  map.Problem(key, "config.unknown_name",
              fmt::format("'{}' is no point{}", name, base::DidYouMean(name, NamesOf(true, false, false))));
  return std::nullopt;
}

std::optional<int> DrawingReader::Body(const Map& map, std::string_view key) const {
  const std::string name = map.Text(key);
  for (std::size_t i = 0; i < drawing_.body_names.size(); ++i) {
    if (drawing_.body_names[i] == name) return static_cast<int>(i);
  }
  if (map.Has(key))
    map.Problem(key, "config.unknown_name",
                fmt::format("'{}' is no body{}", name, base::DidYouMean(name, drawing_.body_names)));
  return std::nullopt;
}

std::optional<int> DrawingReader::LoadNamed(const Map& map, std::string_view key) const {
  const std::string name = map.Text(key);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < drawing_.loads.size(); ++i) {
    names.push_back(drawing_.loads[i].name);
    if (names.back() == name) return static_cast<int>(i);
  }
  if (map.Has(key))
    map.Problem(key, "config.unknown_name", fmt::format("'{}' is no force{}", name, base::DidYouMean(name, names)));
  return std::nullopt;
}

std::optional<std::array<Form, 2>> DrawingReader::TwoPoints(const Map& map, std::string_view key) const {
  const List list = map.Items(key);
  if (list.size() != 2) {
    if (map.Has(key))
      map.Problem(key, "config.wrong_length", fmt::format("'{}' names {} points; two were expected", key, list.size()));
    return std::nullopt;
  }
  const auto first = Point(map, key, list.Text(0));
  const auto second = Point(map, key, list.Text(1));
  if (!first || !second) return std::nullopt;
  return std::array<Form, 2>{*first, *second};
}

std::optional<Form> DrawingReader::Direction(const Map& map, std::string_view key) const {
  const List list = map.Items(key);
  if (list.size() == 1) {
    const std::string name = list.Text(0);
    const auto found = entities_.find(name);
    if (found != entities_.end() &&
        drawing_.entities[static_cast<std::size_t>(found->second)].kind == EntityKind::kVector)
      return Single(found->second);
    map.Problem(key, "config.unknown_name",
                fmt::format("'{}' is no vector{}", name, base::DidYouMean(name, NamesOf(false, true, false))));
    return std::nullopt;
  }
  if (list.size() != 2) {
    if (map.Has(key))
      map.Problem(key, "config.wrong_length",
                  fmt::format("'{}' has {} names; [VECTOR] or [POINT, POINT] was expected", key, list.size()));
    return std::nullopt;
  }
  const auto points = TwoPoints(map, key);
  if (!points) return std::nullopt;
  const Form way = Sum((*points)[1], (*points)[0], -1.0);
  // A direction between two of a body's own points turns with the body: what acts on it is a torque on the body.
  for (std::size_t b = 0; b < drawing_.bodies.size(); ++b) {
    const std::vector<int>& own = drawing_.bodies[b].entities;
    const auto owns = [&own](const Term& term) { return std::find(own.begin(), own.end(), term.entity) != own.end(); };
    if (way.parts.empty() && std::all_of(way.terms.begin(), way.terms.end(), owns))
      return OfBody(way, static_cast<int>(b));
  }
  return way;
}

}  // namespace rodeira::multibody
