// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Array>
#include <osg/Texture2D>
#include <osg/ref_ptr>

#include <string>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/raster/canvas.hpp"

namespace rodeira::nodes {

// The picture of a sign's face (scene::DrawFace).
osg::ref_ptr<osg::Image> MakeFaceImage(const std::string& face);
// The same to be drawn at any distance.
osg::ref_ptr<osg::Texture2D> MakeFaceTexture(const std::string& face);
// Rows from below, as the raster has them.
osg::ref_ptr<osg::Texture2D> MakeTexture(const scene::Raster& picture);
// Where on the face each vertex of a mesh of kSign or kPicture lies.
osg::ref_ptr<osg::Vec2Array> PlacesOnFace(const scene::Mesh& mesh);

}  // namespace rodeira::nodes
