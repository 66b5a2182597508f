#pragma once

#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osgText/Text>

#include <array>
#include <memory>

#include "nodes/view/overlay.hpp"
#include "nodes/view/picture.hpp"

namespace rodeira::view {

// The colours of a statistic over the ground, 70 of them in 100 and 30 of the ground, and the legend that says what they mean.
class HeatNode {
 public:
  explicit HeatNode(osg::Group& overlay);

  osg::Node* node() { return place_; }
  // Null: nothing. What was shown before is not laid again.
  void Show(const std::shared_ptr<const HeatPicture>& heat, int height_px);

 private:
  static constexpr std::size_t kSteps = 16;  // of the legend's bar
  void Lay(const HeatPicture& heat);
  void ShowLegend(const HeatPicture* heat, float high_px);

  osg::ref_ptr<osg::MatrixTransform> place_;
  osg::ref_ptr<osg::Geometry> squares_;
  std::shared_ptr<const HeatPicture> laid_;
  Boxes ground_;
  std::array<std::unique_ptr<Boxes>, kSteps> bar_;
  osg::ref_ptr<osgText::Text> title_, low_, middle_, high_;
};

}  // namespace rodeira::view
