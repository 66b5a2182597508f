// SPDX-License-Identifier: Apache-2.0
// The keys of world files: each with its type, its bounds and its default.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/world/road/world.hpp"
#include "common/world/road/world_schema.hpp"
#include "tests/common/core/config/every_key.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

std::string Problem(const std::string& text) {
  const auto world = World::Parse(text, std::filesystem::path(SourceDir()) / "configs/worlds/example/keys.yaml");
  return world ? "" : world.error().Text();
}

// What a key needs beside it: a ground, and what fits together with its bounds.
config::Values Beside(const std::string& path) {
  const std::string group = path.substr(0, path.find('.'));
  config::Values values;
  if (group == "terrain")
    values["terrain.generate.seed"] = "1";
  else if (group != "ground" && group != "network")
    values["ground.kind"] = "plane";
  if (path == "include[]")  // its road is placed at `main`
    values["roads"] = "[{id: main, axis: [{line: {length_m: 400}}], section: {template: rural}}]";
  if (path == "materials.NAME.texture_m") values["materials.NAME.texture"] = "worn.png";
  if (path == "start.x_m" || path == "start.y_m" || path == "start.heading_deg") {
    values["start.x_m"] = "0";
    values["start.y_m"] = "0";
  }
  const std::string hills = "terrain.generate.";
  if (path == hills + "flat_m") values[hills + "full_m"] = "100000";
  if (path == hills + "full_m" || path == hills + "reach_m") values[hills + "flat_m"] = "0.1";
  if (path == hills + "reach_m") values[hills + "full_m"] = "0.2";
  if (path.find(".texture.") != std::string::npos && path.ends_with("th_m")) values[group + ".texture.kind"] = "draped";
  if (path.find(".texture.") != std::string::npos && path.ends_with("st_m")) values[group + ".texture.kind"] = "draped";
  if (path == "ground.texture.kind=draped" || values.contains(group + ".texture.kind")) {
    for (const char* edge : {".texture.west_m", ".texture.south_m"}) values[group + edge] = "-1";
    for (const char* edge : {".texture.east_m", ".texture.north_m"}) values[group + edge] = "1";
  }
  if (path.starts_with("terrain.registration")) values = {{"terrain.file", "heights.asc"}};
  if (path == "terrain.file") values = {};
  return values;
}

// The keys of the file but for those of roads, junctions, templates and objects, which have a test of their own.
config::Schema OwnKeys() {
  config::Schema schema = WorldSchema();
  std::erase_if(schema.keys, [](const config::Key& key) { return key.name == "templates"; });
  for (config::Key& key : schema.keys) {
    if (key.name == "roads" || key.name == "junctions" || key.name == "objects") key.of.front().of.clear();
  }
  return schema;
}

// A generated file for each declared key. The edges of a picture are bounds of each other.
TEST(WorldKeys, EveryDeclaredKeyKeepsItsTypeAndBounds) {
  const config::Schema schema = OwnKeys();
  config::Companions others;
  for (const config::PlacedKey& placed : config::ValuesOf(schema)) {
    others[placed.path] = Beside(placed.path);
    for (const std::string& word : placed.key->words) {
      const std::string both = placed.path + "=" + word;
      others[both] = Beside(both);
    }
  }
  std::vector<config::PlacedKey> containers;
  config::CollectContainers(schema.keys, "", containers);
  for (const config::PlacedKey& placed : containers) others[placed.path] = Beside(placed.path);
  std::set<std::string> no_bounds;
  for (const std::string ground : {"terrain", "ground"}) {
    for (const char* edge : {".texture.west_m", ".texture.south_m", ".texture.east_m", ".texture.north_m"})
      no_bounds.insert(ground + edge);
  }
  config::ExpectEveryKey(schema, Problem, others, no_bounds);
}

}  // namespace
}  // namespace rodeira::road
