#pragma once

#include <osg/Group>
#include <osgText/Text>

#include "nodes/view/overlay.hpp"
#include "nodes/view/picture.hpp"

namespace rodeira::view {

// Speed, gear and time in the lower right corner of an overlay, and lines of text in its upper left one.
class Instruments {
 public:
  explicit Instruments(osg::Group& overlay);
  // `low_px`: how much at the bottom is taken by something else.
  void Show(const Picture& picture, int width_px, int height_px, float low_px);

 private:
  Boxes panel_;
  osg::ref_ptr<osgText::Text> speed_, unit_, gear_, time_, lines_;
};

}  // namespace rodeira::view
