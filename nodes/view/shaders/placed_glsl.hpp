// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rodeira::nodes {

// Of a vertex shader: where a vertex is, its normal and its colour. INSTANCED: those of a model at one of its places
// (RepeatedGeometry).
inline constexpr const char* kPlacedGlsl = R"(
#ifdef INSTANCED
attribute vec4 instance_place;
attribute vec4 instance_shape;
vec2 Turned(vec2 v) {
  return vec2(instance_shape.x * v.x - instance_shape.y * v.y, instance_shape.y * v.x + instance_shape.x * v.y);
}
vec4 Placed() {
  return vec4(instance_place.xyz + vec3(Turned(gl_Vertex.xy * instance_shape.z), gl_Vertex.z * instance_shape.w), 1.0);
}
vec3 PlacedNormal() { return vec3(Turned(gl_Normal.xy), gl_Normal.z); }
// scene::LeafColour, to the bit.
vec4 PlacedColour() {
  if (gl_Color.a > 0.5) return gl_Color;
  vec3 upper = floor(vec3(instance_place.w) / vec3(65536.0, 256.0, 1.0));
  vec3 leaves = upper - vec3(0.0, 256.0 * upper.rg);
  vec3 dark = floor(0.72 * leaves + 0.5);
  vec3 light = min(floor(1.12 * leaves + 0.5), vec3(255.0));
  return vec4(floor(mix(dark, light, floor(255.0 * gl_Color.r + 0.5) / 4.0) + 0.5) / 255.0, 1.0);
}
#else
vec4 Placed() { return gl_Vertex; }
vec3 PlacedNormal() { return gl_Normal; }
vec4 PlacedColour() { return gl_Color; }
#endif
)";

}  // namespace rodeira::nodes
