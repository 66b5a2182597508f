// SPDX-License-Identifier: Apache-2.0
// Shadows: the one below a car where the sun has no map, and the depth in the sun's map.
#include "nodes/view/shaders/placed_glsl.hpp"
#include "nodes/view/shaders/shaders.hpp"

namespace rodeira::nodes {

std::string ShadowVertexShader() {
  return R"(#version 120
varying vec2 part;
void main() {
  part = gl_MultiTexCoord0.xy;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";
}

std::string ShadowFragmentShader() {
  return R"(#version 120
#pragma import_defines(SUN_SHADOW)
varying vec2 part;
uniform vec3 sun_light;
void main() {
#ifdef SUN_SHADOW
  float dark = 0.3;  // of the sky, which the car hides; the sun's own shadow is elsewhere
#else
  float dark = 0.25 + 0.37 * sun_light.g / 0.73;
#endif
  vec2 inner = 1.0 - smoothstep(vec2(0.62, 0.45), vec2(1.0), abs(part));
  gl_FragColor = vec4(0.05, 0.06, 0.09, dark * inner.x * inner.y);
}
)";
}

std::string DepthVertexShader() {
  return std::string("#version 120\n#pragma import_defines(INSTANCED)\n") + kPlacedGlsl + R"(
void main() { gl_Position = gl_ModelViewProjectionMatrix * Placed(); }
)";
}

std::string DepthFragmentShader() {
  return R"(#version 120
void main() { gl_FragColor = vec4(1.0); }
)";
}

}  // namespace rodeira::nodes
