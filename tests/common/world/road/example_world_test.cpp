// SPDX-License-Identifier: Apache-2.0
// The example says every key that a world file may say, and the document tells of each of them.
#include <gtest/gtest.h>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/core/base/files.hpp"
#include "common/world/network/line_kinds.hpp"
#include "common/world/road/world.hpp"
#include "common/world/road/world_report.hpp"
#include "tests/tree.hpp"

namespace rodeira::road {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SourceDir();

// Where the keys that a reader asks for stand in a world file: below these mappings and lists, or (with a '.' behind)
// in them themselves. Lists' numbers are left out; what an author names is '*'.
const std::map<std::string, std::vector<std::string>> kPlaces = {
    {"design/axis_reader.cpp", {"roads.", "roads.start", "roads.axis", "roads.points"}},
    {"design/behind_end.cpp", {"roads.", "roads.section"}},
    {"design/beside.cpp", {"roads.signs", "roads.objects"}},
    {"design/context.cpp", {"materials"}},
    {"design/design_reader.cpp", {".", "roads.predecessor", "roads.successor", "start"}},
    {"design/furniture_reader.cpp",
     {"roads.", "roads.signs", "roads.objects", "roads.bridges", "roads.tunnels", "roads.surfaces"}},
    {"design/junction_reader.cpp", {".", "junctions"}},
    {"design/laid_reader.cpp", {"roads.", "roads.patches", "roads.bumps"}},
    {"design/line_reader.cpp", {"roads.", "roads.lines"}},
    {"design/marking_reader.cpp", {"roads.", "roads.markings"}},
    {"design/object_reader.cpp", {"roads.objects"}},
    {"design/points.cpp", {"roads.points"}},
    {"design/profile_reader.cpp", {"roads.", "roads.vertical", "roads.superelevation"}},
    {"design/join_check.cpp", {"roads.predecessor"}},
    {"design/road_fit.cpp", {"roads."}},
    {"design/road_reader.cpp", {"roads.", "roads.place", "roads.speed_limits", "roads.points"}},
    {"design/section_reader.cpp", {"roads.", "roads.section"}},
    {"design/standing_reader.cpp", {".", "objects"}},
    {"design/tables.cpp", {"roads"}},
    {"road/picture_reader.cpp", {"terrain", "ground"}},
    {"road/world_reader.cpp", {".", "terrain", "ground", "friction", "network", "start", "weather"}},
    {"weather/weather_plan.cpp", {"weather"}},
    {"lights/light_plan.cpp", {"junctions.lights"}},
};

// What the readers of version 2 ask for, as it stands in the program: of each file the keys. What is a scenario's alone
// is left out.
std::map<std::string, std::set<std::string>> AskedKeys() {
  const std::regex asked(
      R"re((?:Number|Integer|Flag|Text|Choice|Path|OptionalPath|Child|OptionalChild|Items|OptionalItems|MaterialOf|Has)\(\s*(?:[a-z_]+,\s*)?"([a-z_0-9]+)")re");
  const std::regex tables(R"re(Read(?:Table|Knots)\([^"]*"([a-z_]+)",\s*"([a-z_]+)"(?:,\s*"([a-z_]+)")?)re");
  std::vector<std::string> files = {"road/world_reader.cpp", "road/picture_reader.cpp", "lights/light_plan.cpp"};
  for (const auto& entry : fs::directory_iterator(kRoot / "common/world/design")) {
    if (entry.path().extension() == ".cpp") files.push_back("design/" + entry.path().filename().string());
  }
  std::map<std::string, std::set<std::string>> keys;
  for (const std::string& file : files) {
    const std::string text = base::ReadText(kRoot / "common/world" / file).value();
    std::set<std::string> of;
    for (std::sregex_iterator i(text.begin(), text.end(), asked), end; i != end; ++i) of.insert((*i)[1]);
    for (std::sregex_iterator i(text.begin(), text.end(), tables), end; i != end; ++i) {
      for (std::size_t k = 1; k <= 3; ++k) {
        if ((*i)[k].matched) of.insert((*i)[k]);
      }
    }
    if (!of.empty()) keys[file] = std::move(of);
  }
  return keys;
}

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

// The words of what stands between backticks, or in a block of code.
std::set<std::string> WordsInCode(const std::string& text) {
  std::set<std::string> words;
  bool code = false;
  std::string word;
  for (const char c : text) {
    if (std::islower(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)) || c == '_') {
      word += c;
      continue;
    }
    if (code && !word.empty()) words.insert(word);
    word.clear();
    if (c == '`') code = !code;  // three of them are as good as one
  }
  return words;
}

TEST(ExampleWorld, SaysEveryKeyAndTheDocumentTellsOfIt) {
  std::set<std::pair<std::string, std::string>> said;
  for (const char* file : {"world.yaml", "village.yaml", "plane.yaml", "heights.yaml", "named.yaml"})
    Collect(YAML::LoadFile((kRoot / "configs/worlds/example" / file).string()), "", said);
  std::set<std::string> told;
  for (const char* page : {"world-files.md", "world-roads.md"})
    told.merge(WordsInCode(base::ReadText(kRoot / "docs/reference" / page).value()));
  std::size_t count = 0;
  for (const auto& [file, keys] : AskedKeys()) {
    ASSERT_TRUE(kPlaces.contains(file)) << file << " asks for keys: where do they stand?";
    const auto is_said = [&](const std::string& key) {
      return std::any_of(said.begin(), said.end(), [&, &places = kPlaces.at(file)](const auto& there) {
        if (there.second != key) return false;
        return std::any_of(places.begin(), places.end(), [&](const std::string& place) {
          if (place.back() == '.') return there.first == place.substr(0, place.size() - 1);
          return there.first == place || there.first.starts_with(place + ".");
        });
      });
    };
    for (const std::string& key : keys) {
      ++count;
      EXPECT_TRUE(is_said(key)) << "the examples do not say " << key << ", which " << file << " asks for";
      EXPECT_TRUE(told.contains(key)) << "docs/reference/world-*.md do not tell of " << key << ", which " << file
                                      << " asks for";
    }
  }
  EXPECT_GT(count, 150u);
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
  const std::string reader = base::ReadText(kRoot / "common/world/design/object_reader.cpp").value();
  const std::regex row(R"re(\{"([a-z_]+)",\s*"[a-z]+",\s*[0-9.]+,\s)re");
  int types = 0;
  for (std::sregex_iterator i(reader.begin(), reader.end(), row), end; i != end; ++i, ++types)
    EXPECT_NE(example.find("type: " + (*i)[1].str() + ","), std::string::npos) << (*i)[1];
  EXPECT_GE(types, 8);
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
