// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rodeira::cli {

// A killed process takes its time to end on a busy PC, so that its silence may be known before: the clock then says
// "silent NODE SENTENCE" in front of what it does about it. What became of the process a moment later takes the
// sentence's place.
class SilentNodes {
 public:
  // A sentence that says what became of a node's process; nothing while that goes on, or where it is another PC's.
  using FateOf = std::function<std::optional<std::string>(const std::string& node)>;
  // `patience`: how long a process may take to end.
  SilentNodes(FateOf fate_of, std::chrono::milliseconds patience);

  // Whether the line is one of a silent node; waits for its fate then.
  bool Take(std::string_view line);
  // A later line of the clock, with the fates in place of the sentences.
  std::string Reworded(std::string line) const;

 private:
  struct Known {
    std::string sentence;
    std::string fate;
  };
  const FateOf fate_of_;
  const std::chrono::milliseconds patience_;
  std::vector<Known> known_;
};

}  // namespace rodeira::cli
