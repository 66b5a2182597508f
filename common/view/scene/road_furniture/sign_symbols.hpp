// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "common/view/scene/raster/canvas.hpp"

// What is on the faces of signs, by the plate's form. `kind` as in FaceKinds(), `text` what is written on it.
namespace rodeira::scene {

void DrawRound(Canvas& canvas, const std::string& kind, const std::string& text);
void DrawTriangle(Canvas& canvas, const std::string& kind, const std::string& text);
void DrawRectangle(Canvas& canvas, const std::string& kind, const std::string& text);
// The pentagon of schools and the pennant that ends passing.
void DrawPointed(Canvas& canvas, const std::string& kind);
// Stop, give way, and what is on a diamond: priority road, its end, and warnings.
void DrawPriority(Canvas& canvas, const std::string& kind);

}  // namespace rodeira::scene
