// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/core/config/yaml.hpp"

namespace rodeira::config {

List::List(std::shared_ptr<detail::Context> context, std::shared_ptr<detail::YamlNode> node, std::string path)
    : context_(std::move(context)), node_(std::move(node)), path_(std::move(path)) {}

std::size_t List::size() const { return node_->present ? node_->node.size() : 0; }

std::string List::Place(std::size_t index) const {
  return PlaceOf(*context_, fmt::format("{}[{}]", path_, index), index < size() ? LineOf(node_->node[index]) : 0);
}

void List::Problem(std::size_t index, base::ErrorId id, std::string message) const {
  context_->Add(index < size() ? LineOf(node_->node[index]) : 0, fmt::format("{}[{}]", path_, index), id,
                std::move(message));
}

Map List::At(std::size_t index) const {
  RODEIRA_ASSERT(index < size());
  const YAML::Node found = node_->node[index];
  auto child = std::make_shared<detail::YamlNode>();
  child->present = found.IsMap();
  if (child->present)
    child->node.reset(found);
  else
    Problem(index, "config.wrong_type",
            fmt::format("item {} of '{}' is {}; a mapping was expected", index + 1, path_, KindOf(found)));
  return Map(context_, child, fmt::format("{}[{}]", path_, index));
}

double List::Number(std::size_t index, Range range) const {
  RODEIRA_ASSERT(index < size());
  const YAML::Node found = node_->node[index];
  const auto value = found.IsScalar() ? ToNumber(found.Scalar()) : std::nullopt;
  if (!value || !(*value >= range.low && *value <= range.high)) {
    Problem(index, value ? base::ErrorId("config.out_of_range") : base::ErrorId("config.wrong_type"),
            fmt::format("item {} of '{}' is {}; a number {} was expected", index + 1, path_, KindOf(found),
                        RangeText(range)));
  }
  return value.value_or(std::clamp(0.0, range.low, range.high));
}

std::string List::Text(std::size_t index) const {
  RODEIRA_ASSERT(index < size());
  const YAML::Node found = node_->node[index];
  if (found.IsScalar()) return found.Scalar();
  Problem(index, "config.wrong_type",
          fmt::format("item {} of '{}' is {}; a text was expected", index + 1, path_, KindOf(found)));
  return {};
}

std::vector<double> List::Numbers(std::size_t index) const {
  RODEIRA_ASSERT(index < size());
  const YAML::Node found = node_->node[index];
  std::vector<double> values;
  if (!found.IsSequence()) {
    Problem(index, "config.wrong_type",
            fmt::format("item {} of '{}' is {}; a list of numbers was expected", index + 1, path_, KindOf(found)));
    return values;
  }
  for (const auto& item : found) {
    const auto value = item.IsScalar() ? ToNumber(item.Scalar()) : std::nullopt;
    if (!value)
      context_->Add(LineOf(item), fmt::format("{}[{}]", path_, index), "config.wrong_type",
                    fmt::format("'{}[{}]' holds {}; numbers were expected", path_, index, KindOf(item)));
    values.push_back(value.value_or(0.0));
  }
  return values;
}

}  // namespace rodeira::config
