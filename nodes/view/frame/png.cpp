// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/frame/png.hpp"

#include <png.h>

#include <cstring>

#include "common/core/base/files.hpp"

namespace rodeira::nodes {

base::Status WritePng(const std::filesystem::path& path, const Image& image) {
  png_image header;
  std::memset(&header, 0, sizeof(header));
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width_px);
  header.height = static_cast<png_uint_32>(image.height_px);
  header.format = PNG_FORMAT_RGB;
  header.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  base::Bytes bytes(size);
  if (png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgb.data(), 0, nullptr) == 0) {
    return base::Failed("file.cannot_write",
                        std::string("the picture cannot be made into a PNG file: ") + header.message, path.string());
  }
  bytes.resize(size);
  return base::WriteWhole(path, bytes);
}

}  // namespace rodeira::nodes
