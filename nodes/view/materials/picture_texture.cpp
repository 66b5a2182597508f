// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/materials/picture_texture.hpp"

#include <algorithm>

#include "common/world/terrain/picture_file.hpp"

namespace rodeira::nodes {

base::Result<osg::ref_ptr<osg::Texture2D>> MakePictureTexture(const std::string& file, bool repeats) {
  const auto picture = terrain::ReadPicture(file);
  if (!picture) return picture.error();
  const auto& [width, height, rgb] = picture.value();
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(width, height, 1, GL_RGB, GL_UNSIGNED_BYTE);
  const std::size_t row = 3 * static_cast<std::size_t>(width);
  for (int y = 0; y < height; ++y) {  // from below, as OpenGL has them
    std::copy_n(rgb.data() + static_cast<std::size_t>(height - 1 - y) * row, row,
                image->data(0, static_cast<unsigned>(y)));
  }
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setResizeNonPowerOfTwoHint(false);
  const auto wrap = repeats ? osg::Texture::REPEAT : osg::Texture::CLAMP_TO_EDGE;
  texture->setWrap(osg::Texture::WRAP_S, wrap);
  texture->setWrap(osg::Texture::WRAP_T, wrap);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  return texture;
}

osg::ref_ptr<osg::Image> NoPicture() {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
  return image;
}

}  // namespace rodeira::nodes
