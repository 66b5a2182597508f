// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/MatrixTransform>
#include <osg/ref_ptr>

#include <array>
#include <optional>
#include <vector>

#include "common/view/scene/vehicles/cabin_body.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "nodes/view/materials/material_library.hpp"

namespace rodeira::nodes {

// The inside of a car: doors, posts, roof and seats, and the dashboard with needles of speed, engine and fuel, the
// gear, the steering wheel that turns.
class CabinNode {
 public:
  // The library outlives it.
  explicit CabinNode(MaterialLibrary& look);
  osg::Node* node() { return group_; }

  // Of this car; null: no camera is inside of one.
  void Show(const scene::CarPose* car);

 private:
  static constexpr std::int32_t kLowestGear = -1, kHighestGear = 9;
  void Build(const scene::CabinShape& shape);

  MaterialLibrary& look_;
  osg::ref_ptr<osg::MatrixTransform> group_;
  std::array<osg::ref_ptr<osg::MatrixTransform>, 3> needles_;
  std::vector<osg::ref_ptr<osg::Node>> gears_;
  osg::ref_ptr<osg::MatrixTransform> wheel_;
  std::optional<scene::CabinShape> built_for_;  // none: nothing is built yet
};

}  // namespace rodeira::nodes
