// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/drawing_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/core/base/suggest.hpp"
#include "common/vehicle/multibody/mechanism_schema.hpp"

namespace rodeira::multibody {
namespace {

using config::DeclaredMap;
using config::List;
using config::Map;

constexpr std::size_t kMaxEntities = 3000;  // the initial position is solved with dense matrices

// That a key names none of those that are known. A key that is missing is told by its reader.
void TellUnknown(const Map& map, std::string_view key, const std::string& name, std::string_view what,
                 const std::vector<std::string>& known) {
  if (!map.Has(key)) return;
  map.Problem(key, "config.unknown_name",
              name.empty() ? fmt::format("'{}' names no {}", key, what)
                           : fmt::format("'{}' is no {}{}", name, what, base::DidYouMean(name, known)));
}

}  // namespace

DrawingReader::DrawingReader(const Map& map) {
  const DeclaredMap root(map, MechanismKeys());
  drawing_.name = root.Text("name");
  drawing_.place = map.Place();
  planar_ = root.Flag("planar");
  drawing_.redundant = root.Flag("redundant");
  if (map.Has("gravity_mps2")) drawing_.gravity_mps2 = ThreeNumbers(root, "gravity_mps2");
  for (const auto& [name, direction] :
       {std::pair("world x", Vector3d::UnitX()), std::pair("world y", Vector3d::UnitY()),
        std::pair("world z", Vector3d::UnitZ())}) {
    const int entity = AddEntity(map, name, EntityKind::kVector, direction);
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
    map.Problem("points", "config.wrong_length",
                fmt::format("the mechanism has {} points, vectors and coordinates; at most {} were expected",
                            drawing_.entities.size(), kMaxEntities));
  }
}

Vector3d DrawingReader::ThreeNumbers(const DeclaredMap& map, std::string_view key) {
  const std::vector<double> numbers = map.RequiredNumbers(key);
  if (numbers.size() == 3) return {numbers[0], numbers[1], numbers[2]};
  if (map.map().Has(key))
    map.map().Problem(key, "config.wrong_length",
                      fmt::format("'{}' holds {} numbers; three were expected", key, numbers.size()));
  return Vector3d::Zero();
}

bool DrawingReader::IsNew(const Map& map, const std::string& name) {
  if (!entities_.contains(name) && !markers_.contains(name)) return true;
  map.Problem(name, "config.duplicate_name", fmt::format("the name '{}' is in use already", name));
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

void DrawingReader::ReadPoints(const DeclaredMap& root) {
  const auto named = root.Named("points");
  const Map points = root.map().OptionalChild("points");
  for (const auto& [name, map] : named) {
    const Vector3d at = ThreeNumbers(map, "at_m");
    const std::string fixed = map.Word("fixed");
    if (!IsNew(points, name)) continue;
    const int index = AddEntity(points, name, EntityKind::kPoint, at);
    EntityDrawing& entity = drawing_.entities.back();
    for (std::size_t c = 0; c < 3; ++c)
      entity.fixed[c] = fixed == "true" || (fixed != "false" && fixed.find("xyz"[c]) != std::string::npos);
    if (planar_) entity.fixed[2] = true;
    if (!map.map().Has("velocity_mps")) continue;
    const Vector3d velocity = ThreeNumbers(map, "velocity_mps");
    for (int c = 0; c < 3; ++c) drawing_.velocities.push_back({index, c, velocity[c], map.map().Place("velocity_mps")});
  }
}

void DrawingReader::ReadVectors(const DeclaredMap& root) {
  const Map vectors = root.map().OptionalChild("vectors");
  for (const auto& [name, map] : root.Named("vectors")) {
    const Vector3d direction = ThreeNumbers(map, "direction");
    const bool fixed = map.Flag("fixed");
    const double size = direction.norm();
    if (map.map().Has("direction") && !(size > 1e-9)) {
      map.map().Problem("direction", "mechanism.no_length", "'direction' has no length; a direction was expected");
      continue;
    }
    if (!IsNew(vectors, name) || !(size > 0.0)) continue;
    AddEntity(vectors, name, EntityKind::kVector, direction / size);
    drawing_.entities.back().fixed = {fixed, fixed, fixed || planar_};
  }
}

void DrawingReader::ReadBodies(const DeclaredMap& root) {
  const Map bodies = root.map().OptionalChild("bodies");
  for (const auto& [name, found] : root.Named("bodies")) ReadBody(bodies, name, found);
}

void DrawingReader::ReadBody(const Map& bodies, const std::string& name, const DeclaredMap& found) {
  BodyDrawing body;
  body.name = name;
  body.place = bodies.Place(name);
  const std::string kind = found.Word("kind", planar_ ? "planar" : "general");
  const DeclaredMap map = found.OfKind(kind);
  body.kind = kind == "planar"     ? BodyKind::kPlanar
              : kind == "plate"    ? BodyKind::kPlate
              : kind == "rod"      ? BodyKind::kRod
              : kind == "particle" ? BodyKind::kParticle
                                   : BodyKind::kGeneral;
  bool good = true;
  const auto read = [&](const char* key, EntityKind wanted, std::vector<int>& into) {
    const Map& with_key = map.MapWith(key);
    const List list = wanted == EntityKind::kPoint ? with_key.Items(key) : with_key.OptionalItems(key);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string entity = list.Text(i);
      const auto at = entities_.find(entity);
      if (at == entities_.end() || drawing_.entities[static_cast<std::size_t>(at->second)].kind != wanted) {
        list.Problem(i, "config.unknown_name",
                     fmt::format("'{}' is no {}{}", entity, wanted == EntityKind::kPoint ? "point" : "vector",
                                 base::DidYouMean(entity, NamesOf(wanted == EntityKind::kPoint,
                                                                  wanted == EntityKind::kVector, false))));
        good = false;
        continue;
      }
      if (std::find(into.begin(), into.end(), at->second) != into.end()) {
        list.Problem(i, "config.duplicate_name", fmt::format("'{}' appears twice in '{}'", entity, key));
        good = false;
        continue;
      }
      into.push_back(at->second);
    }
  };
  const bool line = body.kind == BodyKind::kRod || body.kind == BodyKind::kParticle;
  read("points", EntityKind::kPoint, body.points);
  read("vectors", EntityKind::kVector, body.vectors);
  if (good && body.points.empty()) {
    if (map.map().Has("points"))
      map.map().Problem("points", "config.too_few",
                        fmt::format("'points' of the body '{}' is empty; at least one was expected", name));
    good = false;
  }
  body.mass_kg = map.Number("mass_kg");
  const auto at = [this](int entity) { return Vector3d(Eigen::Map<const Vector3d>(at_.data() + 3 * entity)); };
  Vector3d centre = Vector3d::Zero();
  for (const int point : body.points) centre += at(point) / static_cast<double>(body.points.size());
  if (line && body.points.size() > (body.kind == BodyKind::kRod ? 2u : 1u)) {
    map.map().Problem("points", "config.wrong_length",
                      fmt::format("a {} has {} points; {} expected", kind, body.points.size(),
                                  body.kind == BodyKind::kRod ? "two were" : "one was"));
    good = false;
  }
  body.centre_m = line && !map.map().Has("centre_m") ? centre : ThreeNumbers(map, "centre_m");
  if (body.kind == BodyKind::kPlanar) {
    body.inertia_kgm2(2, 2) = map.Number("inertia_zz_kgm2");
  } else if (body.kind == BodyKind::kRod && good && body.points.size() == 2) {
    const Vector3d way = at(body.points[1]) - at(body.points[0]);
    const double inertia = map.Number("inertia_kgm2", body.mass_kg * way.squaredNorm() / 12.0);
    if (way.norm() > 0.0)
      body.inertia_kgm2 = inertia * (Eigen::Matrix3d::Identity() - way * way.transpose() / way.squaredNorm());
  } else if (body.kind == BodyKind::kPlate && !map.map().Has("inertia_kgm2")) {
    body.inertia_kgm2.setZero();  // as if all of its mass were in its centre
  } else if (body.kind == BodyKind::kGeneral || body.kind == BodyKind::kPlate) {
    const std::vector<double> i = map.RequiredNumbers("inertia_kgm2");
    if (map.map().Has("inertia_kgm2") && i.size() != 6 && i.size() != 3) {
      map.map().Problem(
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

void DrawingReader::ReadMarkers(const DeclaredMap& root) {
  const Map markers = root.map().OptionalChild("markers");
  for (const auto& [name, map] : root.Named("markers")) {
    const auto body = Body(map, "body");
    const Vector3d at = ThreeNumbers(map, "at_m");
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
  TellUnknown(map, key, name, scalar ? "angle or distance" : "point or vector", NamesOf(!scalar, !scalar, scalar));
  return std::nullopt;
}

std::optional<Form> DrawingReader::Point(const Map& map, std::string_view key, const std::string& name) const {
  const auto marker = markers_.find(name);
  if (marker != markers_.end()) return marker->second;
  const auto found = entities_.find(name);
  if (found != entities_.end() && drawing_.entities[static_cast<std::size_t>(found->second)].kind == EntityKind::kPoint)
    return Single(found->second);
  TellUnknown(map, key, name, "point", NamesOf(true, false, false));
  return std::nullopt;
}

std::optional<int> DrawingReader::Body(const DeclaredMap& map, std::string_view key) const {
  const std::string name = map.MapWith(key).Text(key);
  for (std::size_t i = 0; i < drawing_.body_names.size(); ++i) {
    if (drawing_.body_names[i] == name) return static_cast<int>(i);
  }
  TellUnknown(map.map(), key, name, "body", drawing_.body_names);
  return std::nullopt;
}

std::optional<int> DrawingReader::LoadNamed(const DeclaredMap& map, std::string_view key) const {
  const std::string name = map.Text(key);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < drawing_.loads.size(); ++i) {
    names.push_back(drawing_.loads[i].name);
    if (names.back() == name) return static_cast<int>(i);
  }
  TellUnknown(map.map(), key, name, "force", names);
  return std::nullopt;
}

std::optional<std::array<Form, 2>> DrawingReader::TwoPoints(const DeclaredMap& declared, std::string_view key) const {
  const Map& map = declared.MapWith(key);
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

std::optional<Form> DrawingReader::Direction(const DeclaredMap& declared, std::string_view key) const {
  const Map& map = declared.MapWith(key);
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
  const auto points = TwoPoints(declared, key);
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
