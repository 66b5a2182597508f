// SPDX-License-Identifier: Apache-2.0
#include "common/core/config/declared.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <set>

#include "common/core/base/assert.hpp"
#include "common/core/base/log.hpp"
#include "common/core/config/either.hpp"

namespace rodeira::config {
namespace {

// Whether this place has no warning yet. A file is often read more than once.
bool IsFirstWarning(const std::string& place) {
  static std::mutex mutex;
  static std::set<std::string> places;
  const std::lock_guard lock(mutex);
  return places.insert(place).second;
}

// The name under which the mapping gives a key: the former one, with a warning, where only that is there.
std::string_view NameInFile(const Map& map, const Key& key) {
  if (key.former_name.empty() || !map.Peek({key.former_name})) return key.name;
  if (RejectConflictingKeys(map, key.name, key.former_name)) return key.name;
  const std::string place = map.Place(key.former_name);
  if (IsFirstWarning(place)) {
    base::Log(base::LogLevel::kWarning, "",
              fmt::format("{}: '{}' is deprecated; write '{}'", place, key.former_name, key.name));
  }
  return key.former_name;
}

}  // namespace

const Key& DeclaredMap::Declared(std::string_view key, ValueType type) const {
  const Key* found = FindKey(*keys_, key);
  RODEIRA_ASSERT(found != nullptr && found->type == type);
  return *found;
}

double DeclaredMap::Number(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kNumber);
  if (declared.required) return map_.Number(key, declared.range);
  const double* default_value = std::get_if<double>(&declared.default_value);
  RODEIRA_ASSERT(default_value != nullptr);
  return map_.Number(NameInFile(map_, declared), declared.range, *default_value);
}

double DeclaredMap::Number(std::string_view key, double default_value) const {
  const Key& declared = Declared(key, ValueType::kNumber);
  RODEIRA_ASSERT(!declared.required && !declared.default_note.empty());
  return map_.Number(key, declared.range, default_value);
}

double DeclaredMap::RequiredNumber(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kNumber);
  RODEIRA_ASSERT(declared.required || std::holds_alternative<std::monostate>(declared.default_value));
  return map_.Number(key, declared.range);
}

std::optional<double> DeclaredMap::OptionalNumber(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kNumber);
  RODEIRA_ASSERT(!declared.required && std::holds_alternative<std::monostate>(declared.default_value));
  const double value = map_.Number(key, declared.range, std::numeric_limits<double>::quiet_NaN());
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

std::int64_t DeclaredMap::Integer(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kInteger);
  const auto low = static_cast<std::int64_t>(declared.range.low);
  const auto high = static_cast<std::int64_t>(declared.range.high);
  if (declared.required) return map_.Integer(key, low, high);
  const std::int64_t* default_value = std::get_if<std::int64_t>(&declared.default_value);
  RODEIRA_ASSERT(default_value != nullptr);
  return map_.Integer(key, low, high, *default_value);
}

std::optional<std::int64_t> DeclaredMap::OptionalInteger(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kInteger);
  RODEIRA_ASSERT(!declared.required && std::holds_alternative<std::monostate>(declared.default_value));
  if (!map_.Has(key)) return std::nullopt;
  return map_.Integer(key, static_cast<std::int64_t>(declared.range.low),
                      static_cast<std::int64_t>(declared.range.high));
}

bool DeclaredMap::Flag(std::string_view key) const {
  const bool* default_value = std::get_if<bool>(&Declared(key, ValueType::kFlag).default_value);
  RODEIRA_ASSERT(default_value != nullptr);
  return map_.Flag(key, *default_value);
}

std::string DeclaredMap::Text(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kText);
  if (declared.required) return map_.Text(key);
  const std::string* default_value = std::get_if<std::string>(&declared.default_value);
  RODEIRA_ASSERT(default_value != nullptr);
  return map_.Text(key, *default_value);
}

