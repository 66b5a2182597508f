// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/node_context.hpp"

// External nodes as shared objects, for runs in one process (docs/how-to/own-node.md).
namespace rodeira::launch {

// What a shared object and the program that loads it must have in common: version, compiler, layout of what passes
// between them. Compiled into each of both.
std::string NodeBuild();

using NodeResult = std::optional<base::Result<std::unique_ptr<lockstep::Node>>>;

// The entry points of a shared object, written by RODEIRA_NODE.
inline constexpr const char* kBuildEntry = "rodeira_node_build";
inline constexpr const char* kMakeEntry = "rodeira_make_node";

// Wrong input if a topic of the node has another type in the IDL that was compiled in than in the manifest.
base::Status CheckCompiledTypes(const NodeContext& context);

// Makes nodes from a shared object, which stays loaded until the process ends. Wrong input if it cannot be loaded, has
// no entry point, or belongs to another build.
base::Result<NodeFactory> LoadNodeLibrary(const std::filesystem::path& path);

// The node as its manifest describes it: one that cannot save its state is told from one that can. Wrong input if the
// manifest lets it save its state and it cannot.
base::Result<std::unique_ptr<lockstep::Node>> AsManifestSays(const NodeKind& kind,
                                                             std::unique_ptr<lockstep::Node> node);

}  // namespace rodeira::launch
