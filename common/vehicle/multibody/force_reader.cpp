// SPDX-License-Identifier: Apache-2.0
// Forces of a mechanism file.
#include <fmt/format.h>

#include <cmath>

#include "common/vehicle/multibody/bushing.hpp"
#include "common/vehicle/multibody/drawing_reader.hpp"
#include "common/vehicle/multibody/springs.hpp"

namespace rodeira::multibody {
namespace {

using config::DeclaredMap;
using config::List;
using config::Map;

constexpr double kLargest = 1e12;

Curve ReadCurve(const DeclaredMap& declared, std::string_view curve_key, std::string_view slope_key) {
  const Map& map = declared.MapWith(curve_key);
  if (map.Has(curve_key) && map.Has(slope_key))
    map.Problem(curve_key, "config.conflicting_keys",
                fmt::format("'{}' and '{}' say the same; one of them was expected", curve_key, slope_key));
  const double slope = declared.Number(slope_key);
  const List list = map.OptionalItems(curve_key);
  std::vector<Curve::Sample> samples;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::vector<double> pair = list.Numbers(i);
    if (pair.size() != 2) {
      list.Problem(i, "config.wrong_length",
                   fmt::format("item {} of '{}' holds {} numbers; two were expected", i + 1, curve_key, pair.size()));
    } else if (!samples.empty() && !(pair[0] > samples.back().x)) {
      list.Problem(i, "config.wrong_order",
                   fmt::format("item {} of '{}' is at {}; ascending numbers were expected", i + 1, curve_key, pair[0]));
    } else if (!(std::fabs(pair[0]) < kLargest && std::fabs(pair[1]) < kLargest)) {
      list.Problem(i, "config.out_of_range", fmt::format("item {} of '{}' is no reasonable number", i + 1, curve_key));
    } else {
      samples.push_back({pair[0], pair[1]});
    }
  }
  if (samples.size() == 1)
    list.Problem(0, "config.too_few", fmt::format("'{}' has one sample; at least two were expected", curve_key));
  if (samples.size() >= 2) return Curve(samples);
  return slope > 0.0 ? Curve::Linear(slope) : Curve();
}

// Names of a spring's keys: with lengths, or with angles.
struct Keys {
  const char *stiffness, *damping, *free, *preload, *spring_curve, *damper_curve, *stops, *stop_stiffness,
      *stop_damping;
};
constexpr Keys kLengths = {"stiffness_Npm", "damping_Nspm",       "free_m",
                           "preload_N",     "spring_m_N",         "damper_mps_N",
                           "stops_m",       "stop_stiffness_Npm", "stop_damping_Nspm"};
constexpr Keys kAngles = {"stiffness_Nmprad", "damping_Nmsprad",       "free_rad",
                          "preload_Nm",       "spring_rad_Nm",         "damper_radps_Nm",
                          "stops_rad",        "stop_stiffness_Nmprad", "stop_damping_Nmsprad"};

SpringLaw ReadSpringLaw(const DeclaredMap& map, const Keys& keys, double drawn) {
  SpringLaw law;
  law.spring = ReadCurve(map, keys.spring_curve, keys.stiffness);
  law.damper = ReadCurve(map, keys.damper_curve, keys.damping);
  law.free = map.Number(keys.free, drawn);
  law.preload = map.Number(keys.preload);
  if (map.MapWith(keys.stops).Has(keys.stops)) {
    const std::vector<double> stops = map.map().Numbers(keys.stops, {-1e6, 1e6});
    if (stops.size() == 2 && stops[0] < stops[1]) {
      law.low = stops[0];
      law.high = stops[1];
    } else {
      map.map().Problem(keys.stops, "config.wrong_length",
                        fmt::format("'{}' expects two numbers, the lower one first", keys.stops));
    }
    law.stop_stiffness = map.RequiredNumber(keys.stop_stiffness);
    law.stop_damping = map.Number(keys.stop_damping);
  }
  return law;
}

}  // namespace

void DrawingReader::ReadForces(const DeclaredMap& root) {
  for (const auto& [name, force] : root.Named("forces")) {
    const std::string kind = force.Word("kind");
    if (auto load = ReadForce(force.OfKind(kind), kind)) drawing_.loads.push_back({name, std::move(load)});
  }
}

std::shared_ptr<Load> DrawingReader::ReadSpring(const DeclaredMap& map, bool torsion) {
  if (torsion || map.map().Has("coordinate")) {
    const Map& with_coordinate = map.MapWith("coordinate");
    const auto coordinate = Entity(with_coordinate, "coordinate", with_coordinate.Text("coordinate"), true);
    const double drawn = coordinate ? at_[static_cast<std::size_t>(3 * *coordinate)] : 0.0;
    const SpringLaw law = ReadSpringLaw(map, torsion ? kAngles : kLengths, drawn);
    if (!coordinate) return nullptr;
    const bool angle = drawing_.entities[static_cast<std::size_t>(*coordinate)].kind == EntityKind::kAngle;
    if (angle != torsion) {
      with_coordinate.Problem("coordinate", angle ? "this is an angle; 'kind: torsion' was expected"
                                                  : "this is a distance; 'kind: spring' was expected");
      return nullptr;
    }
    return std::make_shared<CoordinateSpring>(*coordinate, law);
  }
  const auto points = TwoPoints(map, "points");
  const double drawn = points ? Drawn(Sum((*points)[1], (*points)[0], -1.0)).norm() : 0.0;
  const SpringLaw law = ReadSpringLaw(map, kLengths, drawn);
  if (!points) return nullptr;
  return std::make_shared<PointSpring>((*points)[0], (*points)[1], law);
}

