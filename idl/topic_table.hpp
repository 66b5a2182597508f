// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/decode/type.hpp"
#include "idl/topic_types.hpp"

namespace rodeira::idl {

// A topic of a type that is not in Rodeira's IDL: an external node brings it.
struct AddedTopic {
  std::string topic;
  std::string type;  // "lab::Gaze"
  std::string idl;   // self-contained text that defines the type
  decode::TypePtr parsed;
};

// The name of a topic's type, and the IDL text that defines it.
struct TopicSchema {
  std::string type;
  std::string idl;
};

// Rodeira's topics and those that a run adds to them.
class TopicTable {
 public:
  // Wrong input if the table has the topic with another type; the sentence says what differs. The same type again
  // changes nothing.
  base::Status Add(AddedTopic topic);

  const std::vector<AddedTopic>& added() const { return added_; }
  // Null where the topic is Rodeira's own or unknown.
  const AddedTopic* FindAdded(std::string_view topic) const;
  // None for an unknown topic.
  std::optional<TopicSchema> SchemaOf(std::string_view topic) const;
  // Null for an unknown topic.
  decode::TypePtr TypeOf(std::string_view topic) const;
  // In the order of the names. The topics must be known.
  std::vector<TopicText> TextsOf(const TopicSet& topics) const;
  // What differs between the type of a topic in a recording and in this table; none if they are the same. Names of
  // earlier versions match (idl/aliases.hpp).
  std::optional<std::string> RecordedTypeDifference(std::string_view topic, const OtherType& found) const;

 private:
  std::vector<AddedTopic> added_;
};

}  // namespace rodeira::idl
