// SPDX-License-Identifier: Apache-2.0
#include "common/runtime/replay/comparison.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/runtime/lockstep/snapshot.hpp"

namespace rodeira::replay {

using lockstep::Sample;

std::string Difference::Text() const {
  return fmt::format("first difference at step {}: node '{}', topic {}, field '{}': recorded {}, computed {}", step,
                     node, topic, field, recorded, computed);
}

Comparison::Comparison(const RecordedRun& run, lockstep::Step from, const std::vector<bool>& trusted)
    : run_(run),
      from_(from),
      trusted_(trusted),
      stream_(run.Samples(from)),
      waiting_(run.roster().sources().size()),
      differences_(run.roster(), run.launch().topics()) {}

bool Comparison::ReadOne() {
  if (over_ || problem_) return false;
  auto sample = stream_.Next();
  if (!sample) {
    problem_ = sample.error();
    return false;
  }
  if (!sample.value()) {
    over_ = true;
    return false;
  }
  const auto source = sample.value()->source();
  if (!trusted_[run_.roster().source(source).node]) waiting_[source].push_back(std::move(*sample.value()));
  return true;
}

std::optional<Sample> Comparison::Recorded(lockstep::SourceIndex source, lockstep::Step valid) {
  auto& waiting = waiting_[source];
  while (waiting.empty() || waiting.back().valid() < valid) {
    if (!ReadOne()) break;
  }
  if (waiting.empty() || waiting.front().valid() > valid) return std::nullopt;
  Sample sample = std::move(waiting.front());
  waiting.pop_front();
  return sample;
}

void Comparison::Take(const Sample& computed) {
  const auto source = computed.source();
  if (problem_ || computed.valid() < from_ || computed.valid() > run_.last_step() ||
      trusted_[run_.roster().source(source).node])
    return;
  const auto recorded = Recorded(source, computed.valid());
  if (problem_) return;
  if (!recorded && run_.roster().source(source).topic == lockstep::kSnapshotTopic) {
    problem_ =
        base::WrongInput("recording.snapshot_missing",
                         fmt::format("the snapshot of node '{}' at step {} is missing",
                                     run_.roster().node(run_.roster().source(source).node).name, computed.valid()),
                         run_.path().string());
    return;
  }
  if (!recorded) return Note(computed, "(sample)", "nothing", "a sample");
  if (recorded->valid() != computed.valid()) return Note(*recorded, "(sample)", "a sample", "nothing");
  Compare(*recorded, computed);
}

void Comparison::Compare(const Sample& recorded, const Sample& computed) {
  ++compared_;
  const bool is_snapshot = run_.roster().source(computed.source()).topic == lockstep::kSnapshotTopic;
  if (is_snapshot) ++snapshots_;
  if (lockstep::SameContent(recorded, computed)) return;
  auto field = differences_.Between(recorded, computed);
  Note(computed, std::move(field.path), std::move(field.a), std::move(field.b));
}

void Comparison::Note(const Sample& sample, std::string field, std::string recorded, std::string computed) {
  // A snapshot at s is of the state before that step's activation, and its sample is valid later: the same order
  // serves.
  const std::pair at{sample.valid(), sample.source()};
  if (first_ && first_at_ <= at) return;
  first_at_ = at;
  const auto& source = run_.roster().source(sample.source());
  first_ = Difference{sample.valid(),      run_.roster().node(source.node).name,
                      source.topic,        std::move(field),
                      std::move(recorded), std::move(computed)};
}

void Comparison::Finish(lockstep::Step through) {
  while (!problem_ && ReadOne()) {
    bool beyond = true;
    for (const auto& waiting : waiting_) beyond = beyond && (waiting.empty() || waiting.back().valid() > through);
    if (beyond) break;
  }
  for (const auto& waiting : waiting_) {
    if (!waiting.empty() && waiting.front().valid() <= through)
      Note(waiting.front(), "(sample)", "a sample", "nothing");
  }
}

}  // namespace rodeira::replay
