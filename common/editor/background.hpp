// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "common/core/base/result.hpp"
#include "common/editor/pyramid.hpp"

namespace rodeira::editor {

constexpr int kLargestPicture_px = 16384;  // each way

// The bytes of a picture for a map: those of a PNG or JPEG file as they are, of a BMP or TIFF file a PNG of the same
// pixels, since the original program reads nothing else. Wrong input where it is no picture of these, is broken, or too
// large.
base::Result<std::string> ImportPicture(const std::filesystem::path& path);

// `progress(share)` is told from 0 to 1 and may say false: then there is no picture, and that is the error.
using Progress = std::function<bool(double)>;
// All of it in full size. Wrong input where it is no picture that can be read, or is too large.
base::Result<Pixels> DecodePicture(std::string_view bytes, const Progress& progress = {});

// The same in levels, which are worked out on a second thread while the picture is read. A picture of which a small one
// can be had sooner (JPEG) gives that first, to `preview`: a pyramid without the finer levels.
using Sooner = std::function<void(std::shared_ptr<const Pyramid>)>;
base::Result<std::shared_ptr<const Pyramid>> ReadPyramid(std::string_view bytes, const Progress& progress = {},
                                                         const Sooner& preview = {});

}  // namespace rodeira::editor
