// SPDX-License-Identifier: Apache-2.0
// The keys of roads, cross-sections, junctions and objects: each with its type, its bounds and its default.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "common/world/design/design_schema.hpp"
#include "tests/common/core/config/every_key.hpp"
#include "tests/common/world/design/made_roads.hpp"
#include "tests/tree.hpp"

namespace rodeira::design {
namespace {

// The first problem of a world file in a folder.
std::string ProblemIn(const std::filesystem::path& folder, const std::string& text) {
  const auto file = config::File::Parse("rodeira: world/2\n" + text, folder / "keys.yaml");
  if (!file) return file.error().Text();
  const config::Map root = file.value().root();
  (void)root.Text("rodeira");
  const Design design = ReadDesign(file.value(), kFriction, "made", "", {}, root.OptionalChild("start"));
  if (!design.problems.empty()) return design.problems.front().Text();
  const auto own = file.value().Problems();
  return own.empty() ? "" : own.front().Text();
}

std::string Problem(const std::string& text) {
  return ProblemIn(std::filesystem::path(SourceDir()) / "configs/worlds/example", text);
}

// Roads that a road from (0, 0) to (100, 0) is joined with, or placed at.
constexpr const char* kRoads = R"(
roads:
  - {id: other, start: {y_m: 500}, axis: [line: {length_m: 100}], section: {template: rural}}
  - {id: before, start: {x_m: -100}, axis: [line: {length_m: 100}], section: {template: rural}}
  - {id: turned, start: {heading_deg: 180}, axis: [line: {length_m: 100}], section: {template: rural}}
  - {id: after, start: {x_m: 100}, axis: [line: {length_m: 100}], section: {template: rural}}
  - {id: back, start: {x_m: 200, heading_deg: 180}, axis: [line: {length_m: 100}], section: {template: rural}}
)";

std::string Item(const std::string& text) { return "  - " + text; }

std::string WithoutEnd(std::string text) {
  text.pop_back();
  return text;
}

// What each key of a schema, and each word and container of it, has beside it.
config::Companions Others(const config::Schema& schema,
                          const std::function<config::Values(const std::string&)>& beside) {
  config::Companions others;
  for (const config::PlacedKey& placed : config::ValuesOf(schema)) {
    others[placed.path] = beside(placed.path);
    for (const std::string& word : placed.key->words) {
      const std::string both = placed.path + "=" + word;
      others[both] = beside(both);
    }
  }
  std::vector<config::PlacedKey> containers;
  config::CollectContainers(schema.keys, "", containers);
  for (const config::PlacedKey& placed : containers) others[placed.path] = beside(placed.path);
  return others;
}

// The same without the value that is tried itself, or in which it lies.
config::Values Besides(config::Values values, const std::string& path) {
  std::erase_if(values, [&](const auto& value) { return path.starts_with(value.first); });
  return values;
}

bool Has(const std::string& path, const std::string& part) { return path.find(part) != std::string::npos; }

// Beside a key of a painted line.
void AddLine(const std::string& path, config::Values& values) {
  const std::string line = path.substr(0, path.find("lines[]") + 7) + ".";
  if (!Has(path, "[].t_m") && !Has(path, "[].ts")) values[line + "lane"] = "0";
  if (Has(path, "stroke_m") || Has(path, "gap_m")) values[line + "kind"] = "dashed";
  if (Has(path, "left") || Has(path, "right") || Has(path, "apart_m")) values[line + "kind"] = "mixed";
}

config::Values BesideSection(const std::string& path) {
  config::Values values;
  if (path.starts_with("lines")) AddLine(path, values);
  if (path.starts_with("lanes"))
    values[Has(path, "widths") ? "lanes[].fall" : "lanes[].width_m"] = Has(path, "widths") ? "0" : "3";
  else
    values["template"] = "rural";
  return Besides(values, path);
}

TEST(RoadKeys, EveryKeyOfASectionKeepsItsTypeAndBounds) {
  const auto read = [](const std::string& text) {
    return Problem(kRoads + Item("{id: made, axis: [line: {length_m: 100}], section: " + WithoutEnd(text) + "}"));
  };
  config::ExpectEveryKey(SectionSchema(), read, Others(SectionSchema(), BesideSection),
                         {"lanes[].id", "lines[].lane", "lines[].to_s_m"});
}

config::Values BesideAxis(const std::string& path) {
  const std::string line = "axis[].line.length_m", arc = "axis[].arc.", clothoid = "axis[].clothoid.";
  if (path.starts_with("axis[].from")) return {{line, "100"}};
  if (path == line) return {{"axis[].from.x_m", "0"}, {"axis[].from.y_m", "0"}, {"axis[].from.heading_deg", "0"}};
  config::Values values;
  if (path == arc + "length_m") values = {{arc + "radius_m", "10000000"}};
  if (path == arc + "radius_m") values = {{arc + "length_m", "100"}};
  if (path == arc + "turn_deg") values = {{"vertical", "[{s_m: 0, z_m: 0}, {s_m: 7000, z_m: 700}]"}};
  if (path.starts_with(clothoid + "radius")) values = {{clothoid + "length_m", "100"}};
  if (path == clothoid + "length_m") values = {{clothoid + "radius_end_m", "10000000"}};
  if (path == clothoid + "a_m") values = {{clothoid + "radius_end_m", "200"}};
  return values;
}

config::Values BesideLaid(const std::string& path) {
  config::Values values;
  if (path.starts_with("surfaces")) {
    const bool crg = Has(path, "crg") || Has(path, "orientation") || Has(path, "offset") || Has(path, "z_scale");
    values[crg ? "surfaces[].crg" : "surfaces[].iso_8608"] = crg ? "bumps.crg" : "B";
  }
  if (path.starts_with("patches") && !Has(path, "material")) values["patches[].friction"] = "0.5";
  if (!path.starts_with("bumps")) return values;
  if (path.ends_with("=straight"))
    values["bumps[].heights"] = "[{s_m: 0, z_m: 0}, {s_m: 5, z_m: 0.1}, {s_m: 10, z_m: 0}]";
  else if (!Has(path, "heights"))
    values["bumps[].height_m"] = "0.1";
  if (Has(path, "side_m")) values["section"] = "{lanes: [{id: -1, width_m: 50}, {id: 1, width_m: 50}]}";
  return values;
}

// Beside a key of a sign or an object.
config::Values BesideFurniture(const std::string& path) {
  const std::string list = path.substr(0, path.find(']') + 1) + ".";
  const bool repeated = Has(path, "every_m") || Has(path, "from_s_m") || Has(path, "to_s_m");
  config::Values values;
  if (repeated) values[list + "every_m"] = "10";
  if (!repeated && !path.ends_with("=guard_rail") && !path.ends_with("=wall")) values[list + "s_m"] = "50";
  if (path == "signs[].value") values["signs[].type"] = "speed_limit";
  for (const char* type : {"=downhill", "=uphill", "=speed_limit", "=end_of_speed_limit"}) {
    if (path.starts_with("signs") && path.ends_with(type)) values["signs[].value"] = "50";
  }
  return values;
}

config::Values BesideRoad(const std::string& path) {
  config::Values values;
  if (path.starts_with("axis")) values = BesideAxis(path);
  if (path.starts_with("patches") || path.starts_with("bumps") || path.starts_with("surfaces"))
    values = BesideLaid(path);
  if (path.starts_with("signs") || path.starts_with("objects")) values = BesideFurniture(path);
  if (path.starts_with("lines")) AddLine(path, values);
  if (path == "predecessor.end=start") values["predecessor.road"] = "turned";
  if (path == "successor.end=end") values["successor.road"] = "back";
  if (!path.starts_with("axis") && !path.starts_with("points")) values["axis"] = "[{line: {length_m: 100}}]";
  if (path == "points.smooth" || path == "points.within_m") values["points.list"] = "[[0, 0], [100, 0]]";
  if (!values.contains("section") && !path.starts_with("section")) values["section.template"] = "rural";
  return Besides(values, path);
}

// Sections have a test of their own. Not reached are bounds that the road's lanes and other keys narrow.
TEST(RoadKeys, EveryKeyOfARoadKeepsItsTypeAndBounds) {
  config::Schema schema = RoadSchema();
  for (config::Key& key : schema.keys) {
    if (key.name == "section") std::erase_if(key.of, [](const config::Key& part) { return part.name != "template"; });
  }
  const auto read = [](const std::string& text) { return Problem(kRoads + Item(text)); };
  config::ExpectEveryKey(
      schema, read, Others(schema, BesideRoad),
      {"place.s_m", "axis[].clothoid.a_m", "lines[].lane", "lines[].to_s_m", "markings[](crossing).lane",
       "markings[](stop_line).lane", "markings[](arrow).lane", "bridges[].to_s_m", "tunnels[].to_s_m",
       "surfaces[].to_s_m", "patches[].to_s_m", "patches[].from_t_m", "patches[].to_t_m", "bumps[].to_s_m",
       "bumps[].from_t_m", "bumps[].to_t_m", "bumps[].heights[].s_m", "bumps[].heights[].z_m"});
}

// Two roads, which cross at their stations 1000, or have an end in common.
std::string RoadsOfJunction(const std::string& junction) {
  const int begin = Has(junction, "end: start") ? 0 : Has(junction, "end: end") ? -2000 : -1000;
  return fmt::format(
      "roads:\n"
      "  - {{id: main, start: {{x_m: {0}}}, axis: [line: {{length_m: 2000}}], section: {{template: rural}}}}\n"
      "  - {{id: street, start: {{y_m: {0}, heading_deg: 90}}, axis: [line: {{length_m: 2000}}], "
      "section: {{template: rural}}}}\n",
      begin);
}

config::Values BesideJunction(const std::string& path) {
  config::Values values;
  if (!path.starts_with("roads[].end")) values["roads[].s_m"] = "1000";
  if (path.starts_with("lights")) values["control"] = "lights";
  if (path == "control=lights") values["lights.offset_s"] = "0";
  if (path == "lights.red_amber_s") values["lights.amber_s"] = "10";
  return Besides(values, path);
}

// Of a generated junction both roads are `main`, and it has one phase.
std::string ReadJunction(std::string text) {
  const std::string main = "road: main", phases = "phases: [{";
  if (const std::size_t second = text.rfind(main); second != text.find(main))
    text.replace(second, main.size(), "road: street");
  if (const std::size_t phase = text.find(phases); phase != std::string::npos)
    text.insert(phase + phases.size(), "green: [street], for_s: 5}, {");
  return Problem(RoadsOfJunction(text) + "junctions:\n" + Item(text));
}

TEST(RoadKeys, EveryKeyOfAJunctionKeepsItsTypeAndBounds) {
  config::ExpectEveryKey(JunctionSchema(), ReadJunction, Others(JunctionSchema(), BesideJunction), {"roads[].s_m"});
}

config::Values BesideObject(const std::string& path) {
  config::Values values;
  const bool row = path.starts_with("every_m") || path.starts_with("rotation_deg");
  const bool rail = path == "type=guard_rail" || path == "type=wall";
  if (row) values["every_m"] = "5";
  if (path.starts_with("along")) values["type"] = "wall";
  if (row || rail)
    values["along"] = "[[0, 0], [10, 0]]";
  else if (!path.starts_with("along"))
    values["x_m"] = values["y_m"] = "0";
  return Besides(values, path);
}

TEST(RoadKeys, EveryKeyOfAnObjectAtNoRoadKeepsItsTypeAndBounds) {
  const auto read = [](const std::string& text) { return Problem("objects:\n" + Item(text)); };
  config::ExpectEveryKey(ObjectSchema(), read, Others(ObjectSchema(), BesideObject));
}

// Of the lists that have tests of their own only the type.
TEST(RoadKeys, EveryKeyOfAnIncludedFileKeepsItsTypeAndBounds) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "rodeira-included-keys";
  std::filesystem::create_directories(folder);
  std::filesystem::copy_file(std::filesystem::path(SourceDir()) / "configs/worlds/example/worn.png",
                             folder / "worn.png", std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder / "village.yaml") << "rodeira: world/2\n";
  config::Schema schema = IncludeSchema();
  for (config::Key& key : schema.keys) {
    if (key.name != "materials" && !key.of.empty()) key.of.front().of.clear();
  }
  // A template is read where a road uses it.
  std::erase_if(schema.keys, [](const config::Key& key) { return key.name == "templates"; });
  const auto read = [&](const std::string& text) {
    std::ofstream(folder / "part.yaml") << text;
    return ProblemIn(folder, "include: [part.yaml]\n");
  };
  const auto beside = [](const std::string& path) {
    return path == "materials.NAME.texture_m" ? config::Values{{"materials.NAME.texture", "worn.png"}}
                                              : config::Values();
  };
  config::ExpectEveryKey(schema, read, Others(schema, beside));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace rodeira::design
