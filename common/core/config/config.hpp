// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// YAML files that people write.

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

/// Reading of YAML files. A reader takes the keys from a Map; the unit is part of a key's name, the range is an
/// argument. Every problem is collected with file:line, and File::Problems gives them all, unknown keys included.
namespace rodeira::config {

/// Closed interval of allowed values. NaN and infinities are never allowed.
struct Range {
  double low = -std::numeric_limits<double>::max();  ///< smallest allowed value
  double high = std::numeric_limits<double>::max();  ///< largest allowed value

  /// Range of all numbers over zero.
  /// @return the range
  static Range Positive() { return {std::numeric_limits<double>::min(), std::numeric_limits<double>::max()}; }
  /// Range of zero and all numbers over zero.
  /// @return the range
  static Range NotNegative() { return {0.0, std::numeric_limits<double>::max()}; }
};

/// @cond
namespace detail {
struct Context;
struct YamlNode;
}  // namespace detail
/// @endcond

class List;

/// One YAML mapping. A required key that is missing, or a value that does not fit, is a problem of the file; the
/// function then returns a substitute that fits. An absent optional child is a Map without keys and without problems:
/// it gives the substitute for every key. A Map is a handle: copies refer to the same mapping and the same file.
class Map {
 public:
  /// Says whether the mapping has a key. It does not mark the key as known.
  /// @param key name of the key
  /// @return true if the key is there, whatever its value
  bool Has(std::string_view key) const;

  /// Reads a required number.
  /// @param key name of the key, with its unit
  /// @param range allowed values, in the unit of the key
  /// @return the number; the value of the range that is nearest to 0 if the key is missing or is no number
  double Number(std::string_view key, Range range = {}) const;
  /// Reads an optional number.
  /// @param key name of the key, with its unit
  /// @param range allowed values, in the unit of the key
  /// @param default_value value if the key is absent
  /// @return the number
  double Number(std::string_view key, Range range, double default_value) const;
  /// Reads a required whole number.
  /// @param key name of the key
  /// @param low smallest allowed value
  /// @param high largest allowed value
  /// @return the number; `low` if the key is missing
  std::int64_t Integer(std::string_view key, std::int64_t low, std::int64_t high) const;
  /// Reads an optional whole number.
  /// @param key name of the key
  /// @param low smallest allowed value
  /// @param high largest allowed value
  /// @param default_value value if the key is absent
  /// @return the number
  std::int64_t Integer(std::string_view key, std::int64_t low, std::int64_t high, std::int64_t default_value) const;
  /// Reads `true` or `false`.
  /// @param key name of the key
  /// @param default_value value if the key is absent
  /// @return the value
  bool Flag(std::string_view key, bool default_value) const;
  /// Reads a required text.
  /// @param key name of the key
  /// @return the text; empty if the key is missing
  std::string Text(std::string_view key) const;
  /// Reads an optional text.
  /// @param key name of the key
  /// @param default_value text if the key is absent
  /// @return the text
  std::string Text(std::string_view key, std::string_view default_value) const;
  /// Reads a required word. The problem of another word names the nearest allowed one.
  /// @param key name of the key
  /// @param allowed allowed words; at least one
  /// @return the word; the first allowed one if the key is missing or has another word
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed) const;
  /// Reads an optional word. The problem of another word names the nearest allowed one.
  /// @param key name of the key
  /// @param allowed allowed words
  /// @param default_value word if the key is absent
  /// @return the word
  std::string Choice(std::string_view key, const std::vector<std::string>& allowed,
                     std::string_view default_value) const;
  /// Reads a required path. A relative path is resolved against the folder of the file.
  /// @param key name of the key
  /// @return the path; empty if the key is missing. Whether the file exists is not tested.
  std::filesystem::path Path(std::string_view key) const;
  /// Reads an optional path. A relative path is resolved against the folder of the file.
  /// @param key name of the key
  /// @return the path, or nothing if the key is absent
  std::optional<std::filesystem::path> OptionalPath(std::string_view key) const;
  /// Reads a required list of numbers.
  /// @param key name of the key, with its unit
  /// @param range allowed values of each number, in the unit of the key
  /// @return the numbers
  std::vector<double> Numbers(std::string_view key, Range range = {}) const;

  /// Gives a required mapping.
  /// @param key name of the key
  /// @return the mapping; one without keys if it is missing
  Map Child(std::string_view key) const;
  /// Gives an optional mapping.
  /// @param key name of the key
  /// @return the mapping; one without keys if it is absent
  Map OptionalChild(std::string_view key) const;
  /// Gives a required list.
  /// @param key name of the key
  /// @return the list; an empty one if it is missing
  List Items(std::string_view key) const;
  /// Gives an optional list.
  /// @param key name of the key
  /// @return the list; an empty one if it is absent
  List OptionalItems(std::string_view key) const;
  /// Marks a key as known without reading it, because another reader reads it.
  /// @param key name of the key
  void IgnoreKey(std::string_view key) const;
  /// Reads the text at the end of a path of keys. It neither marks the keys as known nor adds a problem: another reader
  /// reads them.
  /// @param path names of the keys, from this mapping downward
  /// @return the text, or nothing if there is none
  std::optional<std::string> Peek(std::initializer_list<std::string_view> path) const;
  /// Lists all keys and marks them as known, for mappings with names as keys (nodes, materials).
  /// @return the keys in the order of the file
  std::vector<std::string> Keys() const;

