// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include "common/data/decode/difference.hpp"
#include "common/data/decode/type.hpp"
#include "common/runtime/lockstep/roster.hpp"
#include "common/runtime/lockstep/sample.hpp"
#include "idl/topic_table.hpp"

namespace rodeira::launch {

// Names the first value in which two samples of one source and step differ: a field of the message, "state.NAME" of a
// snapshot, "header.state_digest" where only the node's state does, or, where no field can be named, "(sample)" with
// both digests.
class SampleDifference {
 public:
  // The roster outlives it.
  SampleDifference(const lockstep::Roster& roster, idl::TopicTable topics)
      : roster_(roster), topics_(std::move(topics)) {}
  // Call it for samples with contents that differ (lockstep::SameContent).
  decode::Difference Between(const lockstep::Sample& a, const lockstep::Sample& b);

 private:
  const decode::Type* TypeOf(lockstep::SourceIndex source);  // null where the topic is not known

  const lockstep::Roster& roster_;
  idl::TopicTable topics_;
  std::map<std::string, decode::TypePtr> types_;  // by topic, as they are needed
};

// Of a node that said one thing, and another for the same step: its name, where, and what differs.
std::string ContradictionText(const lockstep::Roster& roster, const idl::TopicTable& topics,
                              const lockstep::Sample& before, const lockstep::Sample& now);

}  // namespace rodeira::launch
