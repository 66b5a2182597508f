// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Group>
#include <osg/ref_ptr>

#include <array>
#include <vector>

#include "common/view/scene/vehicles/scene_snapshot.hpp"
#include "common/world/road/world.hpp"
#include "nodes/view/materials/material_library.hpp"

namespace rodeira::nodes {

// The lit lights of a world's signals; the dark ones belong to what stands there.
class LightsNode {
 public:
  LightsNode(MaterialLibrary& look, const road::World& world);
  osg::Node* node() { return group_; }

  // Ascending by controller; those of controllers that are not named are dark.
  void Show(const std::vector<scene::LightShown>& lights);

 private:
  struct Head {
    std::uint32_t controller;
    std::array<osg::ref_ptr<osg::Node>, 3> lit;  // from below: green, amber, red
  };

  osg::ref_ptr<osg::Group> group_;
  std::vector<Head> heads_;
};

}  // namespace rodeira::nodes
