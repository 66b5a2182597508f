// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/core/base/json_text.hpp"
#include "common/core/config/schema.hpp"

namespace rodeira::config {
namespace {

// A default value as JSON.
std::string JsonOf(const DefaultValue& value) {
  if (const double* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const std::int64_t* number = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *number);
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&value)) return base::JsonText(*text);
  return "null";
}

std::string JsonValue(const Key& key, const std::string& indent);

// The members of the object that describes a mapping with the keys.
std::string JsonMapping(const std::vector<Key>& keys, const std::string& indent, bool is_open = false) {
  std::vector<std::string> properties, required;
  for (const Key& key : keys) {
    properties.push_back(fmt::format("{}  {}: {}", indent, base::JsonText(key.name), JsonValue(key, indent + "  ")));
    if (key.required) required.push_back(base::JsonText(key.name));
    if (!key.former_name.empty()) {
      properties.push_back(
          fmt::format("{0}  {1}: {{\n{0}    \"description\": {2},\n{0}    \"deprecated\": true\n{0}  }}", indent,
                      base::JsonText(key.former_name), base::JsonText(fmt::format("Former name of `{}`.", key.name))));
    }
  }
  return fmt::format(
      "{0}\"type\": \"object\",\n{0}\"properties\": {{\n{1}\n{0}}},\n{2}{0}\"additionalProperties\": {3}", indent,
      fmt::join(properties, ",\n"),
      required.empty() ? "" : fmt::format("{}\"required\": [{}],\n", indent, fmt::join(required, ", ")), is_open);
}

std::string JsonValue(const Key& key, const std::string& indent) {
  std::vector<std::string> members;
  const std::string inner = indent + "  ";
  if (!key.meaning.empty()) members.push_back(fmt::format("{}\"description\": {}", inner, base::JsonText(key.meaning)));
  if (!key.name.empty())
    members.push_back(fmt::format("{}\"$comment\": \"since {}\"", inner,
                                  key.since.empty() ? kFirstVersion : std::string_view(key.since)));
  switch (key.type) {
    case ValueType::kNumber:
    case ValueType::kInteger:
      members.push_back(
          fmt::format("{}\"type\": \"{}\"", inner, key.type == ValueType::kNumber ? "number" : "integer"));
      if (key.range.low == Range::Positive().low)
        members.push_back(inner + "\"exclusiveMinimum\": 0");
      else if (key.range.low > Range{}.low)
        members.push_back(fmt::format("{}\"minimum\": {}", inner, key.range.low));
      if (key.range.high < Range{}.high) members.push_back(fmt::format("{}\"maximum\": {}", inner, key.range.high));
      break;
    case ValueType::kFlag:
      members.push_back(inner + "\"type\": \"boolean\"");
      break;
    case ValueType::kText:  // a name may look like a number
      members.push_back(inner + "\"type\": [\"string\", \"number\", \"boolean\"]");
      break;
    case ValueType::kWord: {
      std::vector<std::string> words;
      for (const std::string& word : key.words) {
        words.push_back(base::JsonText(word));
        if (word == "true" || word == "false") words.push_back(word);  // as YAML reads it
      }
      members.push_back(fmt::format("{}\"enum\": [{}]", inner, fmt::join(words, ", ")));
      break;
    }
    case ValueType::kMapping:
      members.push_back(JsonMapping(key.of, inner));
      break;
    case ValueType::kNamed:
      members.push_back(inner + "\"type\": \"object\"");
      members.push_back(fmt::format("{}\"additionalProperties\": {}", inner, JsonValue(key.of.front(), inner)));
      break;
    case ValueType::kList:
      members.push_back(inner + "\"type\": \"array\"");
      members.push_back(fmt::format("{}\"items\": {}", inner, JsonValue(key.of.front(), inner)));
      if (key.min_items > 0) members.push_back(fmt::format("{}\"minItems\": {}", inner, key.min_items));
      if (key.max_items < std::numeric_limits<std::size_t>::max())
        members.push_back(fmt::format("{}\"maxItems\": {}", inner, key.max_items));
      break;
    case ValueType::kKinds: {
      std::vector<std::string> kinds;
      for (std::size_t i = 1; i < key.of.size(); ++i) {
        std::vector<Key> keys{key.of.front()};
        keys.front().words = {key.of[i].name};
        keys.front().default_value = {};
        keys.insert(keys.end(), key.of[i].of.begin(), key.of[i].of.end());
        kinds.push_back(fmt::format("{0}  {{\n{1}\n{0}  }}", inner, JsonMapping(keys, inner + "    ")));
      }
      members.push_back(fmt::format("{0}\"anyOf\": [\n{1}\n{0}]", inner, fmt::join(kinds, ",\n")));
      break;
    }
    case ValueType::kOther:
      break;
  }
  if (!std::holds_alternative<std::monostate>(key.default_value))
    members.push_back(fmt::format("{}\"default\": {}", inner, JsonOf(key.default_value)));
  return fmt::format("{{\n{}\n{}}}", fmt::join(members, ",\n"), indent);
}

}  // namespace

std::string SchemaText(const Schema& schema) {
  std::string out =
      fmt::format("rodeira: {}\n{}\nKeys are there since version {}, unless their row says another one.\n\n",
                  schema.format, schema.meaning, kFirstVersion);
  const auto values = RowsOf(schema);
  std::size_t path = 3, default_value = 7, range = 5;
  for (const PlacedKey& value : values) {
    path = std::max(path, value.path.size());
    default_value = std::max(default_value, DefaultCell(value).size());
    range = std::max(range, RangeCell(value).size());
  }
  const auto row = [&](std::string_view a, std::string_view b, std::string_view c, std::string_view d) {
    out += fmt::format("{:<{}}  {:<{}}  {:<{}}  {}\n", a, path, b, default_value, c, range, d);
  };
  row("key", "default", "range", "meaning");
  for (const PlacedKey& value : values) row(value.path, DefaultCell(value), RangeCell(value), MeaningCell(value));
  return out;
}

std::string SchemaMarkdown(const Schema& schema) {
  std::string out = "| key | default | range | meaning |\n|---|---|---|---|\n";
  for (const PlacedKey& value : RowsOf(schema)) {
    const auto cell = [](const std::string& text) { return text.empty() ? std::string(" ") : " " + text + " "; };
    out += fmt::format("| `{}` |{}|{}| {} |\n", value.path, cell(DefaultCell(value)), cell(RangeCell(value)),
                       MeaningCell(value));
  }
  return out;
}

std::string SchemaJson(const Schema& schema) {
  return fmt::format(
      "{{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n  \"title\": {},\n  \"description\": {},\n"
      "{}\n}}\n",
      base::JsonText("Rodeira " + schema.format), base::JsonText(schema.meaning),
      JsonMapping(schema.keys, "  ", schema.is_open));
}

}  // namespace rodeira::config
