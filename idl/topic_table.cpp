// SPDX-License-Identifier: Apache-2.0
#include "idl/topic_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/core/base/assert.hpp"
#include "common/data/decode/type_text.hpp"
#include "idl/topics.hpp"

namespace rodeira::idl {

base::Status TopicTable::Add(AddedTopic topic) {
  RODEIRA_ASSERT(topic.parsed != nullptr && FindTopic(topic.topic) == nullptr);
  const AddedTopic* known = FindAdded(topic.topic);
  if (known == nullptr) {
    added_.push_back(std::move(topic));
    return {};
  }
  const auto difference = decode::FirstTypeDifference(*topic.parsed, *known->parsed);
  if (!difference) return {};
  return base::WrongInput("launch.other_types", fmt::format("topic '{}' has another type than in the node before: {}",
                                                            topic.topic, *difference));
}

const AddedTopic* TopicTable::FindAdded(std::string_view topic) const {
  const auto found = std::ranges::find(added_, topic, &AddedTopic::topic);
  return found == added_.end() ? nullptr : &*found;
}

std::optional<TopicSchema> TopicTable::SchemaOf(std::string_view topic) const {
  if (const AddedTopic* added = FindAdded(topic)) return TopicSchema{added->type, added->idl};
  const TopicInfo* info = FindTopic(topic);
  if (info == nullptr) return std::nullopt;
  return TopicSchema{std::string(info->type), IdlTextOf(info->subject)};
}

decode::TypePtr TopicTable::TypeOf(std::string_view topic) const {
  const AddedTopic* added = FindAdded(topic);
  return added != nullptr ? added->parsed : idl::TypeOf(topic);
}

std::vector<TopicText> TopicTable::TextsOf(const TopicSet& topics) const {
  std::vector<TopicText> texts;
  for (const std::string& topic : topics) {
    const decode::TypePtr type = TypeOf(topic);
    RODEIRA_ASSERT(type != nullptr);
    texts.push_back({topic, type->name, decode::CanonicalIdl(*type)});
  }
  return texts;
}

std::optional<std::string> TopicTable::RecordedTypeDifference(std::string_view topic, const OtherType& found) const {
  const AddedTopic* added = FindAdded(topic);
  if (added == nullptr) return idl::RecordedTypeDifference(topic, found);
  return idl::DifferenceBetween(found, {added->idl, added->type});
}

}  // namespace rodeira::idl
