// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "common/view/scene/raster/canvas.hpp"

namespace rodeira::scene {

// Writes capitals, digits and some marks by strokes: UTF-8, small letters as capitals, the accents of western Europe
// (Latin-1). What has no strokes here leaves a gap. Centred on `middle`, letters `height` high, narrowed to no more
// than `most` wide.
void Letter(Canvas& canvas, std::string_view text, const Eigen::Vector2d& middle, double height, double most,
            Colour colour);

}  // namespace rodeira::scene