  /// Gives the place of this mapping, for messages.
  /// @return "file:line"
  std::string Place() const;
  /// Gives the place of a key, for messages.
  /// @param key name of the key
  /// @return "file:line" of the key
  std::string Place(std::string_view key) const;
  /// Adds a problem that the caller found, such as values that do not fit together.
  /// @param key the key to locate
  /// @param id the kind of failure
  /// @param message one sentence: what was found, what was expected
  void Problem(std::string_view key, base::ErrorId id, std::string message) const;
  /// Adds a problem of the id "config.wrong_value".
  /// @param key the key to locate
  /// @param message one sentence: what was found, what was expected
  void Problem(std::string_view key, std::string message) const {
    Problem(key, "config.wrong_value", std::move(message));
  }

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

/// One YAML sequence. An index must be less than size(); another one is an assertion failure.
class List {
 public:
  /// Gives the number of items.
  /// @return number of items; 0 if the list is absent
  std::size_t size() const;
  /// Gives an item that must be a mapping; another one is a problem of the file.
  /// @param index index of the item, from 0
  /// @return the mapping; one without keys if the item is no mapping
  Map At(std::size_t index) const;
  /// Reads an item that must be a number.
  /// @param index index of the item, from 0
  /// @param range allowed values
  /// @return the number; the value of the range that is nearest to 0 if the item is no number
  double Number(std::size_t index, Range range = {}) const;
  /// Reads an item that must be a text.
  /// @param index index of the item, from 0
  /// @return the text; empty if the item is none
  std::string Text(std::size_t index) const;
  /// Reads an item that must be a list of numbers.
  /// @param index index of the item, from 0
  /// @return the numbers
  std::vector<double> Numbers(std::size_t index) const;
  /// Gives the place of an item, for messages. The index may be any number.
  /// @param index index of the item, from 0
  /// @return "file:line" of the item; the file alone if there is no such item
  std::string Place(std::size_t index) const;
  /// Adds a problem that the caller found. The index may be any number.
  /// @param index index of the item to locate
  /// @param id the kind of failure
  /// @param message one sentence: what was found, what was expected
  void Problem(std::size_t index, base::ErrorId id, std::string message) const;
  /// Adds a problem of the id "config.wrong_value".
  /// @param index index of the item to locate
  /// @param message one sentence: what was found, what was expected
  void Problem(std::size_t index, std::string message) const {
    Problem(index, "config.wrong_value", std::move(message));
  }

 private:
  friend class Map;
  List(std::shared_ptr<detail::Context> context, std::shared_ptr<detail::YamlNode> node, std::string path);

  std::shared_ptr<detail::Context> context_;
  std::shared_ptr<detail::YamlNode> node_;
  std::string path_;
};

/// A YAML file, its problems and the keys that were read. Functions of one file and of its maps and lists are called
/// from one thread at a time.
class File {
 public:
  /// Reads and parses a file.
  /// @param path path of the file
  /// @return the file; wrong input if it is missing, is no valid YAML or has no mapping at its top
  static base::Result<File> Load(const std::filesystem::path& path);
  /// Parses a text.
  /// @param text the YAML text
  /// @param name stands for the path in messages; relative paths are resolved against its folder
  /// @return the file; wrong input if the text is no valid YAML or has no mapping at its top
  static base::Result<File> Parse(std::string_view text, const std::filesystem::path& name);

  /// Sets a key, as `--set KEY=VALUE` does, before anything is read. Mappings on the path are made.
  /// @param key path of the key ("nodes.ego.period_s")
  /// @param value a YAML value; null (`~`) removes the key
  /// @return wrong input if the value is no valid YAML or a key on the path is no mapping
  base::Status Override(std::string_view key, std::string_view value);

  /// Gives the mapping at the top.
  /// @return the mapping
  Map root() const;
  /// Lists all problems so far and every key that was not read. A key that is misspelt, or has another unit, is listed
  /// once and not as missing, too.
  /// @return the problems in the order of lines
  std::vector<base::Error> Problems() const;
  /// Ends the reading.
  /// @return the first problem, or success
  base::Status Finish() const;
  /// Lists every scalar value of the file with its overrides: where paths may stand.
  /// @return the values in the order of the file
  std::vector<std::string> Scalars() const;
  /// Gives the text of the file, without overrides.
  /// @return the text
  const std::string& text() const;
  /// Gives the path of the file.
  /// @return the path, as given to Load or Parse
  const std::filesystem::path& path() const;

 private:
  explicit File(std::shared_ptr<detail::Context> context);
  std::shared_ptr<detail::Context> context_;
};

}  // namespace rodeira::config
