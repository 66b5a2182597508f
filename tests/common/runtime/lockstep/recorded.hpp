// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/runtime/lockstep/node.hpp"
#include "common/runtime/lockstep/snapshot.hpp"
#include "tests/common/runtime/lockstep/law.hpp"

// A recorder for runs without processes: its file outlives it.
namespace rodeira::lockstep::law {

// What outlives a recorder, and what does not.
struct Disk {
  std::vector<Sample> file;
  std::vector<Sample> unwritten;
  std::uint64_t seed = 0;
  Step safe() const { return file.empty() ? -1 : file.back().valid() - 1; }
};

// Writes in the order of (step, source), now and then what it has gathered, beginning behind what the file holds.
class RecorderDouble final : public Node {
 public:
  explicit RecorderDouble(Disk& disk) : disk_(disk) { disk_.unwritten.clear(); }
  base::Status Initialise(Outbox&) override { return {}; }
  base::Status Step(const StepInfo&, const Inbox& inbox, Outbox&) override {
    Take(inbox);
    return {};
  }
  base::Status Finish(const Inbox& rest, lockstep::Step, bool) override {
    Take(rest);
    Write();
    return {};
  }
  void Save(base::StateWriter&) const override {}
  void Restore(base::StateReader&) override {}

 private:
  static auto KeyOf(const Sample& sample) { return std::pair(sample.valid(), sample.source()); }
  void Take(const Inbox& inbox) {
    std::vector<Sample> samples;
    for (const auto& port : inbox.ports()) samples.insert(samples.end(), port.samples.begin(), port.samples.end());
    std::ranges::sort(samples, {}, KeyOf);
    for (const Sample& sample : samples) {
      if (!disk_.file.empty() && KeyOf(sample) <= KeyOf(disk_.file.back())) continue;  // of an earlier incarnation
      disk_.unwritten.push_back(sample);
      if (base::RandomBits({disk_.seed, ++draws_}) % 300 == 0) Write();
    }
  }
  void Write() {
    disk_.file.insert(disk_.file.end(), disk_.unwritten.begin(), disk_.unwritten.end());
    disk_.unwritten.clear();
  }
  Disk& disk_;
  std::uint64_t draws_ = 0;
};

// A roster drawn from a seed, with a recorder that is wired to everything and snapshots.
inline Roster RecordedRoster(std::uint64_t seed) {
  RosterSpec specs = RandomSpec(seed);
  Step every = 1;
  for (const NodeSpec& spec : specs.nodes) {
    if (!spec.outputs.empty()) every = std::lcm(every, spec.period);
  }
  NodeSpec recorder;
  recorder.name = "recorder";
  recorder.kind = "test";
  recorder.period = 1 + static_cast<Step>(seed % 11);
  PortSpec snapshots{std::string(kSnapshotTopic), PortKind::kEvent, {}};
  PortSpec a{"a", PortKind::kEvent, {}}, b{"b", PortKind::kEvent, {}};
  for (NodeSpec& spec : specs.nodes) {
    if (spec.outputs.empty()) continue;
    spec.snapshot_every = every;
    snapshots.sources.push_back(spec.name);
    a.sources.push_back(spec.name);
    if (spec.outputs.size() == 2) b.sources.push_back(spec.name);
  }
  recorder.inputs = {a, snapshots};
  if (!b.sources.empty()) recorder.inputs.push_back(b);
  specs.nodes.push_back(recorder);
  return Roster::Create(1'000'000, specs.window, specs.nodes).value();
}

}  // namespace rodeira::lockstep::law
