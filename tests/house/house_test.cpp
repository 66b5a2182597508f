// The house holds: a room includes only what cmake/layers.txt lets it, the same table that governs the link lines.
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
using Layers = std::map<std::string, std::set<std::string>>;

Layers ReadLayers(const fs::path& path) {
  Layers layers;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(':');
    if (line.empty() || line[0] == '#' || colon == std::string::npos) continue;
    auto& allowed = layers[line.substr(0, colon)];
    std::istringstream words(line.substr(colon + 1));
    for (std::string word; words >> word;) allowed.insert(word);
  }
  return layers;
}

// "common/base/hash.hpp" lies in the room "common/base", "idl/x.hpp" in "idl".
std::string RoomOf(const fs::path& relative) {
  auto part = relative.begin();
  const std::string first = part->string();
  if (first == "idl" || first == "launch") return first;
  ++part;
  return first + "/" + part->string();
}

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

std::vector<std::string> Violations(const fs::path& root, const Layers& layers) {
  std::vector<std::string> violations;
  for (const char* top : {"common", "nodes", "idl", "launch"}) {
    if (!fs::exists(root / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
      const fs::path relative = entry.path().lexically_relative(root);
      const std::string room = RoomOf(relative);
      const auto found = layers.find(room);
      if (found == layers.end()) {
        violations.push_back(relative.string() + ": the room " + room + " is not in cmake/layers.txt");
        continue;
      }
      // A node's main.cpp, and only that, may use the DDS bus.
      std::set<std::string> allowed = found->second;
      if (relative.filename() == "main.cpp") allowed.insert("common/dds");
      std::ifstream in(entry.path());
      int number = 0;
      for (std::string line; std::getline(in, line);) {
        ++number;
        const auto included = IncludedBy(line);
        if (!included || !IsOurs(*included)) continue;
        const std::string used = RoomOf(*included);
        if (used != room && !allowed.contains(used) && !allowed.contains("*")) {
          violations.push_back(relative.string() + ":" + std::to_string(number) + ": " + room + " may not include " + used);
        }
      }
    }
  }
  return violations;
}

const fs::path kRoot = rodeira::SourceDir();

TEST(House, DependenciesGoDownwardOnly) {
  EXPECT_EQ(Violations(kRoot, ReadLayers(kRoot / "cmake/layers.txt")), std::vector<std::string>{});
}

TEST(House, AForbiddenIncludeIsFound) {
  const fs::path root = fs::temp_directory_path() / ("rodeira-house-" + std::to_string(::getpid()));
  fs::create_directories(root / "common/base");
  fs::create_directories(root / "nodes/clock");
  std::ofstream(root / "common/base/a.hpp") << "#include \"common/road/road.hpp\"\n";
  std::ofstream(root / "nodes/clock/clock_node.cpp") << "#include \"common/base/a.hpp\"\n#include \"common/dds/bus.hpp\"\n";
  std::ofstream(root / "nodes/clock/main.cpp") << "#include \"common/dds/bus.hpp\"\n";
  const Layers layers{{"common/base", {}}, {"nodes/clock", {"common/base"}}};
  EXPECT_EQ(Violations(root, layers), (std::vector<std::string>{
                                          "common/base/a.hpp:1: common/base may not include common/road",
                                          "nodes/clock/clock_node.cpp:2: nodes/clock may not include common/dds",
                                      }));
  fs::remove_all(root);
}

TEST(House, AnIncludeIsSeenHoweverItIsSpaced) {
  EXPECT_EQ(IncludedBy("#include \"common/a.hpp\""), "common/a.hpp");
  EXPECT_EQ(IncludedBy(" \t# \tinclude  <fastdds/dds/core.hpp>  // why"), "fastdds/dds/core.hpp");
  for (const char* line : {"", "#", "  // #include <a>", "#include", "#include \"open", "#define include <a>", "include <a>"}) EXPECT_EQ(IncludedBy(line), std::nullopt) << line;
}

TEST(House, TheTableHasNoCircle) {
  const Layers layers = ReadLayers(kRoot / "cmake/layers.txt");
  std::set<std::string> done;
  for (bool moved = true; moved;) {
    moved = false;
    for (const auto& [room, uses] : layers) {
      if (done.contains(room) || uses.contains("*")) continue;
      bool ready = true;
      for (const auto& used : uses) ready = ready && done.contains(used);
      if (ready) moved = done.insert(room).second || moved;
    }
  }
  EXPECT_EQ(done.size() + 1, layers.size()) << "a room uses itself by way of others, or one that the table does not name";
}

TEST(House, NoFileHoldsBothSidesOfAMerge) {
  for (const char* top : {"cmake", "common", "configs", "docs", "idl", "launch", "nodes", "tests", "tools"}) {
    for (auto entry = fs::recursive_directory_iterator(kRoot / top); entry != fs::recursive_directory_iterator(); ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (!entry->is_regular_file()) continue;
      std::ifstream in(entry->path());
      for (std::string line; std::getline(in, line);) EXPECT_FALSE(line.starts_with("<<<<" "<<< ") || line.starts_with(">>>>" ">>> ")) << entry->path() << ": " << line;
    }
  }
}

TEST(House, OnlyTheDdsRoomKnowsFastDds) {
  for (const char* top : {"common", "nodes", "launch"}) {
    if (!fs::exists(kRoot / top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top)) {
      if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
      if (entry.path().string().find("/common/dds/") != std::string::npos) continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        const std::string included = IncludedBy(line).value_or("");
        EXPECT_FALSE(included.starts_with("fastdds/") || included.starts_with("fastrtps/")) << entry.path() << ": " << line;
      }
    }
  }
}

}  // namespace
