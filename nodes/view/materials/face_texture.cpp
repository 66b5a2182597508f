// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/materials/face_texture.hpp"

#include "common/core/base/assert.hpp"
#include "common/view/scene/road_furniture/sign_face.hpp"

namespace rodeira::nodes {

namespace {

osg::ref_ptr<osg::Image> ImageOf(const scene::Raster& raster) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(raster.width_px, raster.height_px, 1, GL_RGB, GL_UNSIGNED_BYTE);
  for (int y = 0; y < raster.height_px; ++y) {
    for (int x = 0; x < raster.width_px; ++x) {
      const scene::Colour colour = raster.At(x, y);
      unsigned char* pixel = image->data(static_cast<unsigned>(x), static_cast<unsigned>(y));
      pixel[0] = colour.red, pixel[1] = colour.green, pixel[2] = colour.blue;
    }
  }
  return image;
}

}  // namespace

osg::ref_ptr<osg::Image> MakeFaceImage(const std::string& face) { return ImageOf(scene::DrawFace(face)); }

osg::ref_ptr<osg::Texture2D> MakeFaceTexture(const std::string& face) { return MakeTexture(scene::DrawFace(face)); }

osg::ref_ptr<osg::Texture2D> MakeTexture(const scene::Raster& picture) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(ImageOf(picture));
  texture->setResizeNonPowerOfTwoHint(false);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::CLAMP_TO_EDGE);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::CLAMP_TO_EDGE);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  texture->setMaxAnisotropy(4.0F);
  return texture;
}

osg::ref_ptr<osg::Vec2Array> PlacesOnFace(const scene::Mesh& mesh) {
  RODEIRA_ASSERT(mesh.on_face.size() == mesh.positions.size());
  osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
  for (const Eigen::Vector2f& p : mesh.on_face) places->push_back({p.x(), p.y()});
  return places;
}

}  // namespace rodeira::nodes
