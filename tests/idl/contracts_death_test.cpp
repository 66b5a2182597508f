// SPDX-License-Identifier: Apache-2.0
// Promises of callers of the topics: a topic or subject that is known, and an added topic that is none of Rodeira's.
#include <gtest/gtest.h>

#include <string>

#include "idl/topic_table.hpp"
#include "idl/topic_types.hpp"
#include "idl/topics.hpp"

namespace rodeira::idl {
namespace {

TEST(ContractsDeathTest, ASubjectAndATopicAreKnown) {
  EXPECT_FALSE(IdlTextOf(FindTopic(topics::kControls)->subject).empty());
  EXPECT_DEATH((void)IdlTextOf("nothing"), "found != all.end\\(\\)");
  EXPECT_NE(TypeHash(topics::kControls), 0U);
  EXPECT_DEATH((void)TypeHash("nothing"), "topic_types.cpp.*type != nullptr");
  EXPECT_EQ(TopicTable().TextsOf({std::string(topics::kControls)}).size(), 1U);
  EXPECT_DEATH((void)TopicTable().TextsOf({"nothing"}), "topic_table.cpp.*type != nullptr");
}

TEST(ContractsDeathTest, AnAddedTopicHasATypeAndIsNoneOfRodeiras) {
  AddedTopic own;
  own.topic = std::string(topics::kControls);
  own.parsed = TypeOf(topics::kControls);
  AddedTopic without = own, added = own;
  without.topic = added.topic = "eye";
  without.parsed = nullptr;
  TopicTable table;
  EXPECT_DEATH((void)table.Add(own), "FindTopic\\(topic.topic\\) == nullptr");
  EXPECT_DEATH((void)table.Add(without), "topic.parsed != nullptr");
  EXPECT_TRUE(table.Add(added).ok());
}

}  // namespace
}  // namespace rodeira::idl
