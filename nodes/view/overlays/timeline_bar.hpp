// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Group>
#include <osgText/Text>

#include "nodes/view/frame/picture.hpp"
#include "nodes/view/overlays/overlay.hpp"

namespace rodeira::nodes {

// Where on a picture the bar of a recording's time lies, in the panels' units from the picture's left and lower edge.
struct TimelinePlace {
  static constexpr float kHeight = 62.0F;
  static constexpr float kMargin = 18.0F;
  static constexpr float kTrackLow = 14.0F, kTrackHigh = 22.0F;

  explicit TimelinePlace(const PanelSize& size) : scale(size.scale), width(size.width) {}
  float scale, width;

  // From 0 to 1 along the run.
  float XOf(double share) const { return kMargin + static_cast<float>(share) * (width - 2.0F * kMargin); }
  // At a pixel.
  double ShareAt(double x_px) const;
  // Whether a place so many pixels above the lower edge is on the bar.
  bool Holds(double height_px) const { return height_px >= 0.0 && height_px < static_cast<double>(scale * kHeight); }
};

// That bar: the way done, marks, and what is said over it.
class TimelineBar {
 public:
  explicit TimelineBar(osg::Group& overlay);
  // Nothing: the bar is not drawn.
  void Show(const std::optional<Timeline>& timeline, const PanelSize& size);

 private:
  Boxes ground_, track_, done_, events_, marks_, knob_;
  osg::ref_ptr<osgText::Text> where_, note_, keys_;
};

}  // namespace rodeira::nodes
