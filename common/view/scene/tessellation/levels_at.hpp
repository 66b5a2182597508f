// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/world/road/world.hpp"

namespace rodeira::scene {

// A surface nearer than this below another one belongs to it, but below a bridge's deck.
inline constexpr double kLevelApart_m = 2.0;

// SUELO's surfaces at a place, from the highest to the lowest, at most `most`. Where SUELO knows no ground there is
// one: the height of the nearest road's edge goes on (land that is only seen), or nothing in a world without
// roads.
void LevelsAt(const road::World& world, const Eigen::Vector2d& p_W, std::size_t most,
              std::vector<road::SurfacePoint>& levels);

// The same at a corner of a face, seen from within it: asked a little nearer to `towards_W` and led back along the
// slopes, so that rounding of the corner across an edge at which SUELO steps does no harm. `least`: so many levels the
// face has; where fewer are there, as beside a deck's drawn edge, it is asked farther within.
void LevelsWithin(const road::World& world, const Eigen::Vector2d& p_W, const Eigen::Vector2d& towards_W,
                  std::size_t most, std::vector<road::SurfacePoint>& levels, std::size_t least = 1);

}  // namespace rodeira::scene
