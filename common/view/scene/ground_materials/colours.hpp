// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "common/core/ground/ground.hpp"
#include "common/view/scene/mesh/mesh.hpp"

namespace rodeira::scene {

// The colour of a surface where the world gives none.
Colour SurfaceColour(ground::Surface surface);

// Smooth noise in [-1, 1] with features of about `wavelength_m`, a pure function of place and seed.
double SmoothNoise(double x_m, double y_m, double wavelength_m, std::uint64_t seed);

// The natural ground at a place: grass is greener and drier in patches, and gives way to soil where it is steep.
Colour GroundColour(ground::Surface surface, double x_m, double y_m, const Eigen::Vector3d& normal_W);

}  // namespace rodeira::scene
