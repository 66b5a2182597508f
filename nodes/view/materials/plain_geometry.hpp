// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Geometry>
#include <osg/ref_ptr>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/view/scene/mesh/repeated.hpp"

namespace rodeira::nodes {

// A mesh's vertices and triangles without its origin, and without a state.
osg::ref_ptr<osg::Geometry> PlainGeometry(const scene::Mesh& mesh);

// A model that stands at many places, once, with the places beside it (kPlaceSlot, kShapeSlot). Without Spread it is
// drawn at none of them.
osg::ref_ptr<osg::Geometry> RepeatedGeometry(const scene::Repeated& repeated);
// From now on it is drawn at its places, in one call, by what the current context has to offer (CanRepeat) and a state
// that says so (MaterialLibrary::StateOfRepeated).
void Spread(osg::Geometry& repeated);
// Whether the current OpenGL context draws a model many times in one call: ARB_draw_instanced, ARB_instanced_arrays.
bool CanRepeat();

// Attributes that each place has: its foot (x, y, z) and the colour of its leaves (65536 red + 256 green + blue); its x
// axis (x, y), and how many times as wide and as high as the model it is. Numbers which no fixed attribute has.
inline constexpr unsigned kPlaceSlot = 6, kShapeSlot = 7;

}  // namespace rodeira::nodes
