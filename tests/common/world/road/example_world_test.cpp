// SPDX-License-Identifier: Apache-2.0
// The example says every key that a world file may say.
#include <gtest/gtest.h>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/world/design/object_reader.hpp"
#include "common/world/network/line_kinds.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "common/world/road/world_schema.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SourceDir();

// Each key of a file with the way to the mapping that it stands in.
void Collect(const YAML::Node& node, const std::string& way, std::set<std::pair<std::string, std::string>>& keys) {
  if (node.IsSequence()) {
    for (const auto& item : node) Collect(item, way, keys);
  }
  if (!node.IsMap()) return;
  for (const auto& item : node) {
    const std::string key = item.first.as<std::string>();
    keys.emplace(way, key);
    const bool named = way == "materials" || way == "templates";  // a template holds what a section does
    const std::string inner =
        way == "templates" ? "roads.section" : (way.empty() ? "" : way + ".") + (named ? "*" : key);
    Collect(item.second, inner, keys);
  }
}

// A declared path as Collect tells it: without the marks of lists, names and kinds.
std::string PlainPath(std::string path) {
  path = std::regex_replace(path, std::regex("\\[\\]|\\([a-z_]+\\)"), "");
  path = std::regex_replace(path, std::regex("\\bNAME\\b"), "*");
  return std::regex_replace(path, std::regex("^templates\\.\\*"), "roads.section");
}

using Said = std::set<std::pair<std::string, std::string>>;

// Whether a key stands in the same list or mapping of the file or of a road, however deep.
bool IsSaid(const Said& said, const std::string& path) {
  const std::size_t last = path.rfind('.');
  const std::string key = path.substr(last == std::string::npos ? 0 : last + 1);
  std::string place = last == std::string::npos ? "" : path.substr(0, last);
  const std::size_t first = place.find('.');
  const std::size_t second = first == std::string::npos ? first : place.find('.', first + 1);
  place.resize(std::min(place.size(), place.starts_with("roads.") ? second : first));
  return std::ranges::any_of(said, [&](const auto& there) {
    return there.second == key && (there.first == place || there.first.starts_with(place + "."));
  });
}

TEST(ExampleWorld, SaysEveryKey) {
  // These have the same declarations: one of both says a key.
  const std::vector<std::pair<std::string, std::string>> same = {{"roads.section.lines.", "roads.lines."},
                                                                 {"ground.texture.", "terrain.texture."},
                                                                 {"terrain.texture.", "ground.texture."},
                                                                 {"objects.", "roads.objects."}};
  Said said;
  for (const char* file : {"world.yaml", "village.yaml", "plane.yaml", "heights.yaml", "named.yaml"})
    Collect(YAML::LoadFile((kRoot / "configs/worlds/example" / file).string()), "", said);
  std::set<std::string> paths;
  for (const config::PlacedKey& placed : config::ValuesOf(WorldSchema())) paths.insert(PlainPath(placed.path));
  for (const std::string& path : paths) {
    const bool by_another = std::ranges::any_of(same, [&](const auto& pair) {
      return path.starts_with(pair.first) && IsSaid(said, pair.second + path.substr(pair.first.size()));
    });
    EXPECT_TRUE(by_another || IsSaid(said, path)) << "the examples do not say " << path;
  }
  EXPECT_GT(paths.size(), 200u);
}

// The others, which say what world.yaml cannot.
TEST(ExampleWorld, TheOthersAreWorldsToo) {
  for (const char* file : {"plane.yaml", "heights.yaml", "named.yaml"}) {
    const fs::path path = kRoot / "configs/worlds/example" / file;
    for (const auto& problem : WorldProblems(path)) ADD_FAILURE() << problem.Text();
    EXPECT_TRUE(WorldWarnings(path).empty()) << file;
    EXPECT_TRUE(World::Load(path).ok()) << file;
  }
}

// Each type of object and each kind of line that a reader takes stands in it once.
TEST(ExampleWorld, HasEveryTypeOfObjectAndKindOfLine) {
  const std::string example = base::ReadText(kRoot / "configs/worlds/example/world.yaml").value();
  const std::vector<std::string> types = design::ObjectTypes();
  EXPECT_GE(types.size(), 8u);
  for (const std::string& type : types) EXPECT_NE(example.find("type: " + type + ","), std::string::npos) << type;
  for (const network::LineKind& kind : network::kLineKinds)
    EXPECT_NE(example.find("kind: " + std::string(kind.name) + ","), std::string::npos) << kind.name;
}

TEST(ExampleWorld, IsAWorld) {
  const fs::path path = kRoot / "configs/worlds/example/world.yaml";
  for (const auto& problem : WorldProblems(path)) ADD_FAILURE() << problem.Text();
  const auto world = World::Load(path);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  EXPECT_EQ(world.value()->network()->junctions().size(), 1u);
}

// Files beside a world are found from wherever one stands.
TEST(ExampleWorld, LoadsByARelativePathToo) {
  const fs::path before = fs::current_path();
  fs::current_path(kRoot);
  const auto world = World::Load("configs/worlds/example/world.yaml");
  fs::current_path(before);
  ASSERT_TRUE(world.ok()) << world.error().Text();
  EXPECT_EQ(world.value()->content_hash(),
            World::Load(kRoot / "configs/worlds/example/world.yaml").value()->content_hash());
}

}  // namespace
}  // namespace rodeira::road
