// SPDX-License-Identifier: Apache-2.0
#include "nodes/view/dynamic_objects/lights_node.hpp"

#include <osg/MatrixTransform>

#include <algorithm>

#include "common/view/scene/road_furniture/light_heads.hpp"
#include "common/view/scene/road_furniture/models.hpp"

namespace rodeira::nodes {
namespace {

using network::LightColour;

// From below: green, amber, red.
std::array<bool, 3> LitAt(LightColour colour) {
  const bool waits = colour == LightColour::kRed || colour == LightColour::kRedAmber;
  return {colour == LightColour::kGreen, colour == LightColour::kAmber || colour == LightColour::kRedAmber, waits};
}

}  // namespace

LightsNode::LightsNode(MaterialLibrary& look, const road::World& world) : group_(new osg::Group) {
  for (const scene::LightHead& head : scene::LightHeads(world)) {
    Head made{head.controller, {}};
    for (std::size_t which = 0; which < made.lit.size(); ++which) {
      scene::Mesh mesh, model = scene::LitLightModel(head.height_m, which);
      mesh.material = model.material;
      mesh.origin_W = head.stand.foot_W;
      scene::AddPlaced(model, head.stand, mesh);
      const scene::Mesh* placed = &mesh;
      made.lit[which] = look.Placed({&placed, 1});
      made.lit[which]->setNodeMask(0U);
      group_->addChild(made.lit[which]);
    }
    heads_.push_back(std::move(made));
  }
}

void LightsNode::Show(const std::vector<scene::LightShown>& lights) {
  for (Head& head : heads_) {
    const auto shown = std::lower_bound(
        lights.begin(), lights.end(), head.controller,
        [](const scene::LightShown& light, std::uint32_t controller) { return light.controller < controller; });
    const bool dark = shown == lights.end() || shown->controller != head.controller;
    const std::array<bool, 3> lit = dark ? std::array<bool, 3>{} : LitAt(shown->colour);
    for (std::size_t which = 0; which < lit.size(); ++which) head.lit[which]->setNodeMask(lit[which] ? ~0U : 0U);
  }
}

}  // namespace rodeira::nodes
