#pragma once

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/ref_ptr>
#include <osgText/Text>

#include <vector>

namespace rodeira::view {

// What lies flat over a picture, in pixels from its lower left corner. The typeface is OpenSceneGraph's own: no file is needed.

osg::ref_ptr<osg::Camera> MakeOverlay();
void FitOverlay(osg::Camera& overlay, int width_px, int height_px);
// White, to be placed and filled later; over the boxes.
osg::ref_ptr<osgText::Text> AddText(osg::Group& overlay, float size_px, osgText::TextBase::AlignmentType alignment);
// Upright boxes of one colour.
class Boxes {
 public:
  struct Box {
    float left = 0.0F, low = 0.0F, right = 0.0F, high = 0.0F;
  };
  // Those of a higher layer lie over those of a lower one.
  Boxes(osg::Group& overlay, const osg::Vec4& colour, int layer = 0);
  void Set(const std::vector<Box>& boxes);  // none: nothing is drawn

 private:
  osg::ref_ptr<osg::Vec3Array> corners_;
  osg::ref_ptr<osg::DrawArrays> triangles_;
  osg::ref_ptr<osg::Geometry> geometry_;
};

}  // namespace rodeira::view
