#include "nodes/view/find_built.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "common/base/files.hpp"
#include "common/scene/seen_digest.hpp"
#include "nodes/view/database.hpp"

namespace rodeira::view {
namespace {

namespace fs = std::filesystem;

struct Listed {
  base::Digest hash = 0;
  std::string name;
};

struct Contents {
  std::string seen;
  std::vector<Listed> files;
};

Contents ReadContents(const fs::path& manifest) {
  Contents contents;
  std::ifstream file(manifest);
  constexpr std::string_view kSeen = "# seen: ";
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(kSeen)) contents.seen = line.substr(kSeen.size());
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    Listed listed;
    base::Digest source = 0;
    if (words >> std::hex >> listed.hash >> source >> listed.name) contents.files.push_back(std::move(listed));
  }
  return contents;
}

// The first file that is not as it was written; empty: all are.
std::string FirstChanged(const fs::path& folder, const Contents& contents) {
  bool root = false;
  for (const Listed& listed : contents.files) {
    const auto bytes = base::ReadText(folder / listed.name);
    if (!bytes || base::Hash(bytes.value()) != listed.hash) return listed.name;
    root = root || listed.name == "world.osgb";
  }
  return root ? "" : "world.osgb";
}

}  // namespace

FoundBuilt FindBuilt(const fs::path& world_file, const road::World& world) {
  FoundBuilt found;
  if (world_file.empty() || !world.roads().empty()) return found;
  std::string seen;
  for (const fs::path& folder : {world_file.parent_path(), world_file.parent_path() / world_file.stem()}) {
    std::error_code problem;
    const fs::path manifest = folder / kManifest;
    if (!fs::is_regular_file(manifest, problem)) continue;
    if (seen.empty()) seen = base::Hex(scene::SeenDigest(world));
    const Contents contents = ReadContents(manifest);
    std::string why;
    if (contents.seen != seen) why = "it was built from another world, or by another version of the program";
    else if (const std::string changed = FirstChanged(folder, contents); !changed.empty()) why = fmt::format("its file '{}' is not as it was written", changed);
    if (why.empty()) return {folder, ""};
    found.remark = fmt::format("{}: the built database is not shown: {}; `rodeira world build` renews it", manifest.string(), why);
  }
  return found;
}

}  // namespace rodeira::view
