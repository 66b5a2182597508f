// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/visual_database/find_built.hpp"

#include <fmt/format.h>

#include "common/core/base/files.hpp"
#include "common/view/scene/visual_world/seen_digest.hpp"
#include "common/world/road/visual_files.hpp"

namespace rodeira::nodes {
namespace {

namespace fs = std::filesystem;

// The first file that is not as it was written; empty: all are.
std::string FirstChanged(const fs::path& folder, const road::VisualContents& contents) {
  bool root = false;
  for (const road::VisualContents::Listed& listed : contents.files) {
    const auto bytes = base::ReadText(folder / listed.name, 1u << 30);
    if (!bytes || base::Hash(bytes.value()) != listed.hash) return listed.name;
    root = root || listed.name == "world.osgb";
  }
  return root ? "" : "world.osgb";
}

}  // namespace

FoundBuilt FindBuilt(const fs::path& world_file, const road::World& world) {
  FoundBuilt found;
  if (world_file.empty()) return found;
  std::string seen;
  for (const fs::path& folder : {world_file.parent_path(), world_file.parent_path() / world_file.stem()}) {
    std::error_code problem;
    const fs::path manifest = folder / road::kVisualManifest;
    if (!fs::is_regular_file(manifest, problem)) continue;
    if (seen.empty()) seen = base::Hex(scene::SeenDigest(world));
    const road::VisualContents contents = road::ReadVisualContents(manifest);
    std::string why;
    if (contents.seen != seen)
      why = "it was built from another world, or by another version of the program";
    else if (!contents.broken.empty())
      why = fmt::format("its line '{}' names no file with its hash", contents.broken.front());
    else if (const std::string changed = FirstChanged(folder, contents); !changed.empty())
      why = fmt::format("its file '{}' is not as it was written", changed);
    if (why.empty()) return {folder, ""};
    found.remark =
        fmt::format("{}: the built database is not shown: {}; `rodeira world build` renews it", manifest.string(), why);
  }
  return found;
}

}  // namespace rodeira::nodes
