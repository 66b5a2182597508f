// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/ref_ptr>
#include <osgText/Text>

#include <vector>

namespace rodeira::nodes {

// What lies flat over a picture, in pixels from its lower left corner. The typeface is DejaVu Sans where it is
// installed, otherwise OpenSceneGraph's own.

osg::ref_ptr<osg::Camera> MakeOverlay();
// To a picture of this size, whenever the size has changed.
void FitOverlay(osg::Camera& overlay, int width_px, int height_px);
// Panels keep their share of a picture: they are laid out in units of which a picture has 720 from below to above, more
// where it is narrower than it is high by 4 : 3, and at most twice as many as it has pixels, so that letters can be
// read.
struct PanelSize {
  float scale = 1.0F;                 // pixels a unit
  float width = 0.0F, height = 0.0F;  // of the picture, in units
};
// Of a picture of this size, both over 0.
PanelSize PanelsOf(int width_px, int height_px);
// White, to be placed and filled later; over the boxes.
osg::ref_ptr<osgText::Text> AddText(osg::Group& overlay, float size_px, osgText::TextBase::AlignmentType alignment);
// Upright boxes of one colour.
class Boxes {
 public:
  // Edges, from the lower left corner of what the overlay lies over.
  struct Box {
    float left = 0.0F, low = 0.0F, right = 0.0F, high = 0.0F;

    bool operator==(const Box&) const = default;
  };
  // Those of a higher layer lie over those of a lower one.
  Boxes(osg::Group& overlay, const osg::Vec4& colour, int layer = 0);
  void Set(const std::vector<Box>& boxes);  // none: nothing is drawn

 private:
  osg::ref_ptr<osg::Vec3Array> corners_;
  osg::ref_ptr<osg::DrawArrays> triangles_;
  osg::ref_ptr<osg::Geometry> geometry_;
};

}  // namespace rodeira::nodes
