// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <osg/Matrixd>
#include <osg/StateSet>

#include <cstdint>

#include "common/view/scene/lighting/air.hpp"
#include "common/view/scene/vehicles/moment.hpp"

namespace rodeira::nodes {

// The shaders' uniforms that are the same for all that is drawn. OpenSceneGraph takes the one of the state nearest to
// what is drawn.

// Light, sky, fog and wetness.
void SetAir(osg::StateSet& state, const scene::Air& air);
// What depends on who looks: sun, zenith and headlights in the eye's frame, which `view` leads to. `car`: whose
// headlights; null: nobody's.
void SetEye(osg::StateSet& state, const scene::Air& air, const scene::CarPose* car, const osg::Matrixd& view);
// Of the falling rain.
void SetRain(osg::StateSet& state, std::int64_t time_ns, double aspect);

}  // namespace rodeira::nodes
