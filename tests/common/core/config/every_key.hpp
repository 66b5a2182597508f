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

// YAML values by path ("hosts.NAME.address"); an empty one leaves the key out.
using Values = std::map<std::string, std::string>;

// A file with the values, and with a valid value for every other key that is required.
class SampleFile {
 public:
  SampleFile(const Schema& schema, Values values, std::string left_out = "")
      : values_(std::move(values)), left_out_(std::move(left_out)), text_(Mapping(schema.keys, "") + "\n") {}
  const std::string& text() const { return text_; }
  // The value of a key at a path, as it stands in the file or would stand there.
  std::string Value(const Key& key, const std::string& path) const {
    if (const auto given = values_.find(path); given != values_.end()) return given->second;
    switch (key.type) {
      case ValueType::kMapping:
        return Mapping(key.of, path + ".");
      case ValueType::kNamed:
        return fmt::format("{{{}: {}}}", key.sample.empty() ? "a" : key.sample, Value(key.of.front(), path + ".NAME"));
      case ValueType::kKinds:
        return OneKind(key, path);
      case ValueType::kList:
        if (!key.sample.empty() && !IsGiven(path)) return key.sample;
        return fmt::format("[{}]", fmt::join(std::vector<std::string>(std::max<std::size_t>(key.min_items, 1),
                                                                      Value(key.of.front(), path + "[]")),
                                             ", "));
      case ValueType::kWord:
        return key.sample.empty() ? key.words.front() : key.sample;
      case ValueType::kFlag:
        return "true";
      case ValueType::kOther:
        return IsGiven(path) ? Mapping(key.of, path + ".") : key.sample;
      case ValueType::kText:
        return key.sample;
      default:
        if (!key.sample.empty()) return key.sample;
        return fmt::format("{}", std::max(key.range.low, std::min(key.range.high, 1.0)));
    }
  }

 private:
  // Whether `path` is `part` or leads to it.
  static bool LeadsTo(const std::string& part, const std::string& path) {
    return path.starts_with(part) && (path.size() == part.size() || path[part.size()] == '.' ||
                                      path[part.size()] == '[' || path[part.size()] == '(');
  }
  bool IsGiven(const std::string& path) const {
    return std::ranges::any_of(values_, [&](const auto& value) { return LeadsTo(path, value.first); });
  }
  bool Has(const std::string& path) const { return LeadsTo(path, left_out_) || IsGiven(path); }
  // A mapping of the kind that a path names or a word gives, else of the first kind.
  std::string OneKind(const Key& key, const std::string& path) const {
    const Key& word = key.of.front();
    const std::string word_path = path + "." + word.name;
    const auto given = values_.find(word_path);
    const Key* kind = &key.of.at(1);
    for (std::size_t i = 1; i < key.of.size(); ++i) {
      if ((given != values_.end() && given->second == key.of[i].name) || Has(path + "(" + key.of[i].name + ")"))
        kind = &key.of[i];
    }
    Key required = word;
    required.required = true;
    required.sample = kind->name;
    std::string first = Mapping({required}, path + ".");
    std::string rest = Mapping(kind->of, path + "(" + kind->name + ").");
    if (first == "{}" || rest == "{}") return first == "{}" ? rest : first;
    return first.substr(0, first.size() - 1) + ", " + rest.substr(1);
  }
  std::string Mapping(const std::vector<Key>& keys, const std::string& prefix) const {
    std::vector<std::string> entries;
    for (const Key& key : keys) {
      const std::string path = prefix + key.name;
      const bool sampled = key.type == ValueType::kMapping && !key.sample.empty();
      if (path == left_out_ || !(key.required || sampled || Has(path))) continue;
      if (const auto given = values_.find(path); given != values_.end() && given->second.empty()) continue;
      entries.push_back(fmt::format("{}: {}", key.name, Value(key, path)));
    }
    return fmt::format("{{{}}}", fmt::join(entries, ", "));
  }

  Values values_;
  std::string left_out_;
  std::string text_;
};

// Reads a text as the kind of file: the first problem's sentence, empty without one.
using ReadText = std::function<std::string(const std::string&)>;
// What else stands in the file where a key is tried, by the key's path or "path=value": keys that it needs, or fits
// together with.
using Companions = std::map<std::string, Values>;

// Mappings and lists with their paths: where a number is refused.
inline void CollectContainers(const std::vector<Key>& keys, const std::string& prefix, std::vector<PlacedKey>& out) {
  for (const Key& key : keys) {
    const std::string path = prefix + key.name;
    if (key.type == ValueType::kMapping) {
      out.push_back({path, &key});
      CollectContainers(key.of, path + ".", out);
    } else if (key.type == ValueType::kNamed || key.type == ValueType::kList) {
      out.push_back({path, &key});
      CollectContainers(key.of, path + (key.type == ValueType::kList ? "[]" : ".NAME"), out);
    } else if (key.type == ValueType::kKinds) {
      out.push_back({path, &key});
      for (std::size_t i = 1; i < key.of.size(); ++i)
        CollectContainers(key.of[i].of, path + "(" + key.of[i].name + ").", out);
    }
  }
}

// The last name of a path: "phases" of "lights.NAME.phases[]".
inline std::string LastName(std::string path) {
  for (const std::string& end : {std::string("[]"), std::string(".NAME"), std::string("[]")}) {
    if (path.ends_with(end)) path.resize(path.size() - end.size());
  }
  return path.substr(path.rfind('.') + 1);
}

