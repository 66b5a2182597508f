#pragma once

#include <osg/MatrixTransform>
#include <osg/ref_ptr>

#include <array>
#include <optional>
#include <vector>

#include "common/scene/moment.hpp"
#include "nodes/view/look.hpp"

namespace rodeira::view {

// The dashboard before the driver: needles of speed, engine and fuel, the gear, the steering wheel that turns.
class CabinNode {
 public:
  explicit CabinNode(Look& look);
  osg::Node* node() { return group_; }

  // Of this car; null: nobody looks from inside of one.
  void Show(const scene::CarPose* car);

 private:
  static constexpr std::int32_t kLowestGear = -1, kHighestGear = 9;
  void Build(double car_width_m, double eye_left_m);

  Look& look_;
  osg::ref_ptr<osg::MatrixTransform> group_;
  std::array<osg::ref_ptr<osg::MatrixTransform>, 3> needles_;
  std::vector<osg::ref_ptr<osg::Node>> gears_;
  osg::ref_ptr<osg::MatrixTransform> wheel_;
  double built_for_m_ = 0.0;  // the car's width; 0: nothing is built yet
};

}  // namespace rodeira::view
