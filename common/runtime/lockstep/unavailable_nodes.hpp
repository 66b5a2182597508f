// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/runtime/lockstep/roster.hpp"

namespace rodeira::lockstep {

// The lost nodes for which a run waits (policy pause), until a person starts them again, lets them go on, or stops the
// run. Times are of one wall clock, ns.
class UnavailableNodes {
 public:
  void Lost(NodeIndex node, std::string reason, std::int64_t now_ns) { missed_[node] = {std::move(reason), now_ns}; }
  // Its report has come: its process was continued. What was on its way when it was lost (0.3 s) does not
  // count.
  void Heard(NodeIndex node, std::int64_t now_ns);
  // Another incarnation takes its place.
  void Restarted(NodeIndex node) { missed_.erase(node); }
  // Whether the run waits for this node.
  bool Has(NodeIndex node) const { return missed_.contains(node); }
  bool empty() const { return missed_.empty(); }
  // "node 'a' was killed … 3.2 s ago; node 'b' …".
  std::string Text(std::int64_t now_ns) const;

 private:
  struct Loss {
    std::string reason;
    std::int64_t since_ns = 0;
  };
  std::map<NodeIndex, Loss> missed_;
};

}  // namespace rodeira::lockstep
