// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/launch/sample_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "common/core/base/state_fields.hpp"
#include "common/runtime/lockstep/snapshot.hpp"
#include "idl/topic_types.hpp"

namespace rodeira::launch {
namespace {

using lockstep::Sample;
using lockstep::SampleHeader;

std::optional<decode::Difference> BetweenSnapshots(const Sample& a, const Sample& b) {
  const auto first = lockstep::Snapshot::FromSample(*a.payload), second = lockstep::Snapshot::FromSample(*b.payload);
  if (!first || !second) return std::nullopt;
  const auto field = base::FirstStateDifference(first.value().state, second.value().state);
  if (!field || !field.value()) return std::nullopt;
  return decode::Difference{"state." + field.value()->path, field.value()->first, field.value()->second};
}

decode::Difference WithoutAField(const char* what, const Sample& a, const Sample& b) {
  return {what, base::Hex(lockstep::PayloadDigest(*a.payload)), base::Hex(lockstep::PayloadDigest(*b.payload))};
}

}  // namespace

decode::Difference SampleDifference::Between(const Sample& a, const Sample& b) {
  if (roster_.source(a.source()).topic == lockstep::kSnapshotTopic) {
    const auto field = BetweenSnapshots(a, b);
    return field ? *field : WithoutAField("(snapshot)", a, b);
  }
  // The digest of the state comes in the header and differs with every value: the value says more.
  constexpr std::size_t kContent = SampleHeader::kEncapsulation + SampleHeader::kSize;
  const base::Bytes& first = *a.payload;
  const base::Bytes& second = *b.payload;
  if (std::equal(first.begin() + kContent, first.end(), second.begin() + kContent, second.end())) {
    return {"header.state_digest", base::Hex(a.header.state_digest), base::Hex(b.header.state_digest)};
  }
  base::Bytes alike = first;
  std::copy(second.begin(), second.begin() + kContent, alike.begin());
  const auto* type = TypeOf(b.source());
  const auto field = type == nullptr ? std::nullopt : decode::FirstDifference(*type, alike, second);
  return field ? *field : WithoutAField("(sample)", a, b);
}

const decode::Type* SampleDifference::TypeOf(lockstep::SourceIndex source) {
  const std::string& topic = roster_.source(source).topic;
  const auto known = types_.find(topic);
  if (known != types_.end()) return known->second.get();
  return (types_[topic] = topics_.TypeOf(topic)).get();
}

std::string ContradictionText(const lockstep::Roster& roster, const idl::TopicTable& topics, const Sample& before,
                              const Sample& now) {
  const auto& source = roster.source(now.source());
  const auto field = SampleDifference(roster, topics).Between(before, now);
  return fmt::format(
      "node '{}' contradicts itself at step {}, topic {}, field '{}': {} before, {} now; what it computes depends on "
      "more than its inputs and its state",
      roster.node(source.node).name, now.valid(), source.topic, field.path, field.a, field.b);
}

}  // namespace rodeira::launch
