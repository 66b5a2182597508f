// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rodeira::dynamics {

// A line KEY = value of a tyre property file (TeimOrbit format).
struct TirEntry {
  std::string section;  // upper case, without brackets; empty before the first section
  std::string key;      // upper case
  std::string value;    // without comment, blanks and quotes; may be empty
  int line = 0;         // from 1
};

// The text of a tyre property file: sections in brackets, KEY = value, comments behind $ or !. Headings and rows of
// tables are passed over.
struct TirText {
  std::vector<std::string> sections;  // in their order, upper case
  std::vector<TirEntry> entries;

  // The name in upper case, without brackets.
  bool HasSection(std::string_view name) const;
  // The first entry of this key in any section; null if there is none.
  const TirEntry* Find(std::string_view key) const;
  // Its value in upper case; empty if there is none.
  std::string Word(std::string_view key) const;
};
// Lines that are neither a section nor KEY = VALUE are passed over. It never fails.
TirText SplitTir(std::string_view text);

// A finite decimal number, with or without a sign; nothing for any other text.
std::optional<double> TirNumber(std::string_view text);
// Letters a to z alone; other bytes stay.
std::string UpperCase(std::string_view text);

}  // namespace rodeira::dynamics
