// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/base/assert.hpp"

namespace rodeira::config {

Key NumberKey(std::string name, Range range, double default_value, std::string meaning) {
  RODEIRA_ASSERT(default_value >= range.low && default_value <= range.high);
  return {std::move(name), ValueType::kNumber, std::move(meaning), false, range, default_value};
}

Key RequiredNumberKey(std::string name, Range range, std::string meaning) {
  return {std::move(name), ValueType::kNumber, std::move(meaning), true, range};
}

Key ComputedNumberKey(std::string name, Range range, std::string default_note, std::string meaning) {
  Key key{std::move(name), ValueType::kNumber, std::move(meaning), false, range};
  key.default_note = std::move(default_note);
  return key;
}

Key IntegerKey(std::string name, std::int64_t low, std::int64_t high, std::int64_t default_value, std::string meaning) {
  RODEIRA_ASSERT(default_value >= low && default_value <= high);
  return {std::move(name),
          ValueType::kInteger,
          std::move(meaning),
          false,
          Range{static_cast<double>(low), static_cast<double>(high)},
          default_value};
}

Key RequiredIntegerKey(std::string name, std::int64_t low, std::int64_t high, std::string meaning) {
  return {std::move(name), ValueType::kInteger, std::move(meaning), true,
          Range{static_cast<double>(low), static_cast<double>(high)}};
}

Key FlagKey(std::string name, bool default_value, std::string meaning) {
  return {std::move(name), ValueType::kFlag, std::move(meaning), false, {}, default_value};
}

Key TextKey(std::string name, std::string default_value, std::string meaning) {
  return {std::move(name), ValueType::kText, std::move(meaning), false, {}, std::move(default_value)};
}

Key RequiredTextKey(std::string name, std::string sample, std::string meaning) {
  Key key{std::move(name), ValueType::kText, std::move(meaning), true};
  key.sample = std::move(sample);
  return key;
}

Key ComputedTextKey(std::string name, std::string default_note, std::string sample, std::string meaning) {
  Key key = RequiredTextKey(std::move(name), std::move(sample), std::move(meaning));
  key.required = false;
  key.default_note = std::move(default_note);
  return key;
}

Key WordKey(std::string name, std::vector<std::string> words, std::string default_value, std::string meaning) {
  RODEIRA_ASSERT(std::ranges::find(words, default_value) != words.end());
  Key key{std::move(name), ValueType::kWord, std::move(meaning), false, {}, std::move(default_value)};
  key.words = std::move(words);
  return key;
}

Key MappingKey(std::string name, std::vector<Key> keys, std::string meaning) {
  Key key{std::move(name), ValueType::kMapping, std::move(meaning)};
  key.of = std::move(keys);
  return key;
}

Key NamedKey(std::string name, std::vector<Key> keys, std::string meaning) {
  return NamedValueKey(std::move(name), MappingKey("", std::move(keys), ""), std::move(meaning));
}

Key NamedValueKey(std::string name, Key value, std::string meaning) {
  Key key{std::move(name), ValueType::kNamed, std::move(meaning)};
  key.of.push_back(std::move(value));
  return key;
}

Key Required(Key key) {
  key.required = true;
  key.default_value = {};
  key.default_note.clear();
  return key;
}

std::vector<Key> FileKeys(const std::string& format, std::vector<Key> keys) {
  std::vector<Key> all;
  all.push_back(Required(WordKey("rodeira", {format}, format, "Kind and version of the file.")));
  all.insert(all.end(), std::make_move_iterator(keys.begin()), std::make_move_iterator(keys.end()));
  return all;
}

const Key* FindKey(const std::vector<Key>& keys, std::string_view name) {
  const auto found = std::ranges::find(keys, name, &Key::name);
  return found == keys.end() ? nullptr : &*found;
}

namespace {

void CollectValues(const Key& key, const std::string& path, std::vector<PlacedKey>& out) {
  switch (key.type) {
    case ValueType::kMapping:
      for (const Key& child : key.of) CollectValues(child, path.empty() ? child.name : path + "." + child.name, out);
      return;
    case ValueType::kNamed:
      CollectValues(key.of.front(), path + ".NAME", out);
      return;
    default:
      out.push_back({path, &key});
  }
}

}  // namespace

std::vector<PlacedKey> ValuesOf(const Schema& schema) {
  std::vector<PlacedKey> values;
  for (const Key& key : schema.keys) CollectValues(key, key.name, values);
  return values;
}

std::string RangeCell(const Key& key) {
  switch (key.type) {
    case ValueType::kNumber:
    case ValueType::kInteger: {
      const bool low = key.range.low > Range{}.low, high = key.range.high < Range{}.high;
      if (low && high) return fmt::format("{} to {}", key.range.low, key.range.high);
      if (low && key.range.low == Range::Positive().low) return "over 0";
      if (low) return fmt::format("from {}", key.range.low);
      return high ? fmt::format("to {}", key.range.high) : "";
    }
    case ValueType::kFlag:
      return "true, false";
    case ValueType::kWord:
      return fmt::format("{}", fmt::join(key.words, ", "));
    default:
      return "";
  }
}

std::string DefaultCell(const Key& key) {
  if (key.required) return "required";
  if (!key.default_note.empty()) return key.default_note;
  if (const double* number = std::get_if<double>(&key.default_value)) return fmt::format("{}", *number);
  if (const std::int64_t* number = std::get_if<std::int64_t>(&key.default_value)) return fmt::format("{}", *number);
  if (const bool* flag = std::get_if<bool>(&key.default_value)) return *flag ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&key.default_value)) return *text;
  return "";
}

}  // namespace rodeira::config
