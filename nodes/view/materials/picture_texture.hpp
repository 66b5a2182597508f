// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Texture2D>
#include <osg/ref_ptr>

#include <string>

#include "common/core/base/result.hpp"

namespace rodeira::nodes {

// A picture that lies on the ground, to be drawn at any distance. Wrong input where it cannot be read.
base::Result<osg::ref_ptr<osg::Texture2D>> MakePictureTexture(const std::string& file, bool repeats);

// One pixel, where an image is wanted with its pixels elsewhere.
osg::ref_ptr<osg::Image> NoPicture();

}  // namespace rodeira::nodes
