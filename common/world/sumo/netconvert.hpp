// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "common/core/base/result.hpp"
#include "common/world/sumo/unpack.hpp"

namespace rodeira::sumo {

// The same network twice.
struct Converted {
  std::filesystem::path net;    // SUMO's own
  std::filesystem::path drive;  // OpenDRIVE
};

// Has SUMO's netconvert read `file` and write both files into `folder`. Of a map, it keeps the roads that cars use.
// Classes of vehicles that this netconvert does not know are taken out of `file`, a network. `said`: the file's name
// for messages. Wrong input where netconvert or its road types are missing, or it refuses the file; failed where it
// takes longer than half an hour or `stop` says so.
base::Result<Converted> RunNetconvert(const std::filesystem::path& file, SourceKind kind,
                                      const std::filesystem::path& folder, const std::string& said,
                                      const std::function<bool()>& stop);

}  // namespace rodeira::sumo
