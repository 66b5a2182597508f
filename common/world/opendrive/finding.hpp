// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace rodeira::opendrive {

// What is wrong with a file, and where. The rule is named as ASAM names it, without the version.
struct Finding {
  std::string rule;
  std::string message;
  std::size_t line = 0;  // 0: unknown
  std::string road;      // its id; empty: outside of roads
  std::optional<int> lane;
  std::optional<double> s_m;

  // "rule: road 1, lane -2, s 50: message", as much of it as is known.
  std::string Text() const;
};

// Another file that this one names, and where.
struct NamedFile {
  std::string road, file;
  std::size_t line = 0;
};

}  // namespace rodeira::opendrive
