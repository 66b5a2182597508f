// SPDX-License-Identifier: Apache-2.0
// The keys of mechanism files: each with its type, its bounds and its default.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "common/vehicle/multibody/drawing_reader.hpp"
#include "common/vehicle/multibody/mechanism_schema.hpp"
#include "tests/common/core/config/every_key.hpp"

namespace rodeira::multibody {
namespace {

std::string Problem(const std::string& text) {
  const auto file = config::File::Parse(text, "mechanism.yaml");
  if (!file) return file.error().Text();
  const config::DeclaredMap root(file.value().root(), MechanismSchema().keys);
  (void)root.Word("rodeira");
  const DrawingReader reader(root.map());
  const config::Map outputs = root.MapWith("outputs").OptionalChild("outputs");  // read with a system that was made
  for (const std::string& name : outputs.Keys()) (void)outputs.Text(name);
  const auto status = file.value().Finish();
  return status ? "" : status.error().Text();
}

// What the samples of the declarations name, in groups that stand in the file where none of their own keys is tried.
const config::Values& Named() {
  static const config::Values named{
      {"points", "{A: {at_m: [0, 0, 0]}, B: {at_m: [1, 0, 0]}, C: {at_m: [0, 1, 0]}, D: {at_m: [0, 0, 1]}}"},
      {"vectors", "{u: {direction: [1, 0, 0]}, v: {direction: [0, 1, 0]}, w: {direction: [0, 0, 1]}}"},
      {"bodies",
       "{chassis: {kind: general, points: [A], vectors: [u, v, w], mass_kg: 1, centre_m: [0, 0, 0], inertia_kgm2: [1, "
       "1, 1]}}"},
      {"angles", "{turn: {rotor_kgm2: 1}, other_turn: {rotor_kgm2: 1}}"},
      {"distances", "{way: {points: [A, B]}, other: {points: [B, A]}}"}};
  return named;
}

// What else a key needs in its own mapping.
config::Values Beside(const std::string& path) {
  config::Values values;
  const auto is_in = [&](const std::string& mapping) { return path.starts_with(mapping); };
  const auto is = [&](const std::string& mapping, const std::string& key) {
    return path == mapping + "." + key || path == mapping + "." + key + "[]";
  };
  for (const std::string kind : {"general", "plate", "planar"}) {
    const std::string body = "bodies.NAME(" + kind + ")";
    if ((is_in(body) || path == "bodies.NAME.kind=" + kind) && !is(body, "vectors"))
      values[body + ".vectors"] = kind == "plate" ? "[u, v]" : "[u, v, w]";
    if (is(body, "vectors")) values[body + ".points"] = kind == "plate" ? "[A, B, C]" : "[A, B, C, D]";
  }
  const std::string spring = "forces.NAME(spring)", bar = "forces.NAME(anti_roll)", bushing = "forces.NAME(bushing)";
  if ((is_in(spring) && !is(spring, "points")) || path == "forces.NAME.kind" || path == "forces.NAME.kind=spring" ||
      path == "forces.NAME")
    values[spring + ".coordinate"] = "way";
  for (const std::string& kind : {spring, std::string("forces.NAME(torsion)")}) {
    const std::string stops = kind == spring ? "stops_m" : "stops_rad";
    const std::string stiffness = kind == spring ? "stop_stiffness_Npm" : "stop_stiffness_Nmprad";
    if (path.starts_with(kind + ".stop_")) values[kind + "." + stops] = "[0, 1]";
    if (path.starts_with(kind + ".stop")) values[kind + "." + stiffness] = "1";
  }
  if (is(bar, "stiffness_Nmprad") || is(bar, "damping_Nmsprad")) {
    values[bar + ".coordinates"] = "[turn, other_turn]";
    values[bar + ".stiffness_Nmprad"] = "1";
  } else if (is_in(bar) || path == "forces.NAME.kind=anti_roll") {
    values[bar + ".stiffness_Npm"] = "1";
  }
  if ((is_in(bushing) && !is(bushing, "point")) || path == "forces.NAME.kind=bushing") {
    values[bushing + ".second"] = "chassis";
    if (!is(bushing, "at_m")) values[bushing + ".at_m"] = "[0, 0, 0]";
  }
  if (path == "forces.NAME(coordinate).torque_Nm") values["forces.NAME(coordinate).coordinate"] = "turn";
  if (path == "angles.NAME.of" || path == "angles.NAME.from" || path == "angles.NAME.to") {
    values["angles.NAME.of"] = values["angles.NAME.from"] = "[u]";
    values["angles.NAME.to"] = "[v]";
  } else if (is_in("angles.NAME")) {
    values["angles.NAME.rotor_kgm2"] = "1";
  }
  return values;
}

// A generated file for each declared key, of each kind of body, constraint and force.
TEST(MechanismKeys, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  config::Companions others;
  const auto with = [&](const std::string& path) {
    const std::string group = path.substr(0, path.find('.'));
    config::Values values = Beside(path);
    for (const auto& [name, text] : Named()) {
      if (name != group && group != "points" && !(group == "vectors" && name == "bodies")) values[name] = text;
    }
    others[path] = values;
  };
  for (const config::PlacedKey& placed : config::ValuesOf(MechanismSchema())) {
    with(placed.path);
    for (const std::string& word : placed.key->words) with(placed.path + "=" + word);
  }
  std::vector<config::PlacedKey> containers;
  config::CollectContainers(MechanismSchema().keys, "", containers);
  for (const config::PlacedKey& placed : containers) with(placed.path);
  // No mass has such moments of inertia; the centre of a rod is between its ends.
  std::set<std::string> no_bounds{"bodies.NAME(general).inertia_kgm2[]", "bodies.NAME(plate).inertia_kgm2[]"};
  for (const std::string kind : {"plate", "rod", "particle"}) no_bounds.insert("bodies.NAME(" + kind + ").centre_m[]");
  config::ExpectEveryKey(MechanismSchema(), Problem, others, no_bounds);
}

}  // namespace
}  // namespace rodeira::multibody
