// SPDX-License-Identifier: Apache-2.0
#include "common/view/scene/road_furniture/sign_face.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/core/base/constants.hpp"
#include "common/view/scene/road_furniture/sign_symbols.hpp"
#include "common/world/network/sign_kinds.hpp"

namespace rodeira::scene {
namespace {

enum class Shape { kRound, kTriangle, kTriangleDown, kOctagon, kDiamond, kRectangle };

Shape SignShapeOf(std::string_view kind) {
  if (kind == "stop") return Shape::kOctagon;
  if (kind == "give_way") return Shape::kTriangleDown;
  if (kind == "priority_road" || kind == "end_of_priority_road" || kind == "warning_diamond") return Shape::kDiamond;
  for (const std::string_view square : {"town", "end_of_town", "motorway", "end_of_motorway", "crossing", "parking",
                                        "chevron_left", "chevron_right", "plate", "board", "display", "guide_blue",
                                        "guide_green", "guide_yellow", "exit_beacon", "beacon", "speed_limit_us"}) {
    if (kind == square) return Shape::kRectangle;
  }
  for (const std::string_view round :
       {"roundabout", "no_vehicles", "no_entry", "speed_limit", "no_overtaking", "end_of_speed_limit",
        "end_of_no_overtaking", "end_of_restrictions", "keep_right", "mandatory", "prohibition"}) {
    if (kind == round) return Shape::kRound;
  }
  return Shape::kTriangle;
}

// A triangle on its base with round corners, in the box.
std::vector<Eigen::Vector2d> RoundTriangle(bool down) {
  constexpr double kRadius = 0.07;
  const std::array<Eigen::Vector2d, 3> tips = {Eigen::Vector2d(0.0, 0.0), {1.0, 0.0}, {0.5, 1.0}};
  std::vector<Eigen::Vector2d> outline;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d &tip = tips[k], before = (tips[(k + 2) % 3] - tip).normalized(),
                          after = (tips[(k + 1) % 3] - tip).normalized();
    for (const double share : {0.0, 0.5, 1.0}) {  // along the parabola that touches both sides
      const Eigen::Vector2d p = tip + kRadius * ((1.0 - share) * (1.0 - share) * before + share * share * after);
      outline.emplace_back(p.x(), p.y());
    }
  }
  if (down) {
    for (Eigen::Vector2d& p : outline) p = Eigen::Vector2d(1.0, 1.0) - p;
  }
  return outline;
}

std::pair<std::string, std::string> Split(std::string_view face) {
  const std::size_t space = face.find(' ');
  if (space == std::string_view::npos) return {std::string(face), ""};
  return {std::string(face.substr(0, space)), std::string(face.substr(space + 1))};
}

}  // namespace

std::string FaceOf(const network::Signal& signal, bool bends_left) {
  if (network::IsBoard(signal)) return signal.type == network::kDisplay ? "display" : "board";
  const auto kind = network::SignKindOf(signal);
  if (!kind) return "plate";
  if (*kind == "chevron") return bends_left ? "chevron_left" : "chevron_right";
  if (*kind == "town" || *kind == "end_of_town")
    return signal.text.empty() ? std::string(*kind) : fmt::format("{} {}", *kind, signal.text);
  if (*kind == "speed_limit" || *kind == "speed_limit_us" || *kind == "end_of_speed_limit" || *kind == "downhill" ||
      *kind == "uphill") {
    const std::string number = network::SignNumberOf(signal);
    if (number.empty()) return kind->starts_with("speed_limit") ? "plate" : std::string(*kind);
    return fmt::format("{} {}", *kind, number);
  }
  return std::string(*kind);
}

const std::vector<std::string>& FaceKinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names = {"board", "chevron_left", "chevron_right", "display", "plate"};
    for (const std::string_view kind : network::SignKindNames()) {
      if (kind != "chevron" && kind != "board") names.emplace_back(kind);
    }
    std::sort(names.begin(), names.end());
    return names;
  }();
  return kinds;
}

Raster DrawFace(std::string_view face) {
  const auto [kind, text] = Split(face);
  const bool wide = kind == "town" || kind == "end_of_town";
  Canvas canvas(wide ? 192 : 128, 128, Colour::Of(0x9a9d9f));
  switch (SignShapeOf(kind)) {
    case Shape::kRound:
      DrawRound(canvas, kind, text);
      break;
    case Shape::kTriangle:
      DrawTriangle(canvas, kind, text);
      break;
    case Shape::kRectangle:
      DrawRectangle(canvas, kind, text);
      break;
    default:
      DrawPriority(canvas, kind);
      break;
  }
  return canvas.Paint();
}

std::vector<Eigen::Vector2d> PlateOutline(std::string_view face) {
  const auto ring = [](int corners, double from, double radius) {
    std::vector<Eigen::Vector2d> outline;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * base::kPi * (k + from) / corners;
      outline.emplace_back(0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle));
    }
    return outline;
  };
  switch (SignShapeOf(Split(face).first)) {
    case Shape::kRound:
      return ring(20, 0.0, 0.5);
    case Shape::kOctagon:
      return ring(8, 0.5, 0.5 / std::cos(base::kPi / 8.0));
    case Shape::kDiamond:
      return ring(4, 0.0, 0.5);
    case Shape::kTriangle:
      return RoundTriangle(false);
    case Shape::kTriangleDown:
      return RoundTriangle(true);
    case Shape::kRectangle:
      break;
  }
  return {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
}

Eigen::Vector2d UsualPlate_m(std::string_view face) {
  const std::string kind = Split(face).first;
  switch (SignShapeOf(kind)) {
    case Shape::kTriangle:
    case Shape::kTriangleDown:
      return {0.9, 0.78};
    case Shape::kOctagon:
      return {0.9, 0.9};
    case Shape::kRectangle:
      if (kind == "town" || kind == "end_of_town") return {1.0, 0.65};
      break;
    default:
      break;
  }
  return {0.6, 0.6};
}

}  // namespace rodeira::scene
