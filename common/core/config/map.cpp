// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "common/core/base/file_kind.hpp"
#include "common/core/base/suggest.hpp"
#include "common/core/config/yaml.hpp"

namespace rodeira::config {
namespace {

// What a file of a known kind is that says `version`, "world/2", where another kind was expected; empty: the same kind,
// or an unknown one.
std::string OtherKind(std::string_view version, std::string_view expected, const detail::Context& context) {
  const std::string_view kind = version.substr(0, version.find('/'));
  return kind == expected.substr(0, expected.find('/')) ? "" : base::AboutKind(kind, context.path);
}

}  // namespace

Map::Map(std::shared_ptr<detail::Context> context, std::shared_ptr<detail::YamlNode> node, std::string path)
    : context_(std::move(context)), node_(std::move(node)), path_(std::move(path)) {
  if (node_->present && node_->node.IsMap()) {
    auto& asked = context_->keys_read[{LineOf(node_->node), path_}];
    asked.node = node_->node;
    asked.path = path_;
  }
}

// A reader that asks whether a key is there knows it: it is among those named where another is misspelt.
bool Map::Has(std::string_view key) const {
  if (node_->present && node_->node.IsMap()) context_->keys_read[{LineOf(node_->node), path_}].hoped.emplace(key);
  return node_->present && Find(node_->node, key).IsDefined();
}

std::string Map::Place() const { return PlaceOf(*context_, path_, node_->present ? LineOf(node_->node) : 0); }

std::string Map::Place(std::string_view key) const {
  return PlaceOf(*context_, Sub(path_, key), node_->present ? LineOfKey(node_->node, key) : 0);
}

void Map::Problem(std::string_view key, base::ErrorId id, std::string message) const {
  if (node_->present && node_->node.IsMap()) context_->keys_read[{LineOf(node_->node), path_}].wrong = true;
  context_->Add(node_->present ? LineOfKey(node_->node, key) : 0, Sub(path_, key), id, std::move(message));
}

void Map::Missing(std::string_view key, std::string_view expected) const {
  const std::string path = Sub(path_, key);
  context_->Add(LineOf(node_->node), path, "config.missing_key",
                fmt::format("key '{}' is missing; {} was expected", path, expected), path);
}

template <class T>
std::optional<T> Map::Scalar(std::string_view key, bool required, std::string_view expected) const {
  if (node_->present && node_->node.IsMap()) context_->keys_read[{LineOf(node_->node), path_}].keys.emplace(key);
  const YAML::Node found = node_->present ? Find(node_->node, key) : YAML::Node(YAML::NodeType::Undefined);
  if (!found.IsDefined()) {
    if (required && node_->present) Missing(key, expected);
    return std::nullopt;
  }
  std::optional<T> value;
  if (found.IsScalar()) {
    if constexpr (std::is_same_v<T, double>)
      value = ToNumber(found.Scalar());
    else if constexpr (std::is_same_v<T, std::int64_t>)
      value = ToInteger(found.Scalar());
    else if constexpr (std::is_same_v<T, bool>) {
      if (found.Scalar() == "true") value = true;
      if (found.Scalar() == "false") value = false;
    } else {
      value = found.Scalar();
    }
  }
  if (!value)
    Problem(key, "config.wrong_type",
            fmt::format("'{}' is {}; {} was expected", Sub(path_, key), KindOf(found), expected));
  return value;
}

std::optional<double> Map::Checked(std::string_view key, std::optional<double> value, Range range) const {
  if (value && !(*value >= range.low && *value <= range.high)) {
    Problem(key, "config.out_of_range",
            fmt::format("'{}' is {}; a number {} was expected", Sub(path_, key), *value, RangeText(range)));
  }
  return value;
}

double Map::Number(std::string_view key, Range range) const {
  return Checked(key, Scalar<double>(key, true, "a number"), range).value_or(std::clamp(0.0, range.low, range.high));
}
double Map::Number(std::string_view key, Range range, double default_value) const {
  return Checked(key, Scalar<double>(key, false, "a number"), range).value_or(default_value);
}

std::int64_t Map::Integer(std::string_view key, std::int64_t low, std::int64_t high) const {
  if (!Has(key)) {
    (void)Scalar<std::int64_t>(key, true, fmt::format("a whole number from {} to {}", low, high));
    return low;
  }
  return Integer(key, low, high, low);
}
std::int64_t Map::Integer(std::string_view key, std::int64_t low, std::int64_t high, std::int64_t default_value) const {
  const std::string expected = fmt::format("a whole number from {} to {}", low, high);
  const auto value = Scalar<std::int64_t>(key, false, expected);
  if (value && (*value < low || *value > high))
    Problem(key, "config.out_of_range", fmt::format("'{}' is {}; {} was expected", Sub(path_, key), *value, expected));
  return std::clamp(value.value_or(default_value), low, high);
}

bool Map::Flag(std::string_view key, bool default_value) const {
  return Scalar<bool>(key, false, "true or false").value_or(default_value);
}

std::string Map::Text(std::string_view key) const { return Scalar<std::string>(key, true, "a text").value_or(""); }
std::string Map::Text(std::string_view key, std::string_view default_value) const {
  return Scalar<std::string>(key, false, "a text").value_or(std::string(default_value));
}

std::string Map::Choice(std::string_view key, const std::vector<std::string>& allowed) const {
  if (!Has(key)) {
    (void)Scalar<std::string>(key, true, fmt::format("one of {}", fmt::join(allowed, ", ")));
    return allowed.front();
  }
  return Choice(key, allowed, allowed.front());
}
std::string Map::Choice(std::string_view key, const std::vector<std::string>& allowed,
                        std::string_view default_value) const {
  const auto value = Scalar<std::string>(key, false, "a word");
  if (!value) return std::string(default_value);
  if (std::find(allowed.begin(), allowed.end(), *value) == allowed.end()) {
    if (const std::string about =
            key == "rodeira" && path_.empty() ? OtherKind(*value, allowed.front(), *context_) : "";
        !about.empty()) {
      Problem(key, "config.other_kind",
              fmt::format("'rodeira' is '{}'; '{}' was expected; this is {}", *value, allowed.front(), about));
      return std::string(default_value);
    }
    Problem(key, "config.unknown_word",
            fmt::format("'{}' is '{}'{}", Sub(path_, key), *value, base::DidYouMean(*value, allowed)));
    return std::string(default_value);
  }
  return *value;
}

std::filesystem::path Map::Path(std::string_view key) const {
  const std::string text = Scalar<std::string>(key, true, "a path").value_or("");
  return text.empty() ? std::filesystem::path() : (context_->path.parent_path() / text).lexically_normal();
}
std::optional<std::filesystem::path> Map::OptionalPath(std::string_view key) const {
  const auto text = Scalar<std::string>(key, false, "a path");
  if (!text) return std::nullopt;
  return (context_->path.parent_path() / *text).lexically_normal();
}

std::vector<double> Map::Numbers(std::string_view key, Range range) const {
  std::vector<double> values;
  const List list = Items(key);
  for (std::size_t i = 0; i < list.size(); ++i) values.push_back(list.Number(i, range));
  return values;
}

Map Map::OptionalChild(std::string_view key) const {
  if (node_->present && node_->node.IsMap()) context_->keys_read[{LineOf(node_->node), path_}].keys.emplace(key);
  const YAML::Node found = node_->present ? Find(node_->node, key) : YAML::Node(YAML::NodeType::Undefined);
  const bool present = found.IsDefined() && found.IsMap();
  if (found.IsDefined() && !present)
    Problem(key, "config.wrong_type",
            fmt::format("'{}' is {}; a mapping was expected", Sub(path_, key), KindOf(found)));
  auto child = std::make_shared<detail::YamlNode>();
  if (present) child->node.reset(found);
  child->present = present;
  return Map(context_, child, Sub(path_, key));
}
Map Map::Child(std::string_view key) const {
  if (node_->present && !Has(key)) Missing(key, "a mapping");
  return OptionalChild(key);
}

List Map::OptionalItems(std::string_view key) const {
  if (node_->present && node_->node.IsMap()) context_->keys_read[{LineOf(node_->node), path_}].keys.emplace(key);
  const YAML::Node found = node_->present ? Find(node_->node, key) : YAML::Node(YAML::NodeType::Undefined);
  const bool present = found.IsDefined() && found.IsSequence();
  if (found.IsDefined() && !present)
    Problem(key, "config.wrong_type", fmt::format("'{}' is {}; a list was expected", Sub(path_, key), KindOf(found)));
  auto child = std::make_shared<detail::YamlNode>();
  if (present) child->node.reset(found);
  child->present = present;
  return List(context_, child, Sub(path_, key));
}
List Map::Items(std::string_view key) const {
  if (node_->present && !Has(key)) Missing(key, "a list");
  return OptionalItems(key);
}

void Map::IgnoreKey(std::string_view key) const {
  if (node_->present && node_->node.IsMap()) context_->keys_read[{LineOf(node_->node), path_}].keys.emplace(key);
}

std::optional<std::string> Map::Peek(std::initializer_list<std::string_view> path) const {
  if (!node_->present) return std::nullopt;
  YAML::Node node;
  node.reset(node_->node);
  for (const std::string_view key : path) node.reset(Find(node, key));
  if (!node.IsDefined() || !node.IsScalar()) return std::nullopt;
  return node.Scalar();
}

std::vector<std::string> Map::Keys() const {
  std::vector<std::string> keys;
  if (!node_->present || !node_->node.IsMap()) return keys;
  for (const auto& item : node_->node) {
    if (!item.first.IsScalar()) continue;
    keys.push_back(item.first.Scalar());
    context_->keys_read[{LineOf(node_->node), path_}].keys.insert(item.first.Scalar());
  }
  return keys;
}

}  // namespace rodeira::config
