#pragma once

#include <osg/Group>
#include <osgText/Text>

#include "nodes/view/overlay.hpp"
#include "nodes/view/picture.hpp"

namespace rodeira::view {

// Speed, gear and time in the lower right corner of an overlay, lines of text in its upper left one, and those about a chosen vehicle in the lower left one.
class Instruments {
 public:
  explicit Instruments(osg::Group& overlay);
  // `low_px`: how much at the bottom is taken by something else.
  void Show(const Picture& picture, int width_px, int height_px, float low_px);

 private:
  Boxes panel_, about_box_;
  osg::ref_ptr<osgText::Text> speed_, unit_, gear_, time_, lines_, about_;
};

}  // namespace rodeira::view
