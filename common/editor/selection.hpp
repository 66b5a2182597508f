// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "common/editor/document.hpp"
#include "common/world/traffic_map/check.hpp"

namespace rodeira::editor {

inline constexpr double kJoined_m = 1e-3;  // control points no farther apart are joined

// A control point of a curve, 0 to 3.
struct Handle {
  std::int32_t curve = 0;
  int index = 0;

  auto operator<=>(const Handle&) const = default;
};

// What a person has chosen, by numbers; some of it may have gone meanwhile.
struct Selection {
  std::set<Handle> handles;
  std::set<std::int32_t> curves, lanes;
  std::set<std::pair<std::int32_t, std::int32_t>> connections;

  bool empty() const { return handles.empty() && curves.empty() && lanes.empty() && connections.empty(); }
};

// The control points of the handles, curves and lanes chosen, each once, ascending; only those that there are.
std::vector<Handle> HandlesOf(const Document& document, const Selection& selection);

// Everything that lies wholly within a rectangle: handles, curves of which all four do, lanes of which both curves do,
// connections of which both lanes do. Two opposite corners, in any order.
Selection Inside(const Document& document, const Eigen::Vector2d& corner_W, const Eigen::Vector2d& opposite_W);

// The element that a finding of the check speaks of.
Selection Chosen(const traffic_map::Finding& finding);
// Where it is to be seen: the middle of the chosen; nothing where nothing of it is there.
std::optional<Eigen::Vector2d> MiddleOf(const Document& document, const Selection& selection);

// What lies under the pointer, the nearest within a radius.
std::optional<Handle> HandleAt(const Document& document, const Eigen::Vector2d& p_W, double radius_m);
// By the distance to the curve itself.
std::optional<std::int32_t> CurveAt(const Document& document, const Eigen::Vector2d& p_W, double radius_m);
// The first lane with p on its ground.
std::optional<std::int32_t> LaneAt(const Document& document, const Eigen::Vector2d& p_W);
// All handles at this place to a millimetre: ends that were joined.
std::vector<Handle> HandlesTogether(const Document& document, const Eigen::Vector2d& p_W);

}  // namespace rodeira::editor
