// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/core/config/config.hpp"

// Declarations of the keys of a kind of file. The reader (declared.hpp), the reference pages and the JSON Schema are
// made from the same declarations.
namespace rodeira::config {

// What a key holds, in YAML.
enum class ValueType {
  kNumber,
  kInteger,
  kFlag,
  kText,     // any scalar
  kWord,     // one of `words`
  kMapping,  // the keys that `of` declares
  kNamed,    // a mapping with free names as keys; `of` holds the declaration of each value
  kList,     // `of` holds the declaration of each item
  kKinds,    // a mapping with a word, `of[0]`, that says which other keys it has: those of the kMapping of this name
  kOther,    // what `form` says, or a mapping with the keys of `of`; a reader of its own checks it
};

// Nothing: the key has no default of its own.
using DefaultValue = std::variant<std::monostate, double, std::int64_t, bool, std::string>;

// Keys that name no other version are there since this one.
inline constexpr std::string_view kFirstVersion = "0.1.0";

// A key of a mapping, a value of kNamed or an item of kList.
struct Key {
  std::string name;  // with its unit; empty for a value of kNamed and an item of kList
  ValueType type = ValueType::kText;
  std::string meaning;               // one sentence, without the unit
  bool required = false;             // only where the mapping that it belongs to is there
  Range range = {};                  // of a number or a whole number, in the unit of the name
  DefaultValue default_value{};      // the reader's value if the key is absent
  std::string default_note{};        // the default in words, where it depends on other keys
  std::vector<std::string> words{};  // of kWord
  std::vector<Key> of{};
  std::string sample{};       // a valid value as YAML, where type and range do not give one; of kNamed: a valid name;
                              // of kMapping: not empty, if generated files have the mapping though it is optional;
                              // of kList: the value of generated files, where no item is tried
  std::string form{};         // of kOther, in words: "a number or a list of [s_m, width_m]"
  std::string summary{};      // of kMapping, kWord: not empty, if the reference shows this instead of keys and words
  std::size_t min_items = 0;  // of kList
  std::size_t max_items = std::numeric_limits<std::size_t>::max();
  std::string since{};        // the version that has it first; empty: kFirstVersion
  std::string former_name{};  // of a number with a default: the name in files of earlier versions; empty: none
};

// A kind of file.
struct Schema {
  std::string kind;     // "driver"
  std::string format;   // "driver/1", the value of the key `rodeira`
  std::string meaning;  // one sentence
  std::vector<Key> keys;
  bool is_open = false;  // the file has other keys, too, of another reader
};

// Declarations. A number or a whole number with a default is optional, the others say so.
Key NumberKey(std::string name, Range range, double default_value, std::string meaning);
Key RequiredNumberKey(std::string name, Range range, std::string meaning);
// A number with a default that the reader computes; `default_note` says from what.
Key ComputedNumberKey(std::string name, Range range, std::string default_note, std::string meaning);
// A number that may be absent, which the reader tells apart from every number.
Key OptionalNumberKey(std::string name, Range range, std::string meaning);
Key IntegerKey(std::string name, std::int64_t low, std::int64_t high, std::int64_t default_value, std::string meaning);
Key RequiredIntegerKey(std::string name, std::int64_t low, std::int64_t high, std::string meaning);
// A whole number that may be absent.
Key OptionalIntegerKey(std::string name, std::int64_t low, std::int64_t high, std::string meaning);
Key FlagKey(std::string name, bool default_value, std::string meaning);
Key TextKey(std::string name, std::string default_value, std::string meaning);
// `sample` is a text that the reader takes, as YAML.
Key RequiredTextKey(std::string name, std::string sample, std::string meaning);
// A text with a default that the reader computes; `sample` is one that it takes, as YAML.
Key ComputedTextKey(std::string name, std::string default_note, std::string sample, std::string meaning);
// One of `words`.
Key WordKey(std::string name, std::vector<std::string> words, std::string default_value, std::string meaning);
// A word that may be absent; its reader tells what follows from that.
Key OptionalWordKey(std::string name, std::vector<std::string> words, std::string meaning);
// A mapping with these keys; optional unless it goes through Required.
Key MappingKey(std::string name, std::vector<Key> keys, std::string meaning);
// A mapping of names to mappings with the keys; of names to values.
Key NamedKey(std::string name, std::vector<Key> keys, std::string meaning);
// `value` is without a name.
Key NamedValueKey(std::string name, Key value, std::string meaning);
// A value of kNamed or an item of a list: a mapping of one of `kinds`, a MappingKey each; the key `word` says which.
// Words of `word` are the names of the kinds; it is required unless it has a default.
Key KindsItem(Key word, std::vector<Key> kinds);
Key ListKey(std::string name, Key item, std::string meaning);
// A list of mappings with the keys.
Key ListKey(std::string name, std::vector<Key> keys, std::string meaning);
// An item of a list: it has no name and no default.
Key NumberItem(Range range);
Key TextItem(std::string sample);
Key WordItem(std::vector<std::string> words);
// `keys`: of the form that is a mapping, if there is one.
Key OtherKey(std::string name, std::string form, std::string sample, std::string meaning, std::vector<Key> keys = {});
// The same list with a number of items from `low` to `high`.
Key Counted(std::size_t low, std::size_t high, Key list);
// The same mapping or word, shown by its summary in the reference.
Key Summarised(std::string summary, Key key);
// The same key with a default in words.
Key WithDefaultNote(std::string default_note, Key key);
// The same key with a valid value for generated files, as YAML.
Key WithSample(std::string sample, Key key);
// The same key, which versions before `version` do not know.
Key Since(std::string version, Key key);
// The same number with a default, which files may still give under `former_name`: the reader takes it, with a warning.
Key Renamed(std::string former_name, Key key);
// The same key, required.
Key Required(Key key);
// The key `rodeira` with the format, and the optional `name`, which begin every file.
std::vector<Key> FileKeys(const std::string& format, std::vector<Key> keys);

// The key of that name; null without one.
const Key* FindKey(const std::vector<Key>& keys, std::string_view name);

// A declaration with its place in the file: "following.time_gap_s", "hosts.NAME.address", "events[].at_s"; a key that
// only one kind of mapping has: "forces.NAME(spring).preload_N".
struct PlacedKey {
  std::string path;
  const Key* key;
  const Key* container = nullptr;  // the list or the named values that it is an item of
};
// All declarations that hold a value, in the order of the schema. They refer to it.
std::vector<PlacedKey> ValuesOf(const Schema& schema);

// As ValuesOf, with one entry for a mapping that has a summary.
std::vector<PlacedKey> RowsOf(const Schema& schema);

// Cells of the reference: "0.1 to 2", "true, false"; "0.98", "" without a default; the meaning, with the
// version where it is not the first one.
std::string RangeCell(const PlacedKey& placed);
std::string DefaultCell(const PlacedKey& placed);
std::string MeaningCell(const PlacedKey& placed);

// A key a line, for a terminal.
std::string SchemaText(const Schema& schema);
// JSON Schema, draft 2020-12.
std::string SchemaJson(const Schema& schema);
// A table in Markdown.
std::string SchemaMarkdown(const Schema& schema);

}  // namespace rodeira::config
