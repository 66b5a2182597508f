// SPDX-License-Identifier: Apache-2.0
#include "idl/topic_types.hpp"

#include <fmt/format.h>

#include <map>

#include "common/core/base/assert.hpp"
#include "common/data/decode/idl_reader.hpp"
#include "common/data/decode/type_text.hpp"
#include "idl/aliases.hpp"
#include "idl/topic_table.hpp"
#include "idl/topics.hpp"

namespace rodeira::idl {
namespace {

using TypesByName = std::map<std::string_view, decode::TypePtr>;

TypesByName ReadTypes() {
  TypesByName types;
  for (const TopicInfo& info : Topics()) {
    if (types.contains(info.type)) continue;
    const auto type = decode::ReadType(IdlTextOf(info.subject), std::string(info.type));
    RODEIRA_ASSERT(type.ok());
    types.emplace(info.type, type.value());
  }
  return types;
}

std::optional<std::string> Difference(std::string_view topic, const OtherType& found, const decode::Aliases* aliases) {
  const decode::TypePtr expected = TypeOf(topic);
  if (!expected) return fmt::format("this program has no topic '{}'", topic);
  const auto read = decode::ReadType(found.idl, std::string(found.type));
  if (!read) return read.error().Text();
  return decode::FirstTypeDifference(aliases == nullptr ? *read.value() : *aliases->Renamed(read.value()), *expected);
}

}  // namespace

decode::TypePtr TypeOf(std::string_view topic) {
  static const TypesByName kTypes = ReadTypes();
  const TopicInfo* info = FindTopic(topic);
  return info == nullptr ? nullptr : kTypes.at(info->type);
}

base::Digest TypeHash(std::string_view topic) {
  const decode::TypePtr type = TypeOf(topic);
  RODEIRA_ASSERT(type != nullptr);
  return decode::TypeHash(*type);
}

std::vector<TopicText> TextsOf(const TopicSet& topics) { return TopicTable().TextsOf(topics); }

base::Digest ProtocolHash(std::span<const TopicText> topics) {
  base::Digest digest = 2;  // grows if the meaning of a message changes and its type does not
  for (const TopicText& text : topics)
    digest = base::Combine(digest, base::Combine(base::Hash(text.topic), base::Hash(text.idl)));
  return digest;
}

base::Digest ProtocolHash() {
  TopicSet topics;
  for (const TopicInfo& info : Topics()) topics.emplace(info.topic);
  return ProtocolHash(TextsOf(topics));
}

std::optional<std::string> DifferenceBetween(const OtherType& found, const OtherType& expected) {
  const auto first = decode::ReadType(found.idl, std::string(found.type));
  if (!first) return first.error().Text();
  const auto second = decode::ReadType(expected.idl, std::string(expected.type));
  if (!second) return second.error().Text();
  return decode::FirstTypeDifference(*first.value(), *second.value());
}

std::optional<std::string> TypeDifference(std::string_view topic, const OtherType& found) {
  return Difference(topic, found, nullptr);
}

std::optional<std::string> RecordedTypeDifference(std::string_view topic, const OtherType& found) {
  return Difference(Aliases().Topic(topic), found, &Aliases());
}

}  // namespace rodeira::idl
