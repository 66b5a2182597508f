// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Matrixd>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <osgText/Text>

#include <array>
#include <memory>
#include <string>

#include "nodes/view/frame/picture.hpp"
#include "nodes/view/overlays/overlay.hpp"

namespace rodeira::nodes {

// What a legend says: "speed, % of the limit, of 12 s" over the bar, numbers at its red end, middle and green end below
// it.
struct HeatLegend {
  std::string title, low, middle, high;
};
// In the scale's unit.
HeatLegend LegendOf(const HeatPicture& heat);

// The colours of a statistic over the ground, 70 of them in 100 and 30 of the ground: a texture of numbers, which the
// shaders of whatever is ground lay over it from above. And the legend that says what they mean.
class HeatNode {
 public:
  // `state`: which all shaders read.
  HeatNode(osg::Group& overlay, osg::StateSet& state);

  // Null: nothing. What was shown before is not laid again.
  void Show(osg::StateSet& state, const std::shared_ptr<const HeatPicture>& heat, const PanelSize& size);
  // For an eye that looks through this view: its state says where on the texture a place of its own frame is.
  void SetEye(osg::StateSet& state, const osg::Matrixd& view) const;

 private:
  static constexpr std::size_t kSteps = 16;  // of the legend's bar
  void Lay(osg::StateSet& state, const scene::HeatRaster& raster);
  void ShowLegend(const HeatPicture* heat, float high);

  osg::ref_ptr<osg::Texture2D> squares_;
  osg::Matrixd world_to_squares_;
  std::shared_ptr<const HeatPicture> laid_;
  Boxes ground_;
  std::array<std::unique_ptr<Boxes>, kSteps> bar_;
  osg::ref_ptr<osgText::Text> title_, low_, middle_, high_;
};

}  // namespace rodeira::nodes
