// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "common/world/network/junction_ground.hpp"
#include "common/world/opendrive/checks.hpp"

namespace rodeira::opendrive {

// A junction's boundary as it lies in the plane, and where roads come in over a piece of it.
struct JunctionBoundary {
  std::vector<Eigen::Vector2d> corners_W;  // counter-clockwise
  std::vector<network::JunctionMouth> mouths;
};

// From its segments. Findings where a road or lane is not there, segments do not meet, or run clockwise; then nothing
// comes.
JunctionBoundary BoundaryOf(const JunctionReading& junction, std::span<const network::Road> roads,
                            const Tolerance& tolerance, Findings& findings);

}  // namespace rodeira::opendrive
