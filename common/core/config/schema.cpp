// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

Key OptionalNumberKey(std::string name, Range range, std::string meaning) {
  return {std::move(name), ValueType::kNumber, std::move(meaning), false, range};
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

Key OptionalIntegerKey(std::string name, std::int64_t low, std::int64_t high, std::string meaning) {
  Key key = RequiredIntegerKey(std::move(name), low, high, std::move(meaning));
  key.required = false;
  return key;
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

Key OptionalWordKey(std::string name, std::vector<std::string> words, std::string meaning) {
  Key key{std::move(name), ValueType::kWord, std::move(meaning)};
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

Key KindsItem(Key word, std::vector<Key> kinds) {
  RODEIRA_ASSERT(word.type == ValueType::kWord && word.words.size() == kinds.size());
  Key key{"", ValueType::kKinds, ""};
  key.of.push_back(std::move(word));
  for (Key& kind : kinds) {
    RODEIRA_ASSERT(kind.type == ValueType::kMapping && kind.name == key.of.front().words[key.of.size() - 1]);
    key.of.push_back(std::move(kind));
  }
  return key;
}

Key ListKey(std::string name, Key item, std::string meaning) {
  Key key{std::move(name), ValueType::kList, std::move(meaning)};
  key.of.push_back(std::move(item));
  return key;
}

Key ListKey(std::string name, std::vector<Key> keys, std::string meaning) {
  return ListKey(std::move(name), MappingKey("", std::move(keys), ""), std::move(meaning));
}

Key NumberItem(Range range) { return OptionalNumberKey("", range, ""); }

Key TextItem(std::string sample) {
  Key key{"", ValueType::kText, ""};
  key.sample = std::move(sample);
  return key;
}

Key WordItem(std::vector<std::string> words) { return OptionalWordKey("", std::move(words), ""); }

Key OtherKey(std::string name, std::string form, std::string sample, std::string meaning, std::vector<Key> keys) {
  Key key{std::move(name), ValueType::kOther, std::move(meaning)};
  key.form = std::move(form);
  key.of = std::move(keys);
  key.sample = std::move(sample);
  return key;
}

Key Counted(std::size_t low, std::size_t high, Key list) {
  RODEIRA_ASSERT(list.type == ValueType::kList && low <= high);
  list.min_items = low;
  list.max_items = high;
  return list;
}

Key Summarised(std::string summary, Key key) {
  RODEIRA_ASSERT(key.type == ValueType::kMapping || key.type == ValueType::kWord);
  key.summary = std::move(summary);
  return key;
}

Key WithDefaultNote(std::string default_note, Key key) {
  RODEIRA_ASSERT(!key.required && std::holds_alternative<std::monostate>(key.default_value));
  key.default_note = std::move(default_note);
  return key;
}

Key WithSample(std::string sample, Key key) {
  key.sample = std::move(sample);
  return key;
}

Key Since(std::string version, Key key) {
  key.since = std::move(version);
  return key;
}

Key Renamed(std::string former_name, Key key) {
  RODEIRA_ASSERT(key.type == ValueType::kNumber && std::holds_alternative<double>(key.default_value));
  key.former_name = std::move(former_name);
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

// `brief`: a mapping with a summary is one entry.
void CollectValues(const Key& key, const std::string& path, const Key* container, bool brief,
                   std::vector<PlacedKey>& out) {
  if (brief && key.type == ValueType::kMapping && !key.summary.empty()) return out.push_back({path, &key, nullptr});
  switch (key.type) {
    case ValueType::kMapping:
      for (const Key& child : key.of) CollectValues(child, path + "." + child.name, nullptr, brief, out);
      return;
    case ValueType::kNamed:
      CollectValues(key.of.front(), path + ".NAME", &key, brief, out);
      return;
    case ValueType::kList:
      CollectValues(key.of.front(), path + "[]", &key, brief, out);
      return;
    case ValueType::kKinds:
      CollectValues(key.of.front(), path + "." + key.of.front().name, nullptr, brief, out);
      for (std::size_t i = 1; i < key.of.size(); ++i)
        CollectValues(key.of[i], path + "(" + key.of[i].name + ")", nullptr, brief, out);
      return;
    case ValueType::kOther:
      out.push_back({path, &key, container});
      for (const Key& child : key.of) CollectValues(child, path + "." + child.name, nullptr, brief, out);
      return;
    default:
      out.push_back({path, &key, container});
  }
}

// At most six digits, where more would only show the rounding.
std::string NumberCell(double value) {
  const std::string text = fmt::format("{}", value);
  return text.size() > 12 ? fmt::format("{:.6g}", value) : text;
}

std::string HighCell(double high) {
  const double next = std::nextafter(high, Range{}.high);
  return next == std::round(next) && high != std::round(high) ? "below " + NumberCell(next) : NumberCell(high);
}

std::string ItemsCell(const Key& list) {
  const bool high = list.max_items < std::numeric_limits<std::size_t>::max();
  if (high && list.min_items == list.max_items) return fmt::format("{} items", list.max_items);
  if (high) return fmt::format("{} to {} items", list.min_items, list.max_items);
  return list.min_items > 0 ? fmt::format("{} or more items", list.min_items) : "";
}

}  // namespace

std::vector<PlacedKey> ValuesOf(const Schema& schema) {
  std::vector<PlacedKey> values;
  for (const Key& key : schema.keys) CollectValues(key, key.name, nullptr, false, values);
  return values;
}

std::vector<PlacedKey> RowsOf(const Schema& schema) {
  std::vector<PlacedKey> rows;
  for (const Key& key : schema.keys) CollectValues(key, key.name, nullptr, true, rows);
  return rows;
}

namespace {

std::string RangeOf(const Key& key) {
  switch (key.type) {
    case ValueType::kNumber:
    case ValueType::kInteger: {
      const bool low = key.range.low > Range{}.low, high = key.range.high < Range{}.high;
      const bool positive = key.range.low == Range::Positive().low;
      if (low && high) return (positive ? "over 0" : NumberCell(key.range.low)) + " to " + HighCell(key.range.high);
      if (positive) return "over 0";
      if (low) return "from " + NumberCell(key.range.low);
      return high ? "to " + HighCell(key.range.high) : "";
    }
    case ValueType::kFlag:
      return "true, false";
    case ValueType::kWord:
      return key.summary.empty() ? fmt::format("{}", fmt::join(key.words, ", ")) : key.summary;
    case ValueType::kOther:
      return key.form;
    case ValueType::kMapping:
      return key.summary;
    default:
      return "";
  }
}

}  // namespace

std::string RangeCell(const PlacedKey& placed) {
  const std::string range = RangeOf(*placed.key);
  const std::string items = placed.container != nullptr ? ItemsCell(*placed.container) : "";
  return range.empty() || items.empty() ? range + items : items + ", " + range;
}

std::string MeaningCell(const PlacedKey& placed) {
  const bool items = placed.key->meaning.empty() && placed.container != nullptr;
  const Key& key = items ? *placed.container : *placed.key;
  std::string cell = key.meaning;
  if (!key.since.empty()) cell += fmt::format(" Since {}.", key.since);
  if (!key.former_name.empty()) cell += fmt::format(" Formerly `{}`.", key.former_name);
  return cell;
}

std::string DefaultCell(const PlacedKey& placed) {
  const Key& key = placed.container != nullptr ? *placed.container : *placed.key;
  if (key.required) return "required";
  if (!key.default_note.empty()) return key.default_note;
  if (const double* number = std::get_if<double>(&key.default_value)) return NumberCell(*number);
  if (const std::int64_t* number = std::get_if<std::int64_t>(&key.default_value)) return fmt::format("{}", *number);
  if (const bool* flag = std::get_if<bool>(&key.default_value)) return *flag ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&key.default_value)) return *text;
  return "";
}

}  // namespace rodeira::config
