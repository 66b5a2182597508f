// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/core/config/schema.hpp"

namespace rodeira::config {

class DeclaredList;

// A mapping that is read by its declarations: type, range, words and default of a key come from them. A key that they
// do not have, or have with another type, is an assertion failure. The declarations must live as long as this object.
// Problems are collected as by Map.
class DeclaredMap {
 public:
  DeclaredMap(Map map, const std::vector<Key>& keys) : map_(std::move(map)), keys_(&keys) {}

  // The value, or the declared default. Where it is wrong: a problem in the file's collection, and the default. A value
  // under the key's former name is taken; one warning a place in a file, on standard error, names the key.
  double Number(std::string_view key) const;
  // The default is computed by the caller; only for a ComputedNumberKey.
  double Number(std::string_view key, double default_value) const;
  // A number without a default of its own that this file needs, because of its other keys.
  double RequiredNumber(std::string_view key) const;
  // Nothing if the key is absent; only for an OptionalNumberKey.
  std::optional<double> OptionalNumber(std::string_view key) const;
  std::int64_t Integer(std::string_view key) const;
  // Nothing if the key is absent; only for an OptionalIntegerKey.
  std::optional<std::int64_t> OptionalInteger(std::string_view key) const;
  bool Flag(std::string_view key) const;
  std::string Text(std::string_view key) const;
  // The default is computed by the caller; only for a ComputedTextKey.
  std::string Text(std::string_view key, std::string_view default_value) const;
  std::string Word(std::string_view key) const;
  // The default is computed by the caller; only for a word with a default in words.
  std::string Word(std::string_view key, std::string_view default_value) const;
  // One without keys if it is absent, which is a problem where it is required.
  DeclaredMap Child(std::string_view key) const;
  // Mappings by name, in the order of the file. Of one with kinds, Word says which it is.
  std::vector<std::pair<std::string, DeclaredMap>> Named(std::string_view key) const;
  // The same mapping, which has kinds, with the keys of this one.
  DeclaredMap OfKind(std::string_view kind) const;
  // Numbers by name, in the order of the file.
  std::vector<std::pair<std::string, double>> NamedNumbers(std::string_view key) const;
  // Empty if it is absent, which is a problem where it is required. The caller checks the number of items.
  DeclaredList Items(std::string_view key) const;
  // The items of a list of numbers.
  std::vector<double> Numbers(std::string_view key) const;
  // The items of a list of numbers that this file needs, because of its other keys.
  std::vector<double> RequiredNumbers(std::string_view key) const;

  // The mapping with a declared key, for a function that reads this key by itself, with checks of its own.
  const Map& MapWith(std::string_view key) const;
  // For problems, places, and the presence of keys.
  const Map& map() const { return map_; }

 private:
  const Key& Declared(std::string_view key, ValueType type) const;

  Map map_;
  const std::vector<Key>* keys_;
};

// A list that is read by the declaration of its items.
class DeclaredList {
 public:
  // `item`, the declaration of each item, outlives it.
  DeclaredList(List list, const Key& item) : list_(std::move(list)), item_(&item) {}

  std::size_t size() const { return list_.size(); }
  // An item that is a mapping.
  DeclaredMap At(std::size_t index) const;
  // Precondition of both: the item's index is below size().
  double Number(std::size_t index) const;
  std::string Text(std::size_t index) const;
  // For problems and places.
  const List& list() const { return list_; }

 private:
  List list_;
  const Key* item_;
};

}  // namespace rodeira::config
