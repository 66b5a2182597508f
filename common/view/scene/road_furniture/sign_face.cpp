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

enum class Shape { kRound, kTriangle, kTriangleDown, kOctagon, kDiamond, kPentagon, kPennant, kRectangle };

// Of a kind that is not here: a triangle, as all signs of dangers are.
constexpr std::pair<std::string_view, Shape> kShapes[] = {
    {"stop", Shape::kOctagon},
    {"give_way", Shape::kTriangleDown},
    {"priority_road", Shape::kDiamond},
    {"end_of_priority_road", Shape::kDiamond},
    {"warning_diamond", Shape::kDiamond},
    {"warning_orange", Shape::kDiamond},
    {"warning_school", Shape::kDiamond},
    {"school", Shape::kPentagon},
    {"pennant", Shape::kPennant},
    {"town", Shape::kRectangle},
    {"end_of_town", Shape::kRectangle},
    {"motorway", Shape::kRectangle},
    {"end_of_motorway", Shape::kRectangle},
    {"crossing", Shape::kRectangle},
    {"parking", Shape::kRectangle},
    {"plate", Shape::kRectangle},
    {"display", Shape::kRectangle},
    {"exit_beacon", Shape::kRectangle},
    {"exit_beacon_two", Shape::kRectangle},
    {"exit_beacon_one", Shape::kRectangle},
    {"beacon", Shape::kRectangle},
    {"one_way", Shape::kRectangle},
    {"speed_limit_us", Shape::kRectangle},
    {"keep_right_us", Shape::kRectangle},
    {"keep_left_us", Shape::kRectangle},
    {"no_entry_us", Shape::kRectangle},
    {"one_way_us", Shape::kRectangle},
    {"prohibition_us", Shape::kRectangle},
    {"roundabout", Shape::kRound},
    {"no_vehicles", Shape::kRound},
    {"no_entry", Shape::kRound},
    {"no_stopping", Shape::kRound},
    {"no_waiting", Shape::kRound},
    {"speed_limit", Shape::kRound},
    {"no_overtaking", Shape::kRound},
    {"end_of_speed_limit", Shape::kRound},
    {"end_of_no_overtaking", Shape::kRound},
    {"end_of_restrictions", Shape::kRound},
    {"keep_right", Shape::kRound},
    {"keep_left", Shape::kRound},
    {"mandatory", Shape::kRound},
    {"prohibition", Shape::kRound},
    {"restriction", Shape::kRound},
    {"railroad", Shape::kRound},
};

Shape SignShapeOf(std::string_view kind) {
  for (const std::string_view begin : {"board", "chevron", "guide_"}) {
    if (kind.starts_with(begin)) return Shape::kRectangle;
  }
  for (const auto& [name, shape] : kShapes) {
    if (kind == name) return shape;
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
  if (kind->starts_with("chevron")) return fmt::format("{}_{}", *kind, bends_left ? "left" : "right");
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
    std::vector<std::string> names = {"board", "display", "plate"};
    for (const std::string_view kind : network::SignKindNames()) {
      if (kind.starts_with("chevron")) {
        for (const char* way : {"left", "right"}) names.push_back(fmt::format("{}_{}", kind, way));
      } else if (kind != "board") {
        names.emplace_back(kind);
      }
    }
    std::sort(names.begin(), names.end());
    return names;
  }();
  return kinds;
}

Raster DrawFace(std::string_view face) {
  const auto [kind, text] = Split(face);
  const bool wide = kind == "town" || kind == "end_of_town" || kind.starts_with("one_way");
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
    case Shape::kPentagon:
    case Shape::kPennant:
      DrawPointed(canvas, kind);
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
    case Shape::kPentagon:
      return {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}, {0.5, 1.0}, {0.0, 0.5}};
    case Shape::kPennant:
      return {{0.0, 0.0}, {1.0, 0.5}, {0.0, 1.0}};
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
      if (kind.starts_with("one_way")) return {0.9, 0.3};
      break;
    case Shape::kPentagon:
      return {0.9, 0.9};
    case Shape::kPennant:
      return {1.2, 0.9};
    default:
      break;
  }
  return {0.6, 0.6};
}

}  // namespace rodeira::scene
