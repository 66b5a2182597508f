// SPDX-License-Identifier: Apache-2.0
#pragma once

// Files that are generated from the declared keys of a kind of file: each key at its default, at both bounds, beyond
// them and with a wrong type.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::config {

// YAML values by path ("hosts.NAME.address").
using Values = std::map<std::string, std::string>;

// A file with the values, and with a valid value for every other key that is required.
class SampleFile {
 public:
  SampleFile(const Schema& schema, Values values, std::string left_out = "")
      : values_(std::move(values)), left_out_(std::move(left_out)), text_(Mapping(schema.keys, "") + "\n") {}
  const std::string& text() const { return text_; }

 private:
  // Whether `path` is `part` or leads to it.
  static bool LeadsTo(const std::string& part, const std::string& path) {
    return path.starts_with(part) &&
           (path.size() == part.size() || path[part.size()] == '.' || path[part.size()] == '[');
  }
  bool Has(const std::string& path) const {
    return LeadsTo(path, left_out_) ||
           std::ranges::any_of(values_, [&](const auto& value) { return LeadsTo(path, value.first); });
  }
  std::string Mapping(const std::vector<Key>& keys, const std::string& prefix) const {
    std::vector<std::string> entries;
    for (const Key& key : keys) {
      const std::string path = prefix + key.name;
      if (path == left_out_ || !(key.required || Has(path))) continue;
      entries.push_back(fmt::format("{}: {}", key.name, Value(key, path)));
    }
    return fmt::format("{{{}}}", fmt::join(entries, ", "));
  }
  std::string Value(const Key& key, const std::string& path) const {
    if (const auto given = values_.find(path); given != values_.end()) return given->second;
    switch (key.type) {
      case ValueType::kMapping:
        return Mapping(key.of, path + ".");
      case ValueType::kNamed:
        return fmt::format("{{a: {}}}", Value(key.of.front(), path + ".NAME"));
      case ValueType::kWord:
        return key.words.front();
      case ValueType::kFlag:
        return "true";
      case ValueType::kText:
        return key.sample;
      default:
        return fmt::format("{}", std::max(key.range.low, std::min(key.range.high, 1.0)));
    }
  }

  Values values_;
  std::string left_out_;
  std::string text_;
};

// Reads a text as the kind of file: the first problem's sentence, empty without one.
using ReadText = std::function<std::string(const std::string&)>;
// What else stands in the file where a key is tried, by the key's path: keys that it needs, or fits together with.
using Companions = std::map<std::string, Values>;

// The bounds of the keys in `no_bounds` are not tried: another key forbids them in every file.
inline void ExpectEveryKey(const Schema& schema, const ReadText& read, const Companions& companions = {},
                           const std::set<std::string>& no_bounds = {}) {
  ASSERT_FALSE(ValuesOf(schema).empty());
  for (const PlacedKey& placed : ValuesOf(schema)) {
    const Key& key = *placed.key;
    const auto with = [&](const std::string& value) {
      Values values;
      if (const auto others = companions.find(placed.path); others != companions.end()) values = others->second;
      values[placed.path] = value;
      return SampleFile(schema, values).text();
    };
    const auto accepted = [&](const std::string& value) { EXPECT_EQ(read(with(value)), "") << with(value); };
    const auto refused = [&](const std::string& text) {
      const std::string problem = read(text);
      EXPECT_NE(problem.find(key.name), std::string::npos) << text << "  was told: " << problem;
    };
    refused(with("[[1]]"));
    if (key.required) refused(SampleFile(schema, {}, placed.path).text());
    const bool has_default = !std::holds_alternative<std::monostate>(key.default_value);
    if (has_default && key.type != ValueType::kText) accepted(DefaultCell(key));
    if (key.type == ValueType::kWord) {
      for (const std::string& word : key.words) accepted(word);
      refused(with("no_such_word"));
    }
    if (key.type == ValueType::kText && !key.sample.empty()) accepted(key.sample);
    if (key.type == ValueType::kFlag) {
      accepted("true");
      accepted("false");
      refused(with("3"));
    }
    if (key.type != ValueType::kNumber && key.type != ValueType::kInteger) continue;
    refused(with("abc"));
    if (no_bounds.contains(placed.path)) continue;
    const double inf = std::numeric_limits<double>::infinity();
    const bool whole = key.type == ValueType::kInteger;
    if (whole) refused(with(fmt::format("{}", key.range.low + 0.5)));
    if (key.range.low > Range{}.low) {
      accepted(fmt::format("{}", key.range.low));
      refused(with(fmt::format("{}", whole ? key.range.low - 1.0 : std::nextafter(key.range.low, -inf))));
    }
    if (key.range.high < Range{}.high) {
      accepted(fmt::format("{}", key.range.high));
      refused(with(fmt::format("{}", whole ? key.range.high + 1.0 : std::nextafter(key.range.high, inf))));
    }
  }
}

}  // namespace rodeira::config
