// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "common/view/scene/camera/camera.hpp"

namespace rodeira::scene {

enum class Mirror : std::size_t { kLeft, kInside, kRight };
inline constexpr std::size_t kMirrors = 3;
inline constexpr std::array<Mirror, kMirrors> kAllMirrors = {Mirror::kLeft, Mirror::kInside, Mirror::kRight};

// "left", "inside", "right".
std::string_view NameOf(Mirror mirror);
std::optional<Mirror> MirrorOf(std::string_view name);

// Which mirrors belong on one of the screens about a driver: each on the screen with the nearest middle, by its level
// angle, to where it is looked for, 45 degrees to the left and to the right, the inside one 5 degrees to the right; of
// screens equally near on the first one. `which`: of `screens`.
std::array<bool, kMirrors> MirrorsOn(std::span<const ScreenPlane> screens, std::size_t which);

// What a driver sees in a mirror, before it is reversed left to right: from the mirror's place backward, the outer ones
// 8 degrees outward. Its `window` says how much: level 38 degrees in the inside mirror, 26 in the outer ones.
Camera MirrorCamera(const Body& car, Mirror mirror);

// Where in a picture a mirror is shown, in shares of its width and height from the lower left corner.
struct MirrorPlace {
  double left = 0.0, low = 0.0, right = 0.0, high = 0.0;
};
// For a picture so many times as wide as it is high: the mirror keeps its shape. The inside one hangs at the upper
// edge, the outer ones stand at the left and right edges.
MirrorPlace PlaceOf(Mirror mirror, double aspect);
// The same on a screen of a laboratory: an outer one is, with its middle, where the driver sees it on the car, moved
// into the screen by what it would stand out of it. The inside one, and one that is behind the screen's plane, as
// PlaceOf.
MirrorPlace PlaceOn(const ScreenPlane& screen, const Body& car, Mirror mirror, double aspect);
// Width by height of a mirror.
double ShapeOf(Mirror mirror);

}  // namespace rodeira::scene
