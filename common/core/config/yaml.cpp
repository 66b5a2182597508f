// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/yaml.hpp"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace rodeira::config {

int LineOf(const YAML::Node& node) { return node.IsDefined() && !node.Mark().is_null() ? node.Mark().line + 1 : 0; }

std::string PlaceOf(const detail::Context& context, int line) {
  return line > 0 ? fmt::format("{}:{}", context.path.string(), line) : context.path.string();
}

std::string KindOf(const YAML::Node& node) {
  if (!node.IsDefined()) return "nothing";
  if (node.IsNull()) return "an empty value";
  if (node.IsMap()) return "a mapping";
  if (node.IsSequence()) return "a list";
  return fmt::format("'{}'", node.Scalar().substr(0, 60));
}

std::optional<double> ToNumber(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0.0;
  const auto [at, problem] = std::from_chars(begin, end, value);
  if (problem != std::errc{} || at != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::int64_t> ToInteger(const std::string& text) {
  std::int64_t value = 0;
  const auto [at, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || at != text.data() + text.size()) return std::nullopt;
  return value;
}

base::Result<YAML::Node> LoadYaml(const std::string& text, const char* what) {
  const auto failed = [](const std::string& why, const YAML::Mark& mark) {
    return base::WrongInput(why, mark.is_null() ? "" : std::to_string(mark.line + 1));
  };
  try {
    return YAML::Load(text);
  } catch (const YAML::DeepRecursion&
               problem) {  // the library's own bound: it descends a level of its stack with each level of the text
    return failed(fmt::format("{} is nested too deeply: lists and mappings lie in one another, {} levels are too many",
                              what, problem.depth()),
                  problem.mark);
  } catch (const YAML::Exception& problem) {
    return failed(fmt::format("{} is no YAML: {}", what, problem.msg), problem.mark);
  }
}

YAML::Node Find(const YAML::Node& map, std::string_view key) {
  if (!map.IsDefined() || !map.IsMap()) return YAML::Node(YAML::NodeType::Undefined);
  for (const auto& item : map) {
    if (item.first.IsScalar() && item.first.Scalar() == key) return item.second;
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

int LineOfKey(const YAML::Node& map, std::string_view key) {
  if (map.IsDefined() && map.IsMap()) {
    for (const auto& item : map) {
      if (item.first.IsScalar() && item.first.Scalar() == key) return LineOf(item.first);
    }
  }
  return LineOf(map);
}

std::string Sub(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

std::string RangeText(Range range) {
  const bool low = range.low > -std::numeric_limits<double>::max();
  const bool high = range.high < std::numeric_limits<double>::max();
  if (low && high) return fmt::format("from {} to {}", range.low, range.high);
  if (low && range.low == std::numeric_limits<double>::min()) return "greater than 0";
  if (low) return fmt::format("at least {}", range.low);
  if (high) return fmt::format("at most {}", range.high);
  return "finite";
}

}  // namespace rodeira::config
