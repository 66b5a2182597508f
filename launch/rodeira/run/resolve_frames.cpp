// SPDX-License-Identifier: Apache-2.0
#include "launch/rodeira/run/resolve_frames.hpp"

#include <filesystem>
#include <vector>

#include "common/core/config/quoted.hpp"
#include "launch/rodeira/run/resolve_recording.hpp"

namespace rodeira::cli {

void ResolveFrames(const launch::Launch& launch, const Placement& placement, const std::string& recording,
                   launch::Overrides& overrides) {
  std::vector<const launch::LaunchNode*> views;
  for (const launch::LaunchNode& node : launch.nodes()) {
    if (node.kind->name != "view" || !placement.Has(node)) continue;
    const config::Map config = node.config->OptionalChild("config");
    if (config.Has("frames") && !config.Peek({"frames", "folder"})) views.push_back(&node);
  }
  if (views.empty()) return;
  std::filesystem::path file(recording.empty() ? DatedRecording(launch.name()) : recording);
  const std::string stem = file.replace_extension().string() + "-frames";
  for (const launch::LaunchNode* view : views) {
    const std::string folder = views.size() == 1 ? stem : stem + "-" + view->name;
    overrides.emplace_back("nodes." + view->name + ".config.frames.folder", config::Quoted(folder));
  }
}

}  // namespace rodeira::cli
