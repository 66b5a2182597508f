#pragma once

#include <osg/Group>
#include <osgText/Text>

#include "nodes/view/overlay.hpp"
#include "nodes/view/picture.hpp"

namespace rodeira::view {

// Where on a picture the bar of a recording's time lies; pixels from the picture's left and lower edge.
struct TimelinePlace {
  static constexpr float kHeight_px = 62.0F;
  static constexpr float kMargin_px = 18.0F;
  static constexpr float kTrackLow_px = 14.0F, kTrackHigh_px = 22.0F;

  explicit TimelinePlace(int width_px) : width(static_cast<float>(width_px)) {}
  float width;

  // From 0 to 1 along the run.
  float XOf(double share) const { return kMargin_px + static_cast<float>(share) * (width - 2.0F * kMargin_px); }
  double ShareAt(double x_px) const;
  static bool Holds(double height_px) { return height_px >= 0.0 && height_px < static_cast<double>(kHeight_px); }
};

// That bar: the way done, marks, and what is said over it.
class TimelineBar {
 public:
  explicit TimelineBar(osg::Group& overlay);
  void Show(const std::optional<Timeline>& timeline, int width_px);

 private:
  Boxes ground_, track_, done_, events_, marks_, knob_;
  osg::ref_ptr<osgText::Text> where_, note_, keys_;
};

}  // namespace rodeira::view