std::string DeclaredMap::Text(std::string_view key, std::string_view default_value) const {
  const Key& declared = Declared(key, ValueType::kText);
  RODEIRA_ASSERT(!declared.required && !declared.default_note.empty());
  return map_.Text(key, default_value);
}

std::string DeclaredMap::Word(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kWord);
  if (declared.required) return map_.Choice(key, declared.words);
  const std::string* default_value = std::get_if<std::string>(&declared.default_value);
  RODEIRA_ASSERT(default_value != nullptr);
  return map_.Choice(key, declared.words, *default_value);
}

std::string DeclaredMap::Word(std::string_view key, std::string_view default_value) const {
  const Key& declared = Declared(key, ValueType::kWord);
  RODEIRA_ASSERT(!declared.required && !declared.default_note.empty());
  return map_.Choice(key, declared.words, default_value);
}

DeclaredMap DeclaredMap::Child(std::string_view key) const {
  const Key* found = FindKey(*keys_, key);
  RODEIRA_ASSERT(found != nullptr && (found->type == ValueType::kMapping || found->type == ValueType::kOther));
  const Key& declared = *found;
  return {declared.required ? map_.Child(key) : map_.OptionalChild(key), declared.of};
}

DeclaredList DeclaredMap::Items(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kList);
  RODEIRA_ASSERT(declared.of.size() == 1);
  return {declared.required ? map_.Items(key) : map_.OptionalItems(key), declared.of.front()};
}

std::vector<double> DeclaredMap::Numbers(std::string_view key) const {
  std::vector<double> values;
  const DeclaredList items = Items(key);
  for (std::size_t i = 0; i < items.size(); ++i) values.push_back(items.Number(i));
  return values;
}

std::vector<double> DeclaredMap::RequiredNumbers(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kList);
  RODEIRA_ASSERT(declared.of.size() == 1 && declared.of.front().type == ValueType::kNumber);
  return map_.Numbers(key, declared.of.front().range);
}

DeclaredMap DeclaredMap::OfKind(std::string_view kind) const { return {map_, Declared(kind, ValueType::kMapping).of}; }

std::vector<std::pair<std::string, double>> DeclaredMap::NamedNumbers(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kNamed);
  RODEIRA_ASSERT(declared.of.size() == 1 && declared.of.front().type == ValueType::kNumber);
  const Map names = declared.required ? map_.Child(key) : map_.OptionalChild(key);
  std::vector<std::pair<std::string, double>> entries;
  for (const std::string& name : names.Keys())
    entries.emplace_back(name, names.Number(name, declared.of.front().range));
  return entries;
}

const Map& DeclaredMap::MapWith(std::string_view key) const {
  RODEIRA_ASSERT(FindKey(*keys_, key) != nullptr);
  return map_;
}

std::vector<std::pair<std::string, DeclaredMap>> DeclaredMap::Named(std::string_view key) const {
  const Key& declared = Declared(key, ValueType::kNamed);
  RODEIRA_ASSERT(declared.of.size() == 1);
  RODEIRA_ASSERT(declared.of.front().type == ValueType::kMapping || declared.of.front().type == ValueType::kKinds);
  const Map names = declared.required ? map_.Child(key) : map_.OptionalChild(key);
  std::vector<std::pair<std::string, DeclaredMap>> entries;
  for (const std::string& name : names.Keys())
    entries.emplace_back(name, DeclaredMap(names.Child(name), declared.of.front().of));
  return entries;
}

DeclaredMap DeclaredList::At(std::size_t index) const {
  RODEIRA_ASSERT(item_->type == ValueType::kMapping || item_->type == ValueType::kKinds);
  return {list_.At(index), item_->of};
}

double DeclaredList::Number(std::size_t index) const {
  RODEIRA_ASSERT(item_->type == ValueType::kNumber);
  return list_.Number(index, item_->range);
}

std::string DeclaredList::Text(std::size_t index) const {
  RODEIRA_ASSERT(item_->type == ValueType::kText);
  return list_.Text(index);
}

}  // namespace rodeira::config