// Another key forbids the bounds of the keys in `no_bounds` in every file; only numbers beyond them are tried.
class EveryKey {
 public:
  EveryKey(const Schema& schema, const ReadText& read, const Companions& companions,
           const std::set<std::string>& no_bounds)
      : schema_(schema), read_(read), companions_(companions), no_bounds_(no_bounds) {}

  void Try() const {
    ASSERT_FALSE(ValuesOf(schema_).empty());
    for (const PlacedKey& placed : ValuesOf(schema_)) TryValue(placed);
    std::vector<PlacedKey> containers;
    CollectContainers(schema_.keys, "", containers);
    for (const PlacedKey& placed : containers) TryContainer(placed);
  }

 private:
  Values Others(const std::string& path) const {
    const auto others = companions_.find(path);
    return others == companions_.end() ? Values() : others->second;
  }
  static constexpr const char* kNoWord = "no_such_word";

  std::string With(const std::string& path, const std::string& value) const {
    const std::string both = path + "=" + value;
    Values values = Others(companions_.contains(both) ? both : path);
    values[path] = value;
    return SampleFile(schema_, values).text();
  }
  std::string Without(const std::string& path) const { return SampleFile(schema_, Others(path), path).text(); }
  void Accepted(const std::string& path, const std::string& value) const {
    EXPECT_EQ(read_(With(path, value)), "") << With(path, value);
  }
  void Refused(const std::string& path, const std::string& value) const { RefusedText(path, With(path, value)); }
  void RefusedText(const std::string& path, const std::string& text) const {
    const std::string problem = read_(text);
    EXPECT_NE(problem, "") << text;
    EXPECT_TRUE(problem.find(LastName(path)) != std::string::npos || problem.find(kNoWord) != std::string::npos)
        << text << "  was told: " << problem;
  }

  void TryValue(const PlacedKey& placed) const {
    const Key& key = *placed.key;
    const std::string& path = placed.path;
    if (key.type == ValueType::kOther) return Accepted(path, key.sample);
    Refused(path, "[[1]]");
    if (key.required && placed.container == nullptr) RefusedText(path, Without(path));
    const bool has_default = !std::holds_alternative<std::monostate>(key.default_value);
    if (has_default && key.type != ValueType::kText) Accepted(path, DefaultCell(placed));
    if (key.type == ValueType::kWord) {
      for (const std::string& word : key.words) Accepted(path, word);
      Refused(path, kNoWord);
    }
    if (key.type == ValueType::kText && !key.sample.empty()) Accepted(path, key.sample);
    if (key.type == ValueType::kFlag) {
      Accepted(path, "true");
      Accepted(path, "false");
      Refused(path, "3");
    }
    if (key.type == ValueType::kNumber || key.type == ValueType::kInteger) TryNumber(placed);
  }

  void TryNumber(const PlacedKey& placed) const {
    const Key& key = *placed.key;
    const std::string& path = placed.path;
    Refused(path, "abc");
    const bool reached = !no_bounds_.contains(path);
    const double inf = std::numeric_limits<double>::infinity();
    const bool whole = key.type == ValueType::kInteger;
    if (whole) Refused(path, fmt::format("{}", key.range.low + 0.5));
    if (key.range.low > Range{}.low) {
      if (reached) Accepted(path, fmt::format("{}", key.range.low));
      Refused(path, fmt::format("{}", whole ? key.range.low - 1.0 : std::nextafter(key.range.low, -inf)));
    }
    if (key.range.high < Range{}.high) {
      if (reached) Accepted(path, fmt::format("{}", key.range.high));
      Refused(path, fmt::format("{}", whole ? key.range.high + 1.0 : std::nextafter(key.range.high, inf)));
    }
  }

  void TryContainer(const PlacedKey& placed) const {
    const Key& key = *placed.key;
    if (key.name.empty())  // an item: other problems may come first
      EXPECT_NE(read_(With(placed.path, "3")), "") << With(placed.path, "3");
    else
      Refused(placed.path, "3");
    if (key.required && !key.name.empty()) RefusedText(placed.path, Without(placed.path));
    if (key.type != ValueType::kList) return;
    if (key.min_items > 0) Refused(placed.path, Items(placed, key.min_items - 1));
    if (key.max_items < std::numeric_limits<std::size_t>::max()) {
      Accepted(placed.path, Items(placed, key.max_items));
      Refused(placed.path, Items(placed, key.max_items + 1));
    }
  }

  // So many valid items.
  std::string Items(const PlacedKey& placed, std::size_t count) const {
    const std::string item = SampleFile(schema_, Others(placed.path)).Value(placed.key->of.front(), placed.path + "[]");
    return fmt::format("[{}]", fmt::join(std::vector<std::string>(count, item), ", "));
  }

  const Schema& schema_;
  const ReadText& read_;
  const Companions& companions_;
  const std::set<std::string>& no_bounds_;
};

inline void ExpectEveryKey(const Schema& schema, const ReadText& read, const Companions& companions = {},
                           const std::set<std::string>& no_bounds = {}) {
  EveryKey(schema, read, companions, no_bounds).Try();
}

}  // namespace rodeira::config
