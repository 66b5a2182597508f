// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/core/base/result.hpp"
#include "common/data/decode/type.hpp"

namespace rodeira::csv {

// How the messages of a type become rows of a table (docs/reference/tables.md). One value of a message after the other
// goes to the slots in their order, over and over for the elements of the sequence that makes the rows.
struct Slot {
  enum class Use {
    kCell,     // one value
    kRowCell,  // one value of each element of the row sequence
    kList,     // a sequence, all of it in one cell
    kRowList,  // the same within the elements of the row sequence
    kStep,
    kTime,
    kSource,
    kIncarnation,
    kDigest,   // of the header of a sample
    kDropped,  // "end", and what is not chosen
  };
  Use use = Use::kCell;
  std::string name;  // of the column
};

// How messages of a type become rows: columns, and the sequence that has the rows.
struct Layout {
  bool has_header = false;    // the messages are samples of the lockstep
  bool writes_digest = true;  // of the header; false: the column is left out
  std::string rows;           // the sequence with the rows as elements; empty: one row a message
  std::vector<Slot> slots;
};

inline constexpr std::size_t kMaxColumns = 10'000;

// Wrong input where the type is no structure, or its table would have more than kMaxColumns columns.
base::Result<Layout> LayoutOf(const decode::Type& type);

}  // namespace rodeira::csv
