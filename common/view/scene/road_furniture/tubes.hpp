// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/view/scene/mesh/mesh.hpp"
#include "common/world/network/tubes.hpp"

namespace rodeira::scene {

// A piece of a tunnel's tube as it is seen from within and, where no hill covers it, from outside: walls, which reach a
// little over the hill's edge beside them, and a flat ceiling with haunches; at a mouth the portal, a frame that stands
// before it. Plainer from level 2 on. `lamps`: a band of light along the ceiling; shines by itself.
void AddTube(const network::TubePiece& piece, int level, Mesh& solid, Mesh& lamps);

}  // namespace rodeira::scene
