// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "common/core/base/result.hpp"

namespace rodeira::sumo {

enum class SourceKind { kOpenStreetMap, kNet };

// By the file's name: .osm, .net.xml, both also with .gz, letters of either case. Wrong input: another name.
base::Result<SourceKind> KindOf(const std::filesystem::path& file);

// Copies the file, unpacked where it is gzipped, to `copy`. Wrong input where it is empty, broken, larger than 4 GiB,
// or its outermost element is not that of its kind.
base::Status Unpack(const std::filesystem::path& file, SourceKind kind, const std::filesystem::path& copy);

}  // namespace rodeira::sumo
