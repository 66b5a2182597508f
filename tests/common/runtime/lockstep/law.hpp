// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/core/base/random.hpp"
#include "common/runtime/lockstep/in_process.hpp"
#include "common/runtime/lockstep/node.hpp"

// Law L1 told a second time, as a plain loop over time without mailboxes, grants or messages: the oracle of the runs.
namespace rodeira::lockstep::law {

inline base::Bytes Payload(std::uint64_t content) {
  base::Bytes payload(SampleHeader::kEncapsulation + SampleHeader::kSize + sizeof(content), std::byte{0});
  std::memcpy(payload.data() + payload.size() - sizeof(content), &content, sizeof(content));
  return payload;
}

inline std::uint64_t ContentOf(const Sample& sample) {
  std::uint64_t content = 0;
  std::memcpy(&content, sample.payload->data() + sample.payload->size() - sizeof(content), sizeof(content));
  return content;
}

// One activation's arithmetic: order matters in every argument.
inline std::uint64_t Fold(std::uint64_t h, std::uint64_t port, std::uint64_t source, Step valid,
                          std::uint64_t content) {
  return base::RandomBits({h, port, source, static_cast<std::uint64_t>(valid), content});
}

// A node that remembers all it ever saw in one number.
class Rememberer final : public Node {
 public:
  Rememberer(const Roster& roster, NodeIndex index) : roster_(roster), index_(index), memory_(index + 1) {}
  base::Status Initialise(Outbox& outbox) override {
    PutAll(outbox);
    return {};
  }
  base::Status Step(const StepInfo& step, const Inbox& inbox, Outbox& outbox) override {
    memory_ = base::RandomBits({memory_, static_cast<std::uint64_t>(step.step)});
    for (std::size_t p = 0; p < inbox.ports().size(); ++p) {
      for (const Sample& sample : inbox.ports()[p].samples) {
        memory_ = Fold(memory_, p, sample.source(), sample.valid(), ContentOf(sample));
        seen_.push_back({sample.source(), sample.valid()});
      }
    }
    PutAll(outbox);
    return {};
  }
  base::Status Finish(const Inbox& rest, lockstep::Step last, bool complete) override {
    finished_at_ = last;
    complete_ = complete;
    for (const auto& port : rest.ports()) {
      for (const Sample& sample : port.samples) seen_.push_back({sample.source(), sample.valid()});
    }
    return {};
  }
  bool runs_inline() const override { return index_ % 2 == 1; }
  void Save(base::StateWriter& out) const override { out.Put("memory", memory_); }
  void Restore(base::StateReader& in) override { in.Get("memory", memory_); }

  std::uint64_t memory() const { return memory_; }
  const std::vector<std::pair<SourceIndex, lockstep::Step>>& seen() const { return seen_; }
  lockstep::Step finished_at() const { return finished_at_; }
  bool complete() const { return complete_; }

 private:
  void PutAll(Outbox& outbox) const {
    for (const SourceIndex output : roster_.node(index_).outputs)
      outbox.Put(roster_.source(output).topic, Payload(base::RandomBits({memory_, output})));
  }
  const Roster& roster_;
  NodeIndex index_;
  std::uint64_t memory_;
  std::vector<std::pair<SourceIndex, lockstep::Step>> seen_;
  lockstep::Step finished_at_ = -1;
  bool complete_ = false;
};

// Content of every sample of every source, by the law alone, of a run through `last`.
inline std::map<std::pair<SourceIndex, Step>, std::uint64_t> Reference(const Roster& roster, Step last) {
  std::map<std::pair<SourceIndex, Step>, std::uint64_t> content;
  std::vector<std::uint64_t> memory;
  for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    memory.push_back(n + 1);
    for (const SourceIndex output : roster.node(n).outputs) {
      for (Step v = 0; v < roster.node(n).delay; v += roster.node(n).period)
        content[{output, v}] = base::RandomBits({memory[n], output});
    }
  }
  for (Step k = 0; k <= last; ++k) {
    for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
      const RosterNode& node = roster.node(n);
      if (k % node.period != 0 || node.is_sink()) continue;
      std::uint64_t h = base::RandomBits({memory[n], static_cast<std::uint64_t>(k)});
      for (std::size_t p = 0; p < node.inputs.size(); ++p) {
        const Port& port = node.inputs[p];
        const Step from = port.kind == PortKind::kEvent ? std::max<Step>(k - node.period + 1, 0) : k;
        for (Step v = from; v <= k; ++v) {
          for (const SourceIndex s : port.sources) {
            const Step period = roster.source(s).period;
            if (port.kind == PortKind::kState) {
              h = Fold(h, p, s, period * (k / period), content.at({s, period * (k / period)}));
            } else if (v % period == 0) {
              h = Fold(h, p, s, v, content.at({s, v}));
            }
          }
        }
      }
      memory[n] = h;
      for (const SourceIndex output : node.outputs) content[{output, k + node.delay}] = base::RandomBits({h, output});
    }
  }
  return content;
}

struct Made {
  std::vector<std::unique_ptr<Rememberer>> owned;
  std::vector<Node*> nodes;
};

inline Made MakeNodes(const Roster& roster) {
  Made made;
  for (NodeIndex n = 0; n < roster.nodes().size(); ++n) {
    made.owned.push_back(std::make_unique<Rememberer>(roster, n));
    made.nodes.push_back(made.owned.back().get());
  }
  return made;
}

// A roster drawn from a seed: two to six nodes, any periods and delays, any wiring, state and event ports, a sink.
struct RosterSpec {
  std::vector<NodeSpec> nodes;
  Step window = 1;
};
inline RosterSpec RandomSpec(std::uint64_t seed) {
  std::uint64_t draws = 0;
  const auto draw = [&](std::uint64_t below) { return base::RandomBits({seed, draws++}) % below; };
  const std::size_t count = 2 + draw(5);
  std::vector<NodeSpec> specs;
  for (std::size_t n = 0; n < count; ++n) {
    NodeSpec spec;
    spec.name = "node" + std::to_string(n);
    spec.kind = "test";
    spec.period = 1 + static_cast<Step>(draw(7));
    spec.delay = spec.period * (1 + static_cast<Step>(draw(3)));
    const bool sink = n + 1 == count;
    if (!sink) spec.outputs = draw(3) == 0 ? std::vector<std::string>{"a", "b"} : std::vector<std::string>{"a"};
    specs.push_back(spec);
  }
  for (std::size_t n = 0; n < count; ++n) {
    for (const char* topic : {"a", "b"}) {
      PortSpec port{topic, draw(2) == 0 && n + 1 != count ? PortKind::kState : PortKind::kEvent, {}};
      for (std::size_t m = 0; m + 1 < count; ++m) {
        const bool publishes = specs[m].outputs.size() == 2 || *topic == 'a';
        if (publishes && (draw(3) != 0 || n + 1 == count)) port.sources.push_back(specs[m].name);
      }
      if (!port.sources.empty()) specs[n].inputs.push_back(port);
    }
  }
  return {std::move(specs), 1 + static_cast<Step>(draw(30))};
}

inline Roster RandomRoster(std::uint64_t seed) {
  const RosterSpec specs = RandomSpec(seed);
  return Roster::Create(1'000'000, specs.window, specs.nodes).value();
}

}  // namespace rodeira::lockstep::law
