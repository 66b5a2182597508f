#pragma once

#include <filesystem>

#include "common/base/result.hpp"
#include "nodes/view/picture.hpp"

namespace rodeira::view {

// Writes the image as a PNG file: whole or not at all.
base::Status WritePng(const std::filesystem::path& path, const Image& image);

}  // namespace rodeira::view
