#pragma once

#include <osg/Camera>
#include <osg/ref_ptr>
#include <osgText/Text>

#include "nodes/view/picture.hpp"

namespace rodeira::view {

// Speed, gear and time over the picture, and lines of text. The typeface is OpenSceneGraph's own: no file is needed.
class Instruments {
 public:
  Instruments();
  osg::Node* node() { return camera_; }
  void Show(const Picture& picture, int width_px, int height_px);

 private:
  osg::ref_ptr<osgText::Text> AddText(float size_px, osgText::TextBase::AlignmentType alignment);

  osg::ref_ptr<osg::Camera> camera_;
  osg::ref_ptr<osg::Vec3Array> panel_;
  osg::ref_ptr<osg::Geometry> panel_geometry_;
  osg::ref_ptr<osgText::Text> speed_, unit_, gear_, time_, lines_;
};

}  // namespace rodeira::view
