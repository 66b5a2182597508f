// SPDX-License-Identifier: Apache-2.0
// A module includes only what cmake/layers.txt allows; the same table governs the link lines.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tree.hpp"

namespace {

namespace fs = std::filesystem;

// cmake/layers.txt: the groups that a group may use, and inside its group the modules that a module may use.
struct Layers {
  std::map<std::string, std::set<std::string>> groups;
  std::map<std::string, std::set<std::string>> modules;
};

Layers ReadLayers(const fs::path& path) {
  Layers layers;
  auto* section = &layers.groups;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (line == "[groups]") section = &layers.groups;
    if (line == "[modules]") section = &layers.modules;
    const auto colon = line.find(':');
    if (line.empty() || line[0] == '#' || colon == std::string::npos) continue;
    auto& allowed = (*section)[line.substr(0, colon)];
    std::istringstream words(line.substr(colon + 1));
    for (std::string word; words >> word;) allowed.insert(word);
  }
  return layers;
}

// The first `count` parts of a path: "common/core" of "common/core/base/hash.hpp" and 2.
std::string FirstParts(const fs::path& path, int count) {
  fs::path parts;
  for (auto part = path.begin(); part != path.end() && count > 0; ++part, --count) parts /= *part;
  return parts.string();
}

// "common/core/base/hash.hpp" belongs to the group "common/core", "nodes/view/main.cpp" to "nodes/view", "idl/x.hpp" to
// "idl".
std::string GroupOf(const fs::path& relative) {
  const std::string top = FirstParts(relative, 1);
  return FirstParts(relative, top == "idl" || top == "launch" ? 1 : 2);
}

// "base" of "common/core/base/hash.hpp"; of a file that lies in the group's own folder the file's name.
std::string ModuleOf(const fs::path& relative) { return fs::path(FirstParts(relative, 3)).filename().string(); }

// What a line includes, by quotes or angle brackets; nothing where it includes nothing.
std::optional<std::string> IncludedBy(std::string_view line) {
  const auto skip = [&line](std::string_view what) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (!line.starts_with(what)) return false;
    line.remove_prefix(what.size());
    return true;
  };
  if (!skip("#") || !skip("include")) return std::nullopt;
  const bool angle = skip("<");
  if (!angle && !skip("\"")) return std::nullopt;
  const auto end = line.find(angle ? '>' : '"');
  if (end == std::string_view::npos) return std::nullopt;
  return std::string(line.substr(0, end));
}

bool IsOurs(const std::string& included) {
  for (const char* top : {"common/", "nodes/", "idl/", "launch/"}) {
    if (included.starts_with(top)) return true;
  }
  return false;
}

bool IsSource(const fs::path& path) { return path.extension() == ".hpp" || path.extension() == ".cpp"; }

// Why `from` may not include `used`; nothing where it may.
std::optional<std::string> Forbidden(const fs::path& from, const fs::path& used, const Layers& layers) {
  const std::string group = GroupOf(from);
  const auto groups = layers.groups.find(group);
  if (groups == layers.groups.end()) return "cmake/layers.txt has no group " + group;
  if (groups->second.contains("*")) return std::nullopt;
  if (group != GroupOf(used)) {
    // Of the nodes only main.cpp includes the bus.
    if (group.starts_with("nodes/") && FirstParts(used, 3) == "common/runtime/dds" && from.filename() != "main.cpp") {
      return "only a node's main.cpp may include common/runtime/dds";
    }
    if (groups->second.contains(GroupOf(used))) return std::nullopt;
    return group + " may not include " + GroupOf(used);
  }
  const auto modules = layers.modules.find(FirstParts(from, 3));
  if (!group.starts_with("common/") || ModuleOf(from) == ModuleOf(used)) return std::nullopt;
  if (modules == layers.modules.end()) {
    // A group of one module (common/traffic) has its files in its own folder, or in folders by subject.
    const bool listed = std::any_of(layers.modules.begin(), layers.modules.end(),
                                    [&group](const auto& module) { return module.first.starts_with(group + "/"); });
    if (!listed) return std::nullopt;
    return "cmake/layers.txt has no module " + FirstParts(from, 3);
  }
  if (modules->second.contains(ModuleOf(used))) return std::nullopt;
  return FirstParts(from, 3) + " may not include " + FirstParts(used, 3);
}

