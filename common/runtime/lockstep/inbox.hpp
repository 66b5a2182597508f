// SPDX-License-Identifier: Apache-2.0
#pragma once

/// @file
/// Inputs of a node.

#include <string_view>
#include <vector>

#include "common/runtime/lockstep/sample.hpp"

namespace rodeira::lockstep {

/// The inputs of a node at one activation: for each of its ports the samples that law L1 names. The samples stay valid
/// as long as the inbox; a copy of a Sample shares its payload and may be kept.
class Inbox {
 public:
  /// The samples of one port.
  struct PortSamples {
    std::string_view topic;       ///< topic of the port; its text belongs to the roster
    std::vector<Sample> samples;  ///< in the order of All()
  };
  /// Makes an inbox; the runner does so for each activation, a test for its node.
  /// @param ports the samples of every port
  explicit Inbox(std::vector<PortSamples> ports = {}) : ports_(std::move(ports)) {}

  /// Says whether there are samples of a topic. A state port that is wired to a source always has samples.
  /// @param topic name of the topic
  /// @return true if the node has a port of this topic with at least one sample
  bool Has(std::string_view topic) const;
  /// Gives the sample of a state port with exactly one source. Another number of samples is an assertion failure.
  /// @param topic name of the topic
  /// @return the sample
  const Sample& Latest(std::string_view topic) const;
  /// Gives all samples of a port.
  /// @param topic name of the topic
  /// @return of a state port one sample per source in the roster's order; of an event port all new samples, ordered by
  ///   step, then by source; empty if the node has no such port
  const std::vector<Sample>& All(std::string_view topic) const;
  /// Gives the samples of all ports.
  /// @return one element per port, in the roster's order
  const std::vector<PortSamples>& ports() const { return ports_; }

 private:
  friend class Mailbox;  // fills one inbox again and again

  std::vector<PortSamples> ports_;
};

}  // namespace rodeira::lockstep
