// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

// What a node sees at one activation: for each of its ports the samples that law L1 names.
class Inbox {
 public:
  struct PortSamples {
    std::string_view topic;  // lives in the roster
    std::vector<Sample> samples;
  };
  explicit Inbox(std::vector<PortSamples> ports = {}) : ports_(std::move(ports)) {}

  // Whether the node has a port of this topic that is wired to somebody.
  bool Has(std::string_view topic) const;
  // State port with exactly one source: its sample. Anything else is our mistake.
  const Sample& Latest(std::string_view topic) const;
  // State port: one sample a source, in the roster's order. Event port: ordered by step, then by source.
  const std::vector<Sample>& All(std::string_view topic) const;
  const std::vector<PortSamples>& ports() const { return ports_; }

 private:
  std::vector<PortSamples> ports_;
};

}  // namespace rodeira::lockstep