std::shared_ptr<Load> DrawingReader::ReadForce(const DeclaredMap& map, const std::string& kind) {
  if (kind == "spring" || kind == "torsion") return ReadSpring(map, kind == "torsion");
  if (kind == "anti_roll") return ReadAntiRollBar(map);
  if (kind == "coordinate") {
    const auto coordinate = Entity(map.map(), "coordinate", map.Text("coordinate"), true);
    const bool angle =
        coordinate && drawing_.entities[static_cast<std::size_t>(*coordinate)].kind == EntityKind::kAngle;
    const Law law = ReadLaw(map, angle ? "torque_Nm" : "force_N");
    if (!coordinate) return nullptr;
    return std::make_shared<CoordinateForce>(*coordinate, law);
  }
  if (kind == "force") {
    const auto point = Point(map.map(), "point", map.Text("point"));
    const Vector3d direction = ThreeNumbers(map, "direction");
    const Law law = ReadLaw(map, "force_N");
    if (!point) return nullptr;
    if (!(direction.norm() > 1e-9)) {
      if (map.map().Has("direction"))
        map.map().Problem("direction", "mechanism.no_length", "'direction' has no length");
      return nullptr;
    }
    return std::make_shared<GivenForce>(*point, direction.normalized(), law);
  }
  if (kind == "torque") {
    const auto body = Body(map, "body");
    const Vector3d axis = ThreeNumbers(map, "axis");
    const Law law = ReadLaw(map, "torque_Nm");
    if (!body) return nullptr;
    if (!drawing_.bodies[static_cast<std::size_t>(*body)].turns) {
      map.map().Problem("body", "config.wrong_kind", "a torque can act on a general or planar body only");
      return nullptr;
    }
    if (!(axis.norm() > 1e-9)) {
      if (map.map().Has("axis")) map.map().Problem("axis", "mechanism.no_length", "'axis' has no length");
      return nullptr;
    }
    return std::make_shared<GivenTorque>(drawing_.bodies[static_cast<std::size_t>(*body)].frame, axis.normalized(),
                                         law);
  }
  if (kind == "drag") {
    const auto point = Point(map.map(), "point", map.Text("point"));
    const double area = map.Number("drag_area_m2");
    const double density = map.Number("density_kgpm3");
    if (!point) return nullptr;
    return std::make_shared<Drag>(*point, 0.5 * density * area);
  }
  return ReadBushing(map);
}

std::shared_ptr<Load> DrawingReader::ReadAntiRollBar(const DeclaredMap& declared) {
  const Map& map = declared.MapWith("coordinates");
  const List list = map.Items("coordinates");
  if (list.size() != 2) {
    if (map.Has("coordinates"))
      map.Problem("coordinates", "config.wrong_length",
                  fmt::format("'coordinates' names {}; two were expected", list.size()));
    return nullptr;
  }
  const auto a = Entity(map, "coordinates", list.Text(0), true);
  const auto b = Entity(map, "coordinates", list.Text(1), true);
  if (!a || !b) return nullptr;
  const auto is_angle = [this](int entity) {
    return drawing_.entities[static_cast<std::size_t>(entity)].kind == EntityKind::kAngle;
  };
  if (*a == *b || is_angle(*a) != is_angle(*b)) {
    map.Problem("coordinates", "an anti-roll bar joins two different coordinates of one kind, distances or angles");
    return nullptr;
  }
  const Keys& keys = is_angle(*a) ? kAngles : kLengths;
  AntiRollBar::Settings settings;
  settings.stiffness = declared.RequiredNumber(keys.stiffness);
  settings.damping = declared.Number(keys.damping);
  settings.drawn = at_[static_cast<std::size_t>(3 * *b)] - at_[static_cast<std::size_t>(3 * *a)];
  return std::make_shared<AntiRollBar>(*a, *b, settings);
}

// Between two bodies, or between a body and a point: then where that is drawn, and without resistance to turning.
std::shared_ptr<Load> DrawingReader::ReadBushing(const DeclaredMap& declared) {
  const Map& map = declared.map();
  const auto first = Body(declared, "first");
  BushingSettings settings;
  settings.stiffness_Npm = ThreeNumbers(declared, "stiffness_Npm");
  if (map.Has("damping_Nspm")) settings.damping_Nspm = ThreeNumbers(declared, "damping_Nspm");
  const auto turns = [this](int body) { return drawing_.bodies[static_cast<std::size_t>(body)].turns; };
  if (first && !turns(*first)) {
    map.Problem("first", "config.wrong_kind", "a bushing's first body must be a general or planar one");
    return nullptr;
  }
  if (declared.MapWith("point").Has("point")) {
    const auto point = Point(map, "point", map.Text("point"));
    if (!first || !point) return nullptr;
    return std::make_shared<Bushing>(drawing_.bodies[static_cast<std::size_t>(*first)].frame, *point, Drawn(*point),
                                     settings);
  }
  const auto second = Body(declared, "second");
  const Vector3d at = ThreeNumbers(declared, "at_m");
  settings.turn_Nmprad = declared.Number("stiffness_Nmprad");
  settings.turn_Nmsprad = declared.Number("damping_Nmsprad");
  if (!first || !second) return nullptr;
  if (!turns(*second)) {
    map.Problem("second", "config.wrong_kind", "a bushing joins general or planar bodies, or one with a 'point'");
    return nullptr;
  }
  return std::make_shared<Bushing>(drawing_.bodies[static_cast<std::size_t>(*first)].frame,
                                   drawing_.bodies[static_cast<std::size_t>(*second)].frame, at, settings);
}

}  // namespace rodeira::multibody
