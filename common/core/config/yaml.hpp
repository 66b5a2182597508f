// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/config/config.hpp"

// What Map, List and File share: the YAML library's nodes, their places and conversions. Internal to this module.
namespace rodeira::config {

namespace detail {

// A node of a parsed file, or the place of an absent one.
struct YamlNode {
  YAML::Node node;  // may be null (absent)
  bool present = true;
};

// A fault of a file, before it becomes a base::Error with the place "file:line".
struct Problem {
  int line = 0;  // from 1; 0: no place
  base::ErrorId id;
  std::string message;
  std::string missing;  // the key's path, where it is that a key is missing
  std::string path;     // of the key or value
};

// A key that an option of the command line set.
struct Override {
  std::string key;
  std::string made;   // the first key on the way to it that the file does not have; the key itself where it has all
  std::string place;  // the option, for errors
};

// State of a File, shared by its maps and lists: the text, its nodes, the problems, and the keys that were read.
struct Context {
  std::filesystem::path path;
  std::string text;
  YAML::Node root;
  std::vector<Override> overrides;
  std::vector<Problem> problems;
  // Which keys of which mapping were asked for; the mapping is named by its mark in the text.
  struct KeysRead {
    YAML::Node node;
    std::string path;
    std::set<std::string, std::less<>> keys;
    std::set<std::string, std::less<>> hoped;  // those that may stand there
    bool wrong = false;                        // something in it is, and perhaps the rest was not read for that
  };
  std::map<std::pair<int, std::string>, KeysRead> keys_read;

  void Add(int line, std::string at, base::ErrorId id, std::string message, std::string missing = "") {
    problems.push_back({line, id, std::move(message), std::move(missing), std::move(at)});
  }
};

}  // namespace detail

// The line of a node, from 1; 0 where it has none.
int LineOf(const YAML::Node& node);
// The line of a key of a mapping, of the mapping itself where it has no such key.
int LineOfKey(const YAML::Node& map, std::string_view key);
// The option that set the key or value at `path`, the last one of several; otherwise "file:line", "file" where the line
// is 0.
std::string PlaceOf(const detail::Context& context, const std::string& path, int line);
// What stands there, for a sentence: "a list", "'12x'".
std::string KindOf(const YAML::Node& node);
// "a.b" of "a" and "b".
std::string Sub(const std::string& path, std::string_view key);
// "from 0 to 1", "greater than 0" …
std::string RangeText(Range range);

// Whole-text conversions: what std::from_chars takes, with nothing left over. Decimal point, no locale; finite.
std::optional<double> ToNumber(const std::string& text);
// Of 64 bits.
std::optional<std::int64_t> ToInteger(const std::string& text);

// The value of a key, undefined where there is none.
YAML::Node Find(const YAML::Node& map, std::string_view key);
// The document of a text, which `what` names in a sentence. The error's context is the line, where there is one.
// Refused: a second document, an alias inside of what it stands for, and aliases that stand for more than 100 000
// values.
base::Result<YAML::Node> LoadYaml(const std::string& text, const char* what);

}  // namespace rodeira::config
