// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/hash.hpp"
#include "common/core/base/result.hpp"
#include "common/data/decode/type.hpp"

namespace rodeira::idl {

// A set of topics by name; of topics "rodeira/sample_batches/NODE" there is one, kSampleBatches.
using TopicSet = std::set<std::string, std::less<>>;

// The type of a topic as this program's IDL defines it. Null for an unknown topic. Thread-safe.
decode::TypePtr TypeOf(std::string_view topic);

// XXH3-64 of the canonical text of the topic's type. The topic must be known.
base::Digest TypeHash(std::string_view topic);

// A topic with its type as one program knows it.
struct TopicText {
  std::string topic;
  std::string type;  // "rodeira::msg::Controls"
  std::string idl;   // canonical text (decode::CanonicalIdl)
};
// In the order of their names. The topics must be known.
std::vector<TopicText> TextsOf(const TopicSet& topics);

// Of the topics' names and types: two programs with equal hashes of a set read each other's messages on these topics.
// A comment, a line break or another topic does not change it.
base::Digest ProtocolHash(std::span<const TopicText> topics);
// Of all topics of this program.
base::Digest ProtocolHash();

// The type that another program or a recording gives to a topic: its IDL text and its type's name.
struct OtherType {
  std::string_view idl;
  std::string_view type;
};
// What differs between two types, "member 3: found …, expected …"; none if they are the same.
std::optional<std::string> DifferenceBetween(const OtherType& found, const OtherType& expected);
// What differs from this program's type of the topic, "member 3: found …, expected …"; none if they are the same.
std::optional<std::string> TypeDifference(std::string_view topic, const OtherType& found);
// The same of a recording. Its topic and types may have names of earlier versions (idl/aliases.hpp).
std::optional<std::string> RecordedTypeDifference(std::string_view topic, const OtherType& found);

}  // namespace rodeira::idl
