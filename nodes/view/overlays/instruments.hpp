// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Group>
#include <osgText/Text>

#include "nodes/view/frame/picture.hpp"
#include "nodes/view/overlays/overlay.hpp"

namespace rodeira::nodes {

// Speed, gear and time in the lower right corner of an overlay, lines of text in its upper left one, and those about a
// chosen vehicle in the lower left one.
class Instruments {
 public:
  explicit Instruments(osg::Group& overlay);
  // `low`: how much at the bottom is taken by something else, in the panels' units.
  void Show(const Picture& picture, const PanelSize& size, float low);

 private:
  void ShowLines(const std::string& lines, float high);
  void ShowAbout(const std::string& about, float low);

  Boxes panel_, about_box_, lines_box_;
  osg::ref_ptr<osgText::Text> speed_, unit_, gear_, time_, lines_, about_;
};

}  // namespace rodeira::nodes
