// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::nodes {

// GLSL 1.20, which every OpenGL from 2.1 on understands. Uniforms: those of AirUniforms, noise (a texture that
// repeats), glow (of lamps), glows (of a vehicle's, by scene::Lamp; which one: texture coordinate 1), pulse (of a
// chosen car, 0 to 1), face (a sign's picture; where on it: texture coordinates 1), and of the rain time_s and aspect
// (width by height). Words that a state may define, each for what need not be computed without it: HEADLIGHTS, WET,
// SUN_SHADOW (uniforms of SunShadow), SOFT_SHADOW, FINE, INSTANCED (attributes of RepeatedGeometry).
std::string VertexShader(scene::Material material);
std::string FragmentShader(scene::Material material);
std::string SkyVertexShader();
std::string SkyFragmentShader();
std::string ShadowVertexShader();
std::string ShadowFragmentShader();
std::string DepthVertexShader();  // of the sun's shadow map
std::string DepthFragmentShader();
std::string RainVertexShader();
std::string RainFragmentShader();

}  // namespace rodeira::nodes
