// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"

// YAML files written by people. A reader asks a Map for its keys, with unit in the key's name and range in the
// question; every problem is collected with file:line, and File::Finish() gives them all, unknown keys included.
namespace rodeira::config {

// Closed interval of allowed values; NaN and infinities are never allowed.
struct Range {
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();

  static Range Positive() { return {std::numeric_limits<double>::min(), std::numeric_limits<double>::max()}; }
  static Range NotNegative() { return {0.0, std::numeric_limits<double>::max()}; }
};

namespace detail {
struct Context;
struct YamlNode;
}  // namespace detail

class List;

// One YAML mapping. An absent optional child gives a Map without keys; asking a required key of it is a problem.
class Map {
 public:
  bool Has(std::string_view key) const;

  double Number(std::string_view key, Range range = {}) const;
  double Number(std::string_view key, Range range, double default_value) const;
  std::int64_t Integer(std::string_view key, std::int64_t low, std::int64_t high) const;
  std::int64_t Integer(std::string_view key, std::int64_t low, std::int64_t high, std::int64_t default_value) const;
  bool Flag(std::string_view key, bool default_value) const;
  std::string Text(std::string_view key) const;
  std::string Text(std::string_view key, std::string_view default_value) const;
  // One of the allowed words, or a problem that names the nearest.
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed) const;
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed,
                     std::string_view default_value) const;
  // A path, taken relative to the file that names it.
  std::filesystem::path Path(std::string_view key) const;
  std::optional<std::filesystem::path> OptionalPath(std::string_view key) const;
  std::vector<double> Numbers(std::string_view key, Range range = {}) const;

  Map Child(std::string_view key) const;          // required
  Map OptionalChild(std::string_view key) const;  // empty where absent
  List Items(std::string_view key) const;         // required sequence
  List OptionalItems(std::string_view key) const;
  // Marks a key as known without looking into it: somebody else reads what stands there.
  void IgnoreKey(std::string_view key) const;
  // The text at the end of a way of keys, without asking for it: it is somebody else's, who says what is wrong with it.
  // Nothing where there is none.
  std::optional<std::string> Peek(std::initializer_list<std::string_view> way) const;
  // All keys in the file's order, for mappings whose keys are names (nodes, materials). Marks them as known.
  std::vector<std::string> Keys() const;

  // "file:line" of this mapping, or of one of its keys.
  std::string Place() const;
  std::string Place(std::string_view key) const;
  // Adds a problem found by the caller (values that do not fit together) at one of the keys.
  void Problem(std::string_view key, std::string message) const;

 private:
  friend class File;
  friend class List;
  Map(std::shared_ptr<detail::Context> context, std::shared_ptr<detail::YamlNode> node, std::string path);

  void Missing(std::string_view key, std::string_view expected) const;
  template <class T>
  std::optional<T> Scalar(std::string_view key, bool required, std::string_view expected) const;
  std::optional<double> Checked(std::string_view key, std::optional<double> value, Range range) const;

  std::shared_ptr<detail::Context> context_;
  std::shared_ptr<detail::YamlNode> node_;
  std::string path_;
};

// One YAML sequence.
class List {
 public:
  std::size_t size() const;
  Map At(std::size_t index) const;  // the item must be a mapping
  double Number(std::size_t index, Range range = {}) const;
  std::string Text(std::size_t index) const;
  std::vector<double> Numbers(std::size_t index) const;  // the item must be a sequence of numbers
  std::string Place(std::size_t index) const;
  void Problem(std::size_t index, std::string message) const;

 private:
  friend class Map;
  List(std::shared_ptr<detail::Context> context, std::shared_ptr<detail::YamlNode> node, std::string path);

  std::shared_ptr<detail::Context> context_;
  std::shared_ptr<detail::YamlNode> node_;
  std::string path_;
};

class File {
 public:
  // Reads and parses; wrong input where the file is missing, is no YAML or is no mapping at its top.
  static base::Result<File> Load(const std::filesystem::path& path);
  // The same from a text; `name` stands for the path in messages, and relative paths start at its folder.
  static base::Result<File> Parse(std::string_view text, const std::filesystem::path& name);

  // Sets `key` ("nodes.ego.period_s") to a YAML value, as `--set KEY=VALUE` does, before anything is read. Mappings on
  // the way are made. Nothing (`~`) takes the key out. Wrong input where the value is no YAML or the way is blocked.
  base::Status Override(std::string_view key, std::string_view value);

  Map root() const;
  // All problems so far and every key that nobody asked for, in the order of lines. A key that is missing because it is
  // misspelt, or stands there in another unit, is told of once.
  std::vector<base::Error> Problems() const;
  // The first of them, or ok.
  base::Status Finish() const;
  // Every scalar value of the file as it is now, overrides included, in the file's order: where paths may stand.
  std::vector<std::string> Scalars() const;
  const std::string& text() const;
  const std::filesystem::path& path() const;

 private:
  explicit File(std::shared_ptr<detail::Context> context);
  std::shared_ptr<detail::Context> context_;
};

}  // namespace rodeira::config
