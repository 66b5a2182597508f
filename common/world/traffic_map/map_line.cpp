// SPDX-License-Identifier: Apache-2.0
#include "common/world/traffic_map/map_line.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

namespace rodeira::traffic_map {
namespace {

// The fields of a line, one after the other; after the first problem all answers are zeros.
class Fields {
 public:
  explicit Fields(std::string_view line) {
    for (std::size_t at = 0;;) {
      const std::size_t comma = line.find(',', at);
      fields_.push_back(line.substr(at, comma - at));
      if (comma == std::string_view::npos) return;
      at = comma + 1;
    }
  }

  std::size_t count() const { return fields_.size(); }

  template <class Number>
  Number Take(std::string_view what, Number least, Number most) {
    const std::string_view text = fields_[next_++];
    Number value{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    constexpr std::string_view kKind = std::is_integral_v<Number> ? "a whole number" : "a number with a decimal point";
    const bool whole =
        problem == std::errc() && end == text.data() + text.size() && std::isfinite(static_cast<double>(value));
    if (!whole || value < least || value > most) {
      Refuse(what, text, fmt::format("{} from {} to {}", kKind, least, most));
      return {};
    }
    return value;
  }
  std::int32_t Id(std::string_view what) { return Take<std::int32_t>(what, INT32_MIN, INT32_MAX); }
  float Metres(std::string_view what) { return Take<float>(what, -kFarthest_m, kFarthest_m); }
  bool Truth(std::string_view what) {
    const std::string_view text = fields_[next_++];
    if (text != "True" && text != "False") Refuse(what, text, "True or False");
    return text == "True";
  }

  void Refuse(std::string sentence) {
    if (problem_.empty()) problem_ = std::move(sentence);
  }
  template <class Value>
  base::Result<Value> Answer(const Value& value) const {
    if (problem_.empty()) return value;
    return base::WrongInput("map.wrong_line", problem_);
  }

 private:
  void Refuse(std::string_view what, std::string_view found, const std::string& expected) {
    constexpr std::size_t kShown = 40;
    Refuse(fmt::format("{} is '{}{}'; {} was expected", what, found.substr(0, kShown), found.size() > kShown ? "…" : "",
                       expected));
  }

  std::vector<std::string_view> fields_;
  std::size_t next_ = 1;  // behind the letter
  std::string problem_;
};

LaneSide TakeSide(Fields& fields, std::string_view name) {
  LaneSide side;
  side.curve = fields.Id(fmt::format("the number of the {} curve", name));
  side.inverted = fields.Truth(fmt::format("whether the {} curve is inverted", name));
  side.type = static_cast<BorderType>(fields.Take<int>(fmt::format("the {} border's type", name), 0, kBorderTypes - 1));
  return side;
}

base::Error WrongCount(char letter, std::size_t found, std::string_view expected) {
  return base::WrongInput("map.wrong_line",
                          fmt::format("a line '{}' with {} fields; expected are {}", letter, found, expected));
}

std::string_view Truth(bool value) { return value ? "True" : "False"; }

// The shortest decimal number that reads as the same float32; with an exponent only where it is very small.
std::string Shortest(float value) {
  constexpr float kPlain = 1e-5f;
  const auto format =
      value != 0.0f && std::abs(value) < kPlain ? std::chars_format::scientific : std::chars_format::fixed;
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format).ptr;
  return std::string(buffer.data(), end);
}

std::string SideText(const LaneSide& side) {
  return fmt::format("{},{},{}", side.curve, Truth(side.inverted), static_cast<int>(side.type));
}

}  // namespace

template <>
base::Result<Curve> ReadLine(std::string_view line) {
  Fields fields(line);
  if (fields.count() == 26)
    return base::WrongInput("map.wrong_line",
                            "a line 'p' with 26 fields instead of 14: are the numbers written with a decimal comma?");
  if (fields.count() != 14)
    return WrongCount('p', fields.count(), "14: p, the curve's number, x, height, z of four points");
  Curve curve;
  curve.id = fields.Id("the curve's number");
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    curve.points[i].x_m = fields.Metres(fmt::format("x of point {}", i));
    curve.points[i].drawing_height = fields.Metres(fmt::format("the height of point {}", i));
    curve.points[i].y_m = fields.Metres(fmt::format("z of point {}", i));
  }
  return fields.Answer(curve);
}

template <>
base::Result<Lane> ReadLine(std::string_view line) {
  Fields fields(line);
  if (fields.count() != 9) {
    return WrongCount('l', fields.count(),
                      "9: l, the lane's number, left curve, inverted, type, right curve, inverted, type, mode");
  }
  Lane lane;
  lane.id = fields.Id("the lane's number");
  lane.left = TakeSide(fields, "left");
  lane.right = TakeSide(fields, "right");
  lane.mode = static_cast<LaneMode>(fields.Take<int>("the lane's mode (none, start, end)", 0, 2));
  return fields.Answer(lane);
}

template <>
base::Result<Connection> ReadLine(std::string_view line) {
  Fields fields(line);
  if (fields.count() != 4 && fields.count() != 7) {
    return WrongCount('c', fields.count(),
                      "4 or 7: c, from lane, to lane, STOP (True or False), and three numbers that older files lack");
  }
  Connection connection;
  connection.from = fields.Id("the lane that is connected from");
  connection.to = fields.Id("the lane that is connected to");
  connection.stop = fields.Truth("the STOP flag");
  if (fields.count() == 7) {
    for (float& number : connection.unknown) number = fields.Metres("one of the last three numbers");
  }
  return fields.Answer(connection);
}

template <>
base::Result<Scale> ReadLine(std::string_view line) {
  Fields fields(line);
  if (fields.count() != 2) return WrongCount('s', fields.count(), "2: s, the picture's scale");
  return fields.Answer(Scale{fields.Take<float>("the picture's scale", 1e-6f, kFarthest_m)});
}

std::string LineText(const Curve& curve) {
  std::string text = fmt::format("p,{}", curve.id);
  for (const ControlPoint& point : curve.points) {
    text += fmt::format(",{},{},{}", Shortest(point.x_m), Shortest(point.drawing_height), Shortest(point.y_m));
  }
  return text + "\n";
}

std::string LineText(const Lane& lane) {
  return fmt::format("l,{},{},{},{}\n", lane.id, SideText(lane.left), SideText(lane.right),
                     static_cast<int>(lane.mode));
}

std::string LineText(const Connection& connection) {
  std::string text = fmt::format("c,{},{},{}", connection.from, connection.to, Truth(connection.stop));
  for (const float number : connection.unknown) text += "," + Shortest(number);
  return text + "\n";
}

std::string LineText(const Scale& scale) { return "s," + Shortest(scale.value) + "\n"; }

std::string_view WithoutLineEnd(std::string_view line) {
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace rodeira::traffic_map
