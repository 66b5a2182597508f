// SPDX-License-Identifier: Apache-2.0
#include "common/vehicle/multibody/joints.hpp"

#include <algorithm>

namespace rodeira::multibody {

std::vector<Joint> JointsOf(const System& system) {
  const Drawing& drawing = system.drawing();
  std::vector<Joint> joints;
  std::vector<bool> is_known(drawing.entities.size(), false);  // points of the bodies so far
  for (std::size_t body = 0; body < drawing.bodies.size(); ++body) {
    const std::vector<int>& entities = drawing.bodies[body].entities;
    for (const int entity : entities) {
      const auto index = static_cast<std::size_t>(entity);
      if (drawing.entities[index].kind != EntityKind::kPoint || !is_known[index]) continue;
      auto force = JointForce::Make(system, static_cast<int>(body), entity, SharedDistance::kOfTheEarlierBody);
      if (force) joints.push_back({drawing.body_names[body], drawing.entities[index].name, std::move(force).value()});
    }
    for (const int entity : entities) is_known[static_cast<std::size_t>(entity)] = true;
  }
  return joints;
}

}  // namespace rodeira::multibody
