// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/runtime/launch/kinds.hpp"
#include "idl/topic_table.hpp"

namespace rodeira::launch {

// The manifest of a node outside Rodeira (docs/reference/launch-files.md): its ports, its period, and the topics that
// it adds.
struct Manifest {
  NodeKind kind;                          // named kExternalKind; its program is empty
  std::vector<idl::AddedTopic> topics;    // of the outputs that are not Rodeira's
  std::vector<std::string> topic_places;  // FILE:LINE of each
  std::vector<std::string> input_places;  // FILE:LINE of each of kind.inputs
};

// Reads a manifest and the IDL that it names. Wrong input is one sentence with FILE:LINE: a key that is missing or
// unknown, another version, a topic that cannot be published, IDL that cannot be read, a type that is not in it, a type
// without the sample header as its first member. CheckInputs looks up the topics of the inputs, since another manifest
// may add them.
base::Result<Manifest> ReadManifest(const std::filesystem::path& path);

// Wrong input, with the nearest name, for an input with an unknown topic: Rodeira and the manifests of the launch lack
// it.
base::Status CheckInputs(const Manifest& manifest, const idl::TopicTable& topics);

}  // namespace rodeira::launch
