// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/core/config/config.hpp"

// Declarations of the keys of a kind of file. The reader (declared.hpp), the reference pages and the JSON Schema are
// made from the same declarations.
namespace rodeira::config {

enum class ValueType {
  kNumber,
  kInteger,
  kFlag,
  kText,     // any scalar
  kWord,     // one of `words`
  kMapping,  // the keys that `of` declares
  kNamed,    // a mapping with free names as keys; `of` holds the declaration of each value
};

// Nothing: the key has no default of its own.
using DefaultValue = std::variant<std::monostate, double, std::int64_t, bool, std::string>;

// A key of a mapping; without a name the value of a named entry.
struct Key {
  std::string name;  // with its unit
  ValueType type = ValueType::kText;
  std::string meaning;               // one sentence, without the unit
  bool required = false;             // only where the mapping that it belongs to is there
  Range range = {};                  // of a number or a whole number, in the unit of the name
  DefaultValue default_value{};      // the reader's value if the key is absent
  std::string default_note{};        // the default in words, where it depends on other keys
  std::vector<std::string> words{};  // of kWord
  std::vector<Key> of{};
  std::string sample{};  // a valid value as YAML, where type and range do not give one
};

// A kind of file.
struct Schema {
  std::string kind;     // "driver"
  std::string format;   // "driver/1", the value of the key `rodeira`
  std::string meaning;  // one sentence
  std::vector<Key> keys;
};

// Declarations. A number or a whole number with a default is optional, the others say so.
Key NumberKey(std::string name, Range range, double default_value, std::string meaning);
Key RequiredNumberKey(std::string name, Range range, std::string meaning);
// A number with a default that the reader computes; `default_note` says from what.
Key ComputedNumberKey(std::string name, Range range, std::string default_note, std::string meaning);
Key IntegerKey(std::string name, std::int64_t low, std::int64_t high, std::int64_t default_value, std::string meaning);
Key RequiredIntegerKey(std::string name, std::int64_t low, std::int64_t high, std::string meaning);
Key FlagKey(std::string name, bool default_value, std::string meaning);
Key TextKey(std::string name, std::string default_value, std::string meaning);
// `sample` is a text that the reader takes, as YAML.
Key RequiredTextKey(std::string name, std::string sample, std::string meaning);
// A text with a default that the reader computes; `sample` is one that it takes, as YAML.
Key ComputedTextKey(std::string name, std::string default_note, std::string sample, std::string meaning);
Key WordKey(std::string name, std::vector<std::string> words, std::string default_value, std::string meaning);
Key MappingKey(std::string name, std::vector<Key> keys, std::string meaning);
// A mapping of names to mappings with the keys; of names to values.
Key NamedKey(std::string name, std::vector<Key> keys, std::string meaning);
Key NamedValueKey(std::string name, Key value, std::string meaning);
// The same key, required.
Key Required(Key key);
// The key `rodeira` with the format, and the optional `name`, which begin every file.
std::vector<Key> FileKeys(const std::string& format, std::vector<Key> keys);

// The key of that name; null without one.
const Key* FindKey(const std::vector<Key>& keys, std::string_view name);

// A declaration with its place in the file: "following.time_gap_s", "hosts.NAME.address".
struct PlacedKey {
  std::string path;
  const Key* key;
};
// All declarations that hold a value, in the order of the schema. They refer to it.
std::vector<PlacedKey> ValuesOf(const Schema& schema);

// Cells of the reference: "0.1 to 2", "true, false"; "0.98", "" without a default.
std::string RangeCell(const Key& key);
std::string DefaultCell(const Key& key);

// A key a line, for a terminal.
std::string SchemaText(const Schema& schema);
// JSON Schema, draft 2020-12.
std::string SchemaJson(const Schema& schema);
// A table in Markdown.
std::string SchemaMarkdown(const Schema& schema);

}  // namespace rodeira::config
