// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Matrixd>
#include <osg/StateSet>

#include <cstdint>

#include "common/view/scene/lighting/air.hpp"
#include "common/view/scene/vehicles/scene_snapshot.hpp"

namespace rodeira::nodes {

// The shaders' uniforms that are the same for all that is drawn. OpenSceneGraph takes the one of the state nearest to
// what is drawn.

// Light, sky, fog and wetness.
void SetAir(osg::StateSet& state, const scene::Air& air);
// What depends on the eye: sun, zenith and headlights in its frame, which `view` leads to. `car`: it has the
// headlights; null: none.
void SetEye(osg::StateSet& state, const scene::Air& air, const scene::CarPose* car, const osg::Matrixd& view);
// Of the falling rain.
void SetRain(osg::StateSet& state, std::int64_t time_ns, double aspect);

}  // namespace rodeira::nodes
