// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "common/core/base/result.hpp"
#include "nodes/view/frame/picture.hpp"

namespace rodeira::nodes {

// Writes the image as a PNG file: whole or not at all.
base::Status WritePng(const std::filesystem::path& path, const Image& image);

}  // namespace rodeira::nodes
