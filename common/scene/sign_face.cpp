#include "common/scene/sign_face.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/geometry/angle.hpp"
#include "common/scene/sign_symbols.hpp"

namespace rodeira::scene {
namespace {

struct Catalogued {
  const char* type;
  const char* subtype;  // "": any
  const char* kind;
};
// More particular ones first.
constexpr Catalogued kCatalogue[] = {
    {"101", "", "danger"}, {"102", "", "priority_to_the_right"}, {"103", "10", "bend_left"}, {"103", "20", "bend_right"},
    {"105", "10", "bends_left_first"}, {"105", "20", "bends_right_first"}, {"108", "", "downhill"}, {"110", "", "uphill"},
    {"112", "", "uneven_road"}, {"114", "", "slippery_road"}, {"205", "", "give_way"}, {"206", "", "stop"}, {"215", "", "roundabout"},
    {"250", "", "no_vehicles"}, {"267", "", "no_entry"}, {"274", "", "speed_limit"}, {"276", "", "no_overtaking"}, {"278", "", "end_of_speed_limit"},
    {"280", "", "end_of_no_overtaking"}, {"282", "", "end_of_restrictions"}, {"301", "", "priority"}, {"306", "", "priority_road"},
    {"307", "", "end_of_priority_road"}, {"310", "", "town"}, {"311", "", "end_of_town"}, {"314", "", "parking"}, {"330", "", "motorway"},
    {"334", "", "end_of_motorway"}, {"350", "", "crossing"}, {"625", "", "chevron"},
};
// Lines and crossings that are painted on the road: they have numbers, but nothing stands there.
constexpr std::array<std::string_view, 9> kPaint = {"293", "294", "295", "296", "297", "298", "299", "340", "341"};

bool KnowsCatalogue(std::string country) {
  std::transform(country.begin(), country.end(), country.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return country.empty() || country == "de" || country == "deu" || country == "ger" || country == "germany" || country == "opendrive";
}

// The number that a sign shows. Old files say limits by the subtype: 51 is 10 km/h … 63 is 130.
std::string NumberOf(const network::Signal& signal) {
  if (signal.value && std::isfinite(*signal.value) && *signal.value > 0.0) {
    double value = *signal.value;
    if (signal.unit == "m/s") value *= 3.6;
    return fmt::format("{}", std::lround(value));
  }
  if (signal.type == "274" && signal.subtype.size() == 2 && signal.subtype[0] >= '5' && signal.subtype[0] <= '6' && signal.subtype[1] >= '0' && signal.subtype[1] <= '9') {
    const int number = std::stoi(signal.subtype);
    if (number >= 51 && number <= 63) return fmt::format("{}", 10 * (number - 50));
  }
  return "";
}

enum class Shape { kRound, kTriangle, kTriangleDown, kOctagon, kDiamond, kRectangle };

Shape ShapeOf(std::string_view kind) {
  if (kind == "stop") return Shape::kOctagon;
  if (kind == "give_way") return Shape::kTriangleDown;
  if (kind == "priority_road" || kind == "end_of_priority_road") return Shape::kDiamond;
  for (const std::string_view square : {"town", "end_of_town", "motorway", "end_of_motorway", "crossing", "parking", "chevron_left", "chevron_right", "plate"}) {
    if (kind == square) return Shape::kRectangle;
  }
  for (const std::string_view round : {"roundabout", "no_vehicles", "no_entry", "speed_limit", "no_overtaking", "end_of_speed_limit", "end_of_no_overtaking", "end_of_restrictions"}) {
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
    const Eigen::Vector2d &tip = tips[k], before = (tips[(k + 2) % 3] - tip).normalized(), after = (tips[(k + 1) % 3] - tip).normalized();
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
  if (!KnowsCatalogue(signal.country)) return "plate";
  if (std::find(kPaint.begin(), kPaint.end(), signal.type) != kPaint.end()) return "";
  for (const Catalogued& sign : kCatalogue) {
    if (signal.type != sign.type || (*sign.subtype != '\0' && signal.subtype != sign.subtype)) continue;
    const std::string_view kind = sign.kind;
    if (kind == "chevron") return bends_left ? "chevron_left" : "chevron_right";
    if (kind == "town" || kind == "end_of_town") return signal.text.empty() ? std::string(kind) : fmt::format("{} {}", kind, signal.text);
    if (kind == "speed_limit" || kind == "end_of_speed_limit" || kind == "downhill" || kind == "uphill") {
      const std::string number = NumberOf(signal);
      if (number.empty()) return kind == "speed_limit" ? "plate" : std::string(kind);
      return fmt::format("{} {}", kind, number);
    }
    return std::string(kind);
  }
  return "plate";
}

const std::vector<std::string>& FaceKinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names = {"chevron_left", "chevron_right", "plate"};
    for (const Catalogued& sign : kCatalogue) {
      if (std::string_view(sign.kind) != "chevron") names.emplace_back(sign.kind);
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
  switch (ShapeOf(kind)) {
    case Shape::kRound: DrawRound(canvas, kind, text); break;
    case Shape::kTriangle: DrawTriangle(canvas, kind, text); break;
    case Shape::kRectangle: DrawRectangle(canvas, kind, text); break;
    default: DrawPriority(canvas, kind); break;
  }
  return canvas.Paint();
}

std::vector<Eigen::Vector2d> PlateOutline(std::string_view face) {
  const auto ring = [](int corners, double from, double radius) {
    std::vector<Eigen::Vector2d> outline;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * geometry::kPi * (k + from) / corners;
      outline.emplace_back(0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle));
    }
    return outline;
  };
  switch (ShapeOf(Split(face).first)) {
    case Shape::kRound: return ring(20, 0.0, 0.5);
    case Shape::kOctagon: return ring(8, 0.5, 0.5 / std::cos(geometry::kPi / 8.0));
    case Shape::kDiamond: return ring(4, 0.0, 0.5);
    case Shape::kTriangle: return RoundTriangle(false);
    case Shape::kTriangleDown: return RoundTriangle(true);
    case Shape::kRectangle: break;
  }
  return {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
}

Eigen::Vector2d UsualPlate_m(std::string_view face) {
  const std::string kind = Split(face).first;
  switch (ShapeOf(kind)) {
    case Shape::kTriangle:
    case Shape::kTriangleDown: return {0.9, 0.78};
    case Shape::kOctagon: return {0.9, 0.9};
    case Shape::kRectangle:
      if (kind == "town" || kind == "end_of_town") return {1.0, 0.65};
      break;
    default: break;
  }
  return {0.6, 0.6};
}

}  // namespace rodeira::scene
