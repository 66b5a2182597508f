// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/world/opendrive/repair_kind.hpp"

namespace rodeira::opendrive {

// Bytes [begin, end) of a file's text give way to `text`.
struct Edit {
  std::size_t begin = 0, end = 0;
  std::string text;

  bool operator==(const Edit&) const = default;
};

// How an error is repaired. Without edits the file stays as it is, and the reader copes with it as `done` says.
struct Repair {
  RepairKind kind = RepairKind::kNone;
  std::string done = {};
  std::vector<Edit> edits = {};
  std::string element = {};  // of kElementDropped: the element that is taken out

  std::string Name() const;  // "road.ended", "signal.dropped"; empty: nothing is done
};

// What is wrong with a file, and where. The rule is named as ASAM names it, without the version; rules of Rodeira's own
// begin with "rodeira.".
struct Finding {
  std::string rule;
  std::string message;
  std::size_t line = 0;   // 0: unknown
  std::string road = {};  // its id; empty: outside of roads
  std::optional<int> lane = {};
  std::optional<double> s_m = {};
  Repair repair = {};  // of a warning: what was done; nothing done: empty

  // "rule: road 1, lane -2, s 50: message", as much of it as is known; "; repaired: what was done" where something was.
  std::string Text() const;
};

}  // namespace rodeira::opendrive
