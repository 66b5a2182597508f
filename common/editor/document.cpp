// SPDX-License-Identifier: Apache-2.0
#include "common/editor/document.hpp"

#include "common/world/traffic_map/companion_text.hpp"

namespace rodeira::editor {

std::optional<std::size_t> Find(const std::vector<traffic_map::Line<traffic_map::Connection>>& lines, std::int32_t from,
                                std::int32_t to) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].value.from == from && lines[i].value.to == to) return i;
  }
  return std::nullopt;
}

Document EmptyDocument() { return {}; }

std::string BytesOf(const Document& document) {
  return traffic_map::WriteMap(document.map) + traffic_map::CompanionText(document.companion);
}

traffic_map::Cubic CubicOf(const traffic_map::Curve& curve) {
  traffic_map::Cubic cubic;
  for (std::size_t i = 0; i < cubic.p_W.size(); ++i)
    cubic.p_W[i] = {static_cast<double>(curve.points[i].x_m), static_cast<double>(curve.points[i].y_m)};
  return cubic;
}

traffic_map::Cubic Borders::Middle() const {
  traffic_map::Cubic middle;
  for (std::size_t i = 0; i < middle.p_W.size(); ++i) middle.p_W[i] = 0.5 * (left.p_W[i] + right.p_W[i]);
  return middle;
}

std::optional<Borders> BordersOf(const Document& document, const traffic_map::Lane& lane) {
  const auto left = Find(document.map.curves, lane.left.curve), right = Find(document.map.curves, lane.right.curve);
  if (!left || !right) return std::nullopt;
  const auto turned = [&](const traffic_map::LaneSide& side, std::size_t curve) {
    const traffic_map::Cubic cubic = CubicOf(document.map.curves[curve].value);
    return side.inverted ? cubic.Reversed() : cubic;
  };
  return Borders{turned(lane.left, *left), turned(lane.right, *right)};
}

}  // namespace rodeira::editor
