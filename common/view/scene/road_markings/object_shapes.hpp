// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/view/scene/mesh/mesh.hpp"
#include "common/world/network/furniture.hpp"

// What the outlines of objects look like: what fills them, and the frames within their edges.
namespace rodeira::scene {

// Of what fills an outline; nothing where it is not said.
std::optional<Colour> FillColour(std::string_view fill);
// Of a frame: "concrete", or "curb".
Colour BorderColour(std::string_view type);

// A piece of a frame: along a side of the outline from 0 to 1, and its inner edge from 2 to 3. Corners
// counter-clockwise; `from` and `to` are the outline's corners that it goes between.
struct FramePiece {
  std::array<Eigen::Vector2d, 4> corners;
  std::size_t from = 0, to = 0;
};

// A frame of a width within a closed outline, or about an open one: along all of it, or from each of the corners
// `along` to the next. It is mitred; where a corner is so sharp that the mitre is longer than four times the width it
// is cut off there. Nothing where the outline has less than two corners.
std::vector<FramePiece> FrameOf(std::span<const Eigen::Vector2d> outline, bool closed,
                                std::span<const std::size_t> along, double width_m);

// The corners that a border of an object names, as indices into its outline; none: all of it.
std::vector<std::size_t> CornersOf(const network::Object& object, const network::ObjectBorder& border);

}  // namespace rodeira::scene