// `includes`: how many includes of the project's own headers were looked at.
std::vector<std::string> Violations(const fs::path& root, const Layers& layers, std::size_t& includes) {
  std::vector<std::string> violations;
  for (const char* top : {"common", "nodes", "idl", "launch"}) {
    if (!fs::exists(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
      const fs::path relative = entry.path().lexically_relative(root);
      std::ifstream in(entry.path());
      int number = 0;
      for (std::string line; std::getline(in, line);) {
        ++number;
        const auto included = IncludedBy(line);
        if (!included || !IsOurs(*included)) continue;
        ++includes;
        const auto why = Forbidden(relative, *included, layers);
        if (why) violations.push_back(relative.string() + ":" + std::to_string(number) + ": " + *why);
      }
    }
  }
  return violations;
}

// Whether every name of the table's right side has a line of its own above it: then nothing depends on itself.
std::vector<std::string> OutOfOrder(const std::map<std::string, std::set<std::string>>& uses, bool modules) {
  std::set<std::string> done;
  for (bool moved = true; moved;) {
    moved = false;
    for (const auto& [name, used] : uses) {
      if (done.contains(name)) continue;
      const std::string prefix = modules ? FirstParts(name, 2) + "/" : "";
      const bool ready = std::all_of(used.begin(), used.end(),
                                     [&](const std::string& other) { return done.contains(prefix + other); });
      if (ready) moved = done.insert(name).second || moved;
    }
  }
  std::vector<std::string> left;
  for (const auto& [name, used] : uses) {
    if (!done.contains(name) && !used.contains("*")) left.push_back(name);
  }
  return left;
}

const fs::path kRoot = rodeira::SourceDir();

TEST(Architecture, DependenciesGoDownwardOnly) {
  std::size_t includes = 0;
  EXPECT_EQ(Violations(kRoot, ReadLayers(kRoot / "cmake/layers.txt"), includes), std::vector<std::string>{});
  EXPECT_GT(includes, 4000U);
}

TEST(Architecture, ForbiddenIncludeIsFound) {
  const fs::path root = fs::temp_directory_path() / ("rodeira-architecture-" + std::to_string(::getpid()));
  for (const char* folder :
       {"common/core/base", "common/core/config", "common/core/new", "common/traffic", "nodes/clock"}) {
    fs::create_directories(root / folder);
  }
  std::ofstream(root / "common/core/base/a.hpp")
      << "#include \"common/world/road/road.hpp\"\n#include \"common/core/config/b.hpp\"\n";
  std::ofstream(root / "common/core/config/b.hpp") << "#include \"common/core/base/a.hpp\"\n";
  std::ofstream(root / "common/core/new/c.hpp") << "#include \"common/core/base/a.hpp\"\n";
  std::ofstream(root / "common/traffic/d.hpp") << "#include \"common/traffic/state/e.hpp\"\n";
  std::ofstream(root / "nodes/clock/clock_node.cpp")
      << "#include \"common/core/base/a.hpp\"\n#include \"common/runtime/dds/bus.hpp\"\n";
  std::ofstream(root / "nodes/clock/main.cpp") << "#include \"common/runtime/dds/bus.hpp\"\n";
  const Layers layers{
      {{"common/core", {}}, {"common/traffic", {"common/core"}}, {"nodes/clock", {"common/core", "common/runtime"}}},
      {{"common/core/base", {}}, {"common/core/config", {"base"}}}};
  std::size_t includes = 0;
  auto violations = Violations(root, layers, includes);
  EXPECT_EQ(includes, 8U);
  std::sort(violations.begin(), violations.end());
  EXPECT_EQ(violations, (std::vector<std::string>{
                            "common/core/base/a.hpp:1: common/core may not include common/world",
                            "common/core/base/a.hpp:2: common/core/base may not include common/core/config",
                            "common/core/new/c.hpp:1: cmake/layers.txt has no module common/core/new",
                            "nodes/clock/clock_node.cpp:2: only a node's main.cpp may include common/runtime/dds",
                        }));
  fs::remove_all(root);
}

TEST(Architecture, IncludeIsFoundWithAnySpacing) {
  EXPECT_EQ(IncludedBy("#include \"common/a.hpp\""), "common/a.hpp");
  EXPECT_EQ(IncludedBy(" \t# \tinclude  <fastdds/dds/core.hpp>  // why"), "fastdds/dds/core.hpp");
  for (const char* line :
       {"", "#", "  // #include <a>", "#include", "#include \"open", "#define include <a>", "include <a>"})
    EXPECT_EQ(IncludedBy(line), std::nullopt) << line;
}

TEST(Architecture, NothingDependsOnItself) {
  const Layers layers = ReadLayers(kRoot / "cmake/layers.txt");
  EXPECT_GT(layers.groups.size(), 10u);
  EXPECT_GT(layers.modules.size(), 20u);
  EXPECT_EQ(OutOfOrder(layers.groups, false), std::vector<std::string>{});
  EXPECT_EQ(OutOfOrder(layers.modules, true), std::vector<std::string>{});
  EXPECT_EQ(OutOfOrder({{"a", {"b"}}, {"b", {"a"}}, {"c", {}}}, false), (std::vector<std::string>{"a", "b"}));
}

// What cmake/layers.txt names is there: a group or module that went away leaves no line behind.
TEST(Architecture, EveryNameOfTheTableIsAFolder) {
  const Layers layers = ReadLayers(kRoot / "cmake/layers.txt");
  for (const auto* section : {&layers.groups, &layers.modules}) {
    ASSERT_FALSE(section->empty());
    for (const auto& [name, uses] : *section) EXPECT_TRUE(fs::is_directory(kRoot / name)) << name;
  }
}

TEST(Architecture, NoFileHoldsMergeConflictMarkers) {
  std::size_t files = 0, lines = 0;
  for (const char* top : {"cmake", "common", "configs", "docs", "idl", "launch", "nodes", "tests", "tools"}) {
    for (auto entry = fs::recursive_directory_iterator(kRoot / top); entry != fs::recursive_directory_iterator();
         ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (!entry->is_regular_file()) continue;
      ++files;
      std::ifstream in(entry->path());
      for (std::string line; std::getline(in, line); ++lines)
        EXPECT_FALSE(line.starts_with("<<<<"
                                      "<<< ") ||
                     line.starts_with(">>>>"
                                      ">>> "))
            << entry->path() << ": " << line;
    }
  }
  EXPECT_GT(files, 2500U);
  EXPECT_GT(lines, 200'000U);
}

TEST(Architecture, EverySourceNamesItsLicence) {
  std::size_t sources = 0;
  for (const char* top : {"common", "nodes", "idl", "launch", "tests", "tools", "cmake"}) {
    for (auto entry = fs::recursive_directory_iterator(kRoot / top); entry != fs::recursive_directory_iterator();
         ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      const fs::path& path = entry->path();
      const bool is_build_file = path.filename() == "CMakeLists.txt" || path.extension() == ".cmake";
      if (!entry->is_regular_file() || !(IsSource(path) || is_build_file || path.extension() == ".py")) continue;
      ++sources;
      std::ifstream in(path);
      std::string first, second;
      std::getline(in, first);
      std::getline(in, second);
      EXPECT_TRUE((first + second).find("SPDX-License-Identifier: Apache-2.0") != std::string::npos) << path;
    }
  }
  EXPECT_GT(sources, 2500U);
}

TEST(Architecture, OnlyTheDdsModuleIncludesFastDds) {
  std::size_t sources = 0;
  for (const char* top : {"common", "nodes", "launch"}) {
    if (!fs::exists(kRoot / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
      if (entry.path().string().find("/common/runtime/dds/") != std::string::npos) continue;
      ++sources;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        const std::string included = IncludedBy(line).value_or("");
        EXPECT_FALSE(included.starts_with("fastdds/") || included.starts_with("fastrtps/"))
            << entry.path() << ": " << line;
      }
    }
  }
  EXPECT_GT(sources, 1000U);
}

}  // namespace
